"""Killed writers: SIGKILL at any moment of any kind of write, and what can be read afterwards.

A writer writes version after version of one thing, in one place. Whatever happens, the last version that it reported
as saved, or a newer one, must be there and be whole.
"""

from __future__ import annotations

import os
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from contextlib import closing, suppress
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from signimit import Demonstration, DemonstrationSet, ImitationModel, StrokeLibrary, learn, load_policy, make_policy
from signimit.benchmark.entries import refer_to
from signimit.benchmark.results import ResultFile, read_summaries, write_summary
from signimit.exceptions import InvalidInputError
from signimit.io.formats import read_inkml, write_inkml
from signimit.policies import KNearestPolicy
from signimit_envs.recording import Recording, load_recording, save_recording
from signimit_envs.recording.formats import read_data, write_data
from signimit_envs.recording.formats.lerobot.recordings import write_lerobot_recording
from signimit_envs.robustness.processes import PROCESSES
from signimit_envs.robustness.samples import (
    ENTRY,
    minari_root,
    result_record,
    small_demonstrations,
    small_library,
    small_recording,
)
from signimit_envs.studio.store.events import Created, Titled
from signimit_envs.studio.store.sessions import SessionStore

STEP = 1e-4  # m that the demonstrations of one version are beside those of the last
LONGEST_LIFE = 2.0  # times as long as its first version took, that a writer lives on after reporting it
NOTHING = -1  # version of what is not there yet


class Writer(NamedTuple):
    """A kind of write.

    Attributes:
        write: Writes a version, a number that counts up, into a folder.
        version: Reads the version that is there.
    """

    write: Callable[[Path, int], None]
    version: Callable[[Path], int]


class KillOutcome(NamedTuple):
    """What became of a writer that was killed again and again.

    Attributes:
        kills: How often.
        saved: How many versions it reported as saved.
        losses: What was not there afterwards, or half, in words.
    """

    kills: int
    saved: int
    losses: tuple[str, ...]


def kill_writer(name: str, times: int, seed: int = 0) -> KillOutcome:
    """Kill a writer of a kind in `WRITERS` so many times, each time in the folder that the last one left.

    Raises:
        InvalidInputError: If this system has no SIGKILL.
    """
    if not hasattr(signal, "SIGKILL"):
        raise InvalidInputError("system", "one that can kill processes (SIGKILL)", sys.platform)
    rng, saved, losses = np.random.default_rng([seed, len(name)]), 0, list[str]()
    with tempfile.TemporaryDirectory() as place:
        folder, last = Path(place), NOTHING
        for kill in range(times):
            reported = max(last, _write_until_killed(name, folder, last + 1, float(rng.uniform(0, LONGEST_LIFE))))
            saved += reported - last
            try:
                found = WRITERS[name].version(folder)
            except Exception as error:
                losses.append(f"kill {kill}: version {reported} cannot be read: {type(error).__name__}: {error!s:.200}")
                found = reported
            if not reported <= found <= reported + 1:
                losses.append(f"kill {kill}: version {reported} was reported as saved, {found} is there")
            last = max(reported, found)
        shown = [path.name for path in folder.iterdir() if not path.name.startswith(".")]
        if len(shown) > 1:  # hidden drafts are nothing that anybody reads
            losses.append(f"one thing was written, {shown} are there")
    return KillOutcome(times, saved, tuple(losses))


def _write_until_killed(name: str, folder: Path, version: int, life: float) -> int:
    """Let a process write versions, kill it, and return its last report.

    It lives ``life`` times as long after its first report as it took to that.
    """
    reader, writer = os.pipe()
    process = PROCESSES.Process(target=_write_versions, args=(name, folder, version, writer))
    began = time.monotonic()
    process.start()
    os.close(writer)
    reports = os.read(reader, 8)
    time.sleep(life * (time.monotonic() - began))
    with suppress(ProcessLookupError):
        os.kill(process.pid or 0, signal.SIGKILL)
    process.join()
    while more := os.read(reader, 2**16):
        reports += more
    os.close(reader)
    numbers = np.frombuffer(reports, dtype=np.int64)
    return int(numbers[-1]) if len(numbers) else NOTHING


def _write_versions(name: str, folder: Path, version: int, reports: int) -> None:
    while True:
        WRITERS[name].write(folder, version)
        os.write(reports, np.int64(version).tobytes())
        version += 1


@cache
def _learned() -> ImitationModel:
    return learn(small_demonstrations())


def demonstrations_of(version: int) -> DemonstrationSet:
    """Return the small demonstrations, shifted as a whole to tell the version."""
    shift = version * STEP
    return DemonstrationSet(
        Demonstration(one.signs, one.objects + shift, one.hand + shift, one.times) for one in small_demonstrations()
    )


def version_of(demonstrations: DemonstrationSet) -> int:
    """Return the version of demonstrations; all of them must be of one."""
    shifts = (demonstrations.objects - small_demonstrations().objects) / STEP
    versions = np.unique(np.rint(shifts)).tolist()
    if len(versions) != 1:
        raise InvalidInputError("demonstrations", "one version", f"{versions}")
    return int(versions[0])


def recording_of(version: int) -> Recording:
    """Return the small recording with the version as its seeds."""
    recording = small_recording()
    return Recording(recording.origin, [replace(episode, seed=version) for episode in recording])


def recorded_version(found: object) -> int:
    """Return the version of a recording; all of its episodes must be of one."""
    seeds = {episode.seed for episode in found} if isinstance(found, Recording) else set()
    if len(seeds) != 1:
        raise InvalidInputError("recording", "one version", f"{seeds}")
    return int(seeds.pop() or 0)


def _save_model(folder: Path, version: int) -> None:
    replace(_learned(), demonstrations=demonstrations_of(version)).save(folder / "model.npz")


def _save_library(folder: Path, version: int) -> None:
    replace(small_library(), source=str(version)).save(folder / "strokes.npz")


def _policy_version(folder: Path) -> int:
    policy = load_policy(folder / "policy.npz")
    return policy.neighbours - 1 if isinstance(policy, KNearestPolicy) else NOTHING


def _save_policy(folder: Path, version: int) -> None:
    demos = small_demonstrations()
    make_policy(demos.paths[:2], demos.times[:2], "knn", neighbours=version + 1).save(folder / "policy.npz")


def _write_inkml(folder: Path, version: int) -> None:
    library = small_library()
    write_inkml(folder / "strokes.inkml", replace(library, writers=(str(version),) * len(library)))


def _write_demonstrations(folder: Path, version: int, name: str) -> None:
    with minari_root(folder):
        write_data("signimit/killed-v0" if name == "minari" else folder / name, demonstrations_of(version), name, True)


def _read_demonstrations(folder: Path, name: str) -> int:
    found = read_data(folder / ("signimit/killed-v0" if name == "minari" else name))
    if not isinstance(found, DemonstrationSet):
        raise InvalidInputError(name, "demonstrations", type(found).__name__)
    return version_of(found)


def _results(folder: Path) -> ResultFile:
    return ResultFile(folder / "results", refer_to(ENTRY))


def _append_result(folder: Path, version: int) -> None:
    file = _results(folder)
    if not version:
        file.append(file.header)
    file.append(result_record("paper", version))


def _count_results(folder: Path) -> int:
    seeds = [record["seed"] for record in _results(folder).read()]
    if seeds != list(range(len(seeds))):
        raise InvalidInputError("results", "every record", f"{seeds}")
    return len(seeds) - 1


def _write_summary(folder: Path, version: int) -> None:
    _append_result(folder, version)
    write_summary(_results(folder))


def _summarised(folder: Path) -> int:
    _count_results(folder)
    return int(read_summaries(folder / "results")[0]["splits"]["paper"]["sessions"]) - 1


def _append_event(folder: Path, version: int) -> None:
    with closing(SessionStore(folder / "studio")) as store:
        sessions = [path.parent.name for path in (folder / "studio").glob("*/journal.jsonl")]
        session = sessions[0] if sessions else store.create(Created("0", "now", "free", 2, 0))
        store.append(session, Titled(str(version)))


def _last_title(folder: Path) -> int:
    with closing(SessionStore(folder / "studio")) as store:
        history = store.read(next((folder / "studio").glob("*/journal.jsonl")).parent.name)
    if history.events != int(history.title) + 2:
        raise InvalidInputError("journal", "every event", f"{history.events}, the last {history.title}")
    return int(history.title)


WRITERS: Mapping[str, Writer] = MappingProxyType(
    {
        "model": Writer(_save_model, lambda at: version_of(ImitationModel.load(at / "model.npz").demonstrations)),
        "demonstrations": Writer(
            lambda at, version: demonstrations_of(version).save(at / "demonstrations.npz"),
            lambda at: version_of(DemonstrationSet.load(at / "demonstrations.npz")),
        ),
        "policy": Writer(_save_policy, _policy_version),
        "strokes": Writer(_save_library, lambda at: int(StrokeLibrary.load(at / "strokes.npz").source)),
        "inkml": Writer(_write_inkml, lambda at: int(read_inkml(at / "strokes.inkml").writers[-1])),
        "recording": Writer(
            lambda at, version: save_recording(at / "recording.npz", recording_of(version)),
            lambda at: recorded_version(load_recording(at / "recording.npz")),
        ),
        "csv": Writer(
            lambda at, version: _write_demonstrations(at, version, "csv"), lambda at: _read_demonstrations(at, "csv")
        ),
        "lerobot": Writer(
            lambda at, version: write_lerobot_recording(at / "lerobot", recording_of(version), True, cameras=()),
            lambda at: recorded_version(read_data(at / "lerobot")),
        ),
        "minari": Writer(
            lambda at, version: _write_demonstrations(at, version, "minari"),
            lambda at: _read_demonstrations(at, "minari"),
        ),
        "results": Writer(_append_result, _count_results),
        "summary": Writer(_write_summary, _summarised),
        "journal": Writer(_append_event, _last_title),
    }
)
"""Kinds of writes, by name."""
