"""Engine for a dask.distributed cluster (extra ``dask``)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import contextmanager
from importlib import import_module
from itertools import islice
from typing import Any

from signimit.benchmark.running import WAITING, Engine, SessionTask, batches_of, check_counts, code_hash, run_batch
from signimit.exceptions import InvalidInputError, MissingDependencyError
from signimit.io.safe_files import Record

try:
    distributed: Any = import_module("distributed")  # half of it has no types
except ImportError:
    raise MissingDependencyError("distributed", "dask", "The engine dask") from None

TIMEOUT = 10  # s, after which a scheduler that does not answer is given up


def dask_engine(scheduler: str, batch: int = 1, timeout: float = TIMEOUT) -> Engine:
    """Make an engine that sends sessions to a running cluster.

    What a lost worker was at goes to another one; a batch that three workers died of ends the run.

    Args:
        scheduler: Address, e.g. ``"tcp://10.0.0.1:8786"``.
        batch: Sessions sent together.
        timeout: How long to wait for scheduler and workers, s.

    Raises:
        InvalidInputError: While the engine runs: if no scheduler answers, it has no workers, or they run other code.
    """
    check_counts(batch=batch)

    def run(tasks: Iterable[SessionTask]) -> Iterator[Record]:
        with _client(scheduler, timeout) as client:
            _check_workers(client, scheduler, timeout)
            batches, room = batches_of(tasks, batch), WAITING * sum(client.nthreads().values())
            first = [_submit(client, b) for b in islice(batches, room)]
            under_way = distributed.as_completed(first, loop=client.loop)
            for future in under_way:
                try:
                    records = future.result()
                except (distributed.KilledWorker, CancelledError, OSError) as error:
                    found = f"{type(error).__name__}; what was done is kept, run again to go on"
                    raise InvalidInputError(f"cluster {scheduler}", "workers that live", found) from None
                yield from records
                for following in islice(batches, 1):
                    under_way.add(_submit(client, following))

    return run


def _submit(client: Any, batch: list[SessionTask]) -> Any:
    return client.submit(run_batch, batch, pure=False)


@contextmanager
def _client(scheduler: str, timeout: float) -> Iterator[Any]:
    try:
        scheme, place = distributed.comm.parse_address(scheduler)  # a client that cannot be made is long in dying
        distributed.comm.registry.get_backend(scheme)
        if scheme in ("tcp", "tls"):
            distributed.comm.parse_host_port(place)
        client = distributed.Client(scheduler, timeout=timeout, set_as_default=False)
    except (OSError, ValueError) as error:  # no scheduler there, or not an address
        found = f"none ({type(error).__name__})"
        raise InvalidInputError(f"scheduler {scheduler}", "a dask scheduler that answers", found) from None
    try:
        yield client
    finally:
        client.close()


def _check_workers(client: Any, scheduler: str, timeout: float) -> None:
    """Check that there are workers, and that they run the same code as this process."""
    try:
        client.wait_for_workers(1, timeout=timeout)
        hashes = client.run(code_hash)
    except TimeoutError:
        raise InvalidInputError(f"cluster {scheduler}", "at least one worker", "none") from None
    except ModuleNotFoundError as error:
        found = f"one without {error.name}"
        raise InvalidInputError(f"cluster {scheduler}", "signimit on every worker", found) from None
    for worker, found in hashes.items():
        if found != code_hash():
            raise InvalidInputError(f"worker {worker}", f"the code {code_hash()} as here", f"{found}")
