"""Mutated files for every loader, killed writers, and writers without room or rights."""

from __future__ import annotations

import sys
from collections import Counter
from pathlib import Path

from signimit.benchmark.tables import markdown_table
from signimit.exceptions import InvalidInputError, UnknownNameError
from signimit_envs.robustness.fuzzing import Fault, fuzz_loaders, missing_package
from signimit_envs.robustness.killing import WRITERS, kill_writer
from signimit_envs.robustness.loaders import LOADERS, find_unknown_loaders
from signimit_envs.robustness.no_room import try_without_room

FAULTY = 1


def fuzz_files(
    *,
    files: int = 1000,
    slow_files: int | None = None,
    loader: tuple[str, ...] = (),
    seed: int = 0,
    workers: int = 2,
    keep: Path | None = None,
) -> None:
    """Let every loader of the project read mutated files, and use what it reads. Ends with code 1 if there are faults.

    A file may be refused in one sentence, or be read and then work: anything else is a fault, warnings of numpy too.
    The loaders are found in the source, and one that this command has no sample files for is a fault as well.

    Args:
        files: Mutated files for each loader.
        slow_files: The same for loaders that take some milliseconds a file; left out, at most 10,000.
        loader: Only loaders whose names have one of these words in them.
        seed: Decides the files; file number i of a loader depends on nothing but the seed and i.
        workers: Processes at once.
        keep: Folder for the files that make a fault.
    """
    chosen = [name for name in LOADERS if not loader or any(word in name for word in loader)]
    if not chosen:
        raise UnknownNameError("loader", " ".join(loader), LOADERS)
    if files < 1 or workers < 1:
        raise InvalidInputError("files, workers", "at least 1 of each", f"{files}, {workers}")
    for name, lack in [(name, missing_package(name)) for name in chosen]:
        if lack is not None:
            sys.stderr.write(f"note: {name} is left out. {lack}\n")
            chosen.remove(name)
    few = min(files, 10_000) if slow_files is None else slow_files
    counts = {name: few if LOADERS[name].slow else files for name in chosen}
    read, refused, faults = Counter[str](), Counter[str](), list[Fault]()
    for name, tally in fuzz_loaders(counts, seed, workers, None if keep is None else keep.absolute()):
        read[name] += tally.read
        refused[name] += tally.refused
        faults += tally.faults
        for fault in tally.faults:
            print(f"{fault.loader}, file {fault.number}: {fault.error}", flush=True)
    bad = Counter(fault.loader for fault in faults)
    columns = (Counter(counts), read, refused, bad)
    rows = [(name, *(column[name] for column in columns)) for name in chosen]
    total = ("all", *(column.total() for column in columns))
    print(markdown_table(("loader", "files", "read and used", "refused", "faults"), [*rows, total]))
    unknown = find_unknown_loaders()
    for name in sorted(unknown):
        print(f"{name} is a loader that has no sample files here.")
    if faults or unknown:
        sys.exit(FAULTY)


def kill_writers(*, times: int = 200, writer: tuple[str, ...] = tuple(WRITERS), seed: int = 0) -> None:
    """Kill processes that write, with SIGKILL, and read what is there. Ends with code 1 if something was lost.

    What was reported as saved must be there, whole, or something newer in its place; nothing may be read half.

    Args:
        times: How often each kind of writer is killed.
        writer: Kinds of writers.
        seed: Decides when.
    """
    lost = 0
    for name in writer:
        if name not in WRITERS:
            raise UnknownNameError("writer", name, WRITERS)
        outcome = kill_writer(name, times, seed)
        lost += len(outcome.losses)
        print(f"{name}: killed {outcome.kills} times, {outcome.saved} saved, {len(outcome.losses)} lost", flush=True)
        for loss in outcome.losses:
            print(f"  {loss}")
    if lost:
        sys.exit(FAULTY)


def write_without_room(*, writer: tuple[str, ...] = tuple(WRITERS)) -> None:
    """Write where there is no room and where one may not, and see that there is one sentence and nothing half.

    The disk is a small one in memory where this process may mount one, else the size of files is limited. As root, the
    folder without rights is tried as the user "nobody".

    Args:
        writer: Kinds of writers.
    """
    faults = 0
    for name in writer:
        if name not in WRITERS:
            raise UnknownNameError("writer", name, WRITERS)
        for trial in try_without_room(name):
            faults += not trial.good
            print(f"{'ok    ' if trial.good else 'FAULT '} {name}, {trial.what}: {trial.said}", flush=True)
    if faults:
        sys.exit(FAULTY)
