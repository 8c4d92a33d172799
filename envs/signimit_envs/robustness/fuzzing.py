"""Fuzzing: loaders read mutated files and use what they read, in processes that may die.

File number i of a loader depends on the seed, the loader's name and i alone, so that every fault can be made again.
"""

from __future__ import annotations

import faulthandler
import logging
import os
import shutil
import tempfile
import traceback
import warnings
import zlib
from collections.abc import Iterator, Mapping
from functools import cache
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from signimit.exceptions import MissingDependencyError, SignimitError
from signimit.io.formats.import_report import StrokeImportWarning
from signimit_envs.robustness.archives import mutate_archive
from signimit_envs.robustness.datasets import mutate_hdf5, mutate_parquet
from signimit_envs.robustness.loaders import LOADERS
from signimit_envs.robustness.mutation import (
    Mutator,
    Rng,
    mutate_bytes,
    mutate_json,
    mutate_json_lines,
    mutate_text,
    pick,
)
from signimit_envs.robustness.processes import PROCESSES, deadline, limit_memory, memory_folder

LONGEST = 20  # s that reading and using a file may take, beside other work
MEMORY = 3 * 2**29  # bytes that a process may take beside what it has at first
CHUNK, SLOW_CHUNK = 2000, 200  # files a process
REFUSALS = (SignimitError, FileNotFoundError, IsADirectoryError, NotADirectoryError, PermissionError)
MUTATORS: Mapping[str, Mutator] = {
    ".npz": mutate_archive,
    ".json": mutate_json,
    ".jsonl": mutate_json_lines,
    ".parquet": mutate_parquet,
    ".hdf5": mutate_hdf5,
    **dict.fromkeys((".csv", ".xml", ".inkml", ".dat"), mutate_text),
}

Sample = Mapping[str, bytes]
"""Contents of a file, under the name "", or of all files of a folder, by their relative paths."""


class Fault(NamedTuple):
    """What was neither read nor refused.

    Attributes:
        loader: Full name of the loader.
        number: Number of the mutated file.
        error: What came out: the type and message of an exception or warning, and the line where.
    """

    loader: str
    number: int
    error: str


class Tally(NamedTuple):
    """Outcome of many files.

    Attributes:
        read: How many were read, and could be used.
        refused: How many were refused in a sentence.
        faults: The others.
    """

    read: int
    refused: int
    faults: tuple[Fault, ...]


class Task(NamedTuple):
    """Files of one loader for one process."""

    loader: str
    numbers: range
    seed: int


def fuzz_loaders(
    counts: Mapping[str, int], seed: int, workers: int = 1, keep: Path | None = None
) -> Iterator[tuple[str, Tally]]:
    """Let loaders read so many mutated files each.

    Args:
        counts: Number of files for each loader, by its name in `LOADERS`.
        seed: Decides the files.
        workers: Processes at once.
        keep: Folder for the files that make a fault; left out, they are not kept.

    Yields:
        The loader's name and the outcome of a part of its files.
    """
    tasks = [
        Task(name, range(start, min(start + size, count)), seed)
        for name, count in counts.items()
        for size in [SLOW_CHUNK if LOADERS[name].slow else CHUNK]
        for start in range(0, count, size)
    ]
    tasks.sort(key=lambda task: task.numbers.start / counts[task.loader])  # all loaders come to their end together
    waiting, running = list(reversed(tasks)), dict[Connection, tuple[Any, Task, Tally]]()
    while waiting or running:
        while waiting and len(running) < workers:
            task = waiting.pop()
            ours, theirs = PROCESSES.Pipe(duplex=False)
            process = PROCESSES.Process(target=_run_task, args=(task, theirs, keep))
            process.start()
            theirs.close()
            running[ours] = process, task, Tally(0, 0, ())
        for ready in wait(list(running)):
            assert isinstance(ready, Connection)
            process, task, tally = running[ready]
            try:
                number, tally = ready.recv()
                running[ready] = process, task._replace(numbers=range(number, task.numbers.stop)), tally
                continue
            except EOFError:  # the process has come to its end, one way or the other
                process.join()
            del running[ready]
            ready.close()
            if task.numbers:  # it died of the file that it announced last
                culprit = task.numbers.start
                fault = Fault(task.loader, culprit, f"process ended with code {process.exitcode}")
                tally = tally._replace(faults=(*tally.faults, fault))
                if task.numbers[1:]:
                    waiting.append(task._replace(numbers=task.numbers[1:]))
                if keep is not None:  # in a process, too: it may be making the file that takes for ever
                    keeping = PROCESSES.Process(target=keep_input, args=(task.loader, culprit, seed, keep))
                    keeping.start()
                    keeping.join(LONGEST)
                    keeping.kill()
            yield task.loader, tally


def _run_task(task: Task, out: Connection, keep: Path | None) -> None:
    """Read and use the files of a task; tells before each of them, and at the end, which is next, and the outcome."""
    limit_memory(MEMORY)
    read, refused, faults = 0, 0, list[Fault]()
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # MuJoCo and libraries in C have much to say of broken files
    logging.disable(logging.CRITICAL)
    with tempfile.TemporaryDirectory(dir=memory_folder(), prefix="fuzz-") as folder:
        os.chdir(folder)  # MuJoCo writes its log into the working folder
        for number in task.numbers:
            out.send((number, Tally(read, refused, tuple(faults))))
            faulthandler.dump_traceback_later(2 * LONGEST, exit=True, file=2)  # where no signal gets through
            error = try_file(task.loader, number, task.seed, Path(folder))
            if error is None:
                read += 1
            elif not error:
                refused += 1
            else:
                faults.append(Fault(task.loader, number, error))
                if keep is not None:
                    keep_input(task.loader, number, task.seed, keep)
    faulthandler.cancel_dump_traceback_later()
    out.send((task.numbers.stop, Tally(read, refused, tuple(faults))))


def try_file(name: str, number: int, seed: int, folder: Path) -> str | None:
    """Make a mutated file in a folder, read it, and use what was read.

    Returns:
        None if all went well, nothing if the file was refused, or else what came out.
    """
    loader = LOADERS[name]
    place = write_input(name, number, seed, folder)
    try:
        with deadline(LONGEST), warnings.catch_warnings(), np.errstate(all="warn", under="ignore"):
            warnings.simplefilter("error")
            warnings.simplefilter("ignore", StrokeImportWarning)  # says what was repaired or left out
            try:
                found = loader.read(place)
            except REFUSALS as error:
                str(error).encode()
                return ""
            loader.use(found)
            return None
    except Exception as error:
        frames = traceback.extract_tb(error.__traceback__)
        ours = [f for f in frames if "signimit" in f.filename and "robustness" not in f.filename] or frames
        line = f"{Path(ours[-1].filename).name}:{ours[-1].lineno}"
        return f"{type(error).__name__} at {line}: {error!s:.200}".encode("ascii", "backslashreplace").decode()
    finally:
        shutil.rmtree(place) if place.is_dir() else place.unlink()


def write_input(name: str, number: int, seed: int, folder: Path) -> Path:
    """Write the mutated file of a loader with a number into a folder, and return where a loader finds it."""
    rng = np.random.default_rng([seed, zlib.crc32(name.encode()), number])
    all_samples = samples_of(name)
    place, sample = pick(rng, list(all_samples.items()))
    mutated = mutate_sample(place, sample, rng)
    target = folder / place
    for part, content in mutated.items():
        path = target / part if part else target
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    target.parent.mkdir(parents=True, exist_ok=True)
    if not mutated:
        target.mkdir()
    return target


def mutate_sample(place: str, sample: Sample, rng: Rng) -> dict[str, bytes]:
    """Return the contents of a file or folder with something wrong in one of its files."""
    changed = dict(sample)
    part = pick(rng, list(changed))
    match int(rng.integers(24)) if part else 1:
        case 0:
            del changed[part]
        case _:
            for _ in range(1 if rng.integers(3) else 2):
                mutate = MUTATORS.get(Path(part or place).suffix, mutate_bytes)
                mutate = mutate if rng.integers(8) else mutate_bytes
                try:
                    changed[part] = mutate(changed[part], rng)
                except Exception:  # the first mutation left nothing that the second can read
                    changed[part] = mutate_bytes(changed[part], rng)
    return changed


@cache
def samples_of(name: str) -> dict[str, Sample]:
    """Return the sample files of a loader by their names."""
    with tempfile.TemporaryDirectory(dir=memory_folder()) as folder:
        root = Path(folder)
        found: dict[str, Sample] = {}
        for place in LOADERS[name].write(root):
            inside = [place] if place.is_file() else sorted(path for path in place.rglob("*") if path.is_file())
            parts = {"" if place.is_file() else str(p.relative_to(place)): p.read_bytes() for p in inside}
            found[place.name] = parts
        return found


def missing_package(name: str) -> str | None:
    """Say which package a loader needs that is not installed; None if it has all."""
    with tempfile.TemporaryDirectory(dir=memory_folder()) as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore", StrokeImportWarning)
        try:
            for place in LOADERS[name].write(Path(folder)):
                LOADERS[name].read(place)
        except MissingDependencyError as error:
            return str(error)
    return None


def keep_input(name: str, number: int, seed: int, keep: Path) -> Path:
    """Keep a mutated file, in a folder named after its loader and number."""
    folder = keep / f"{name.rpartition('.')[2]}-{number}"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return write_input(name, number, seed, folder)
