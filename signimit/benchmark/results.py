"""Result files: a line of JSON for each session, and a summary of all of them.

A killed run goes on where it stopped. Results of other code, other sessions or another entry are never mixed in one
row, and rows of another judge or of other sessions never in one table: they are refused in one sentence, and left as
they are.
"""

from __future__ import annotations

import hashlib
import importlib
import json
import platform
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import asdict
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, NamedTuple

from signimit.benchmark.entries import EntrantReference, get_entrant
from signimit.benchmark.judge import judge_hash
from signimit.benchmark.protocol import Oracle
from signimit.benchmark.running import Engine, SessionTask, code_hash, hash_modules
from signimit.benchmark.schema import check_record, check_summary
from signimit.benchmark.scoring import WORST
from signimit.benchmark.shipped_sessions import split_hash
from signimit.benchmark.splits import SPLITS
from signimit.benchmark.statistics import STAGES, Estimate, estimate_share, estimate_stage
from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.safe_files import Record, append_record, read_records, replaced_file

FORMAT, VERSION = "signimit benchmark results", 1
PACKAGES = ("signimit", "numpy", "scipy", "scikit-learn", "torch")  # that a result may depend on
EARLIER = "earlier"  # folder in a folder of results: rows of learners that are gone, shown and not run again
Summary = dict[str, Any]


class ResultFile(NamedTuple):
    """The result files of an entrant.

    Attributes:
        folder: Folder of all results.
        entrant: Whose.
    """

    folder: Path
    entrant: EntrantReference

    @property
    def records(self) -> Path:
        """Path of the records, a line for each session."""
        return self.folder / f"{self.entrant.slug}.jsonl"

    @property
    def summary(self) -> Path:
        """Path of the summary, which the tables are made of."""
        return self.folder / f"{self.entrant.slug}.json"

    @property
    def header(self) -> Record:
        """First line of the records: what must not change from one run to the next."""
        return {
            "format": FORMAT,
            "version": VERSION,
            "entry": self.entrant.name,
            "source": source_hash(self.entrant),
            "code": code_hash(),
            "splits": {name: split_hash(name) for name in SPLITS},
        }

    def read(self) -> list[Record]:
        """Read the records of the sessions that were run, each once.

        Raises:
            FileFormatError: If they are not of this entry, this code and these splits.
        """
        lines = read_records(self.records)
        if not lines:
            return []
        wanted, found = self.header, lines[0]
        if isinstance(met := found.get("splits"), dict):  # those that were there then; later ones change nothing
            wanted["splits"] = {name: wanted["splits"].get(name) for name in met}
        for key, value in wanted.items():
            if found.get(key) != value:
                expected = f"{key} {_short(value)}; give another --out, or move the file away"
                raise FileFormatError(str(self.records), expected, _short(found.get(key)))
        for number, record in enumerate(lines[1:], 2):
            try:
                check_record(record)
            except InvalidInputError as error:
                where = f"{self.records}: line {number}{error.where and ': '}{error.where}"
                raise FileFormatError(where, error.expected, error.found) from None
        unique = {(r["split"], r["seed"]): r for r in lines[1:]}
        order = list(SPLITS)
        return sorted(unique.values(), key=lambda r: (order.index(r["split"]), r["seed"]))

    def append(self, record: Record) -> None:
        """Append the record of a session."""
        append_record(self.records, record)


def source_hash(entrant: EntrantReference) -> str | None:
    """Return the SHA-256 of an entry's own code: its file, or the package of its module; None if that is signimit."""
    if entrant.source:
        return hashlib.sha256(entrant.source.encode()).hexdigest()
    package = entrant.name.rpartition(":")[0].partition(".")[0]
    return hash_modules(importlib.import_module(package)) if package not in ("", "signimit") else None


def run_missing(file: ResultFile, splits: Sequence[str], seeds: Iterable[int], engine: Engine) -> Iterator[Record]:
    """Run every session that is not in the file yet, and write it down there; yields as they end.

    Raises:
        FileFormatError: If the file has results that these cannot join; or a worker runs other code.
    """
    done = {(r["split"], r["seed"]) for r in file.read()}
    empty = not read_records(file.records)
    todo = (SessionTask(file.entrant, split, seed) for seed in seeds for split in splits if (split, seed) not in done)
    for record in engine(todo):
        if record["code"] != code_hash():
            raise FileFormatError("record of a worker", f"code {code_hash()}", str(record["code"]))
        if empty:
            file.append(file.header)
        empty = False
        file.append(record)
        yield record


def summarise(file: ResultFile) -> Summary:
    """Summarise the records of a file, with the facts that made it."""
    entrant, records = get_entrant(file.entrant), file.read()
    splits = {}
    for name in SPLITS:
        mine = [r for r in records if r["split"] == name]
        if not mine:
            continue
        stages = {stage: estimate_stage(stage, mine, WORST) for stage in STAGES}
        splits[name] = {
            "sha256": split_hash(name),
            "sessions_sha256": hashlib.sha256(" ".join(r.get("session", "") for r in mine).encode()).hexdigest(),
            "seeds": _ranges([r["seed"] for r in mine]),
            "sessions": len(mine),
            "demonstrations": sum(r["demonstrations"] for r in mine),
            "commands": sum(len(r["obeyed"]) for r in mine),
            "seconds": round(sum(sum(r["seconds"].values()) for r in mine), 2),
            "stages": {stage: asdict(estimate) for stage, estimate in stages.items() if estimate is not None},
        }
    facts = {**file.header, "title": entrant.title, "oracle": isinstance(entrant, Oracle)}
    del facts["splits"]
    every = estimate_all_splits(records)
    return {
        **facts,
        "judge": judge_hash(),  # of the records, too: they are of this code
        "versions": {"machine": platform.machine(), **installed_versions(*PACKAGES)},
        "digest": records_digest(records),
        "all": None if every is None else asdict(every),
        "splits": splits,
    }


def estimate_all_splits(records: Sequence[Record]) -> Estimate | None:
    """Estimate the mean over the splits of the share of commands obeyed; None if their seeds are not the same.

    The same seed is the same people in every split, so that all their commands are one cluster.
    """
    shares: dict[int, list[float]] = {}
    commands: dict[int, int] = {}
    for r in records:
        shares.setdefault(r["seed"], []).append(sum(r["obeyed"]) / len(r["obeyed"]))
        commands[r["seed"]] = commands.get(r["seed"], 0) + len(r["obeyed"])
    splits = len({r["split"] for r in records})
    if not records or any(len(met) < splits for met in shares.values()):
        return None
    return estimate_share([commands[s] * sum(met) / splits for s, met in shares.items()], list(commands.values()))


def installed_versions(*packages: str) -> dict[str, str]:
    """Return the versions of Python and of those packages that are installed."""
    versions = {"python": platform.python_version()}
    for package in packages:
        with suppress(PackageNotFoundError):
            versions[package] = version(package)
    return versions


def records_digest(records: Iterable[Record]) -> str:
    """Return the SHA-256 of records in the order of `ResultFile.read`, without durations and the code's hash."""
    sha = hashlib.sha256()
    for record in records:
        lasting = {key: value for key, value in record.items() if key not in ("seconds", "code")}
        sha.update(json.dumps(lasting, sort_keys=True).encode() + b"\n")
    return sha.hexdigest()


def _ranges(seeds: Sequence[int]) -> list[list[int]]:
    """Return seeds as ranges: first and last of each run of consecutive ones."""
    ranges: list[list[int]] = []
    for seed in sorted(seeds):
        if ranges and seed == ranges[-1][1] + 1:
            ranges[-1][1] = seed
        else:
            ranges.append([seed, seed])
    return ranges


def write_summary(file: ResultFile) -> Summary:
    """Write the summary, whole or not at all, and return it."""
    summary = summarise(file)
    with replaced_file(file.summary) as out:
        out.write((json.dumps(summary, indent=1) + "\n").encode())
    return summary


def read_summaries(folder: Path) -> list[Summary]:
    """Read all summaries of a folder, and of `EARLIER` in it.

    Raises:
        FileFormatError: If one is not a whole summary of this version.
    """
    return [_read_summary(path) for path in _summary_paths(folder)]


def _summary_paths(folder: Path) -> list[Path]:
    paths = [*sorted(folder.glob("*.json")), *sorted((folder / EARLIER).glob("*.json"))]
    if not paths:
        raise FileFormatError(str(folder), "results; `benchmark run` makes them", "none")
    return paths


def read_comparable_summaries(folder: Path) -> list[Summary]:
    """Read all summaries of a folder, if they can stand in one table.

    Raises:
        FileFormatError: If one is not a whole summary of this version, was judged by another judge, or is of other
            sessions than the one that has most of a split.
    """
    summaries = read_summaries(folder)
    for summary, path in zip(summaries, _summary_paths(folder), strict=True):
        run = f"benchmark run --entry {summary['entry']} --out {path.parent}"
        again = f"move it and its .jsonl away, then `{run}` runs it"
        if summary.get("judge") != judge_hash():
            found = f"judge {summary['judge']}" if "judge" in summary else "none, as in version 0.1.0"
            raise FileFormatError(str(path), f"a row of judge {judge_hash()} ({again} again)", found)
        for name, split in summary["splits"].items():
            if split["sha256"] != split_hash(name):
                wanted = f"sessions of {name} with SHA-256 {split_hash(name)[:12]} ({again} on them)"
                raise FileFormatError(str(path), wanted, split["sha256"][:12])
            most = max((s for s in summaries if name in s["splits"]), key=lambda s: int(s["splits"][name]["sessions"]))
            theirs = most["splits"][name]
            if split["sessions_sha256"] != theirs["sessions_sha256"]:
                wanted = f"the sessions of {name} that {most['entry']} met, seeds {theirs['seeds']} ({again} on them)"
                raise FileFormatError(str(path), wanted, f"others, seeds {split['seeds']}")
    return summaries


def _read_summary(path: Path) -> Summary:
    try:
        summary: Summary = json.loads(path.read_text(encoding="utf-8"))
        found = f"{summary['format']} version {summary['version']}"
    except (ValueError, KeyError, TypeError, RecursionError):
        found = "something else"
    if found != f"{FORMAT} version {VERSION}":
        raise FileFormatError(str(path), f"{FORMAT} version {VERSION}", f"{found:.80}")
    try:
        check_summary(summary)
    except InvalidInputError as error:
        raise FileFormatError(f"{path}: {error.where}", error.expected, error.found) from None
    return summary


def _short(value: object) -> str:
    text = json.dumps(value)
    return text if len(text) <= 60 else f"{text[:40]}... (SHA-256 {hashlib.sha256(text.encode()).hexdigest()[:8]})"
