"""Schema of result files: what a record of a session and a summary must hold, so that tables can be made of them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from signimit.benchmark.scoring import WORST
from signimit.benchmark.splits import SPLITS
from signimit.benchmark.statistics import STAGES, Estimate
from signimit.exceptions import InvalidInputError
from signimit.validation import finite_array, plain_text, whole_numbers

NEEDED = frozenset({"split", "seed", "code", "demonstrations", "obeyed", "misfit", "seconds"})
_A_COMMAND = {"obeyed": 1.0, "misfit": WORST, "read": 2.0}  # scores of each command, and the largest there is
_ESTIMATE = tuple(Estimate.__annotations__)


def check_record(record: Mapping[str, Any]) -> None:
    """Check a line of records, `signimit.benchmark.running.run_task`.

    Raises:
        InvalidInputError: Names the entry that is missing, or is something else.
    """
    if not set(record) >= NEEDED:
        raise InvalidInputError("", f"a record with {', '.join(sorted(NEEDED))}", f"{sorted(record)!r:.60}")
    _check_split(record["split"])
    for name in ("code", *({"session"} & record.keys())):
        plain_text(record[name], name)
    for name in ("seed", "demonstrations"):
        _check_count(record[name], name)
    commands = len(finite_array(record["obeyed"], "obeyed", (None,)))
    if not commands:
        raise InvalidInputError("obeyed", "a score for each command", "none")
    for name, largest in _A_COMMAND.items():
        if name in record and (finite_array(record[name], name, (commands,), largest) < 0).any():
            raise InvalidInputError(name, f"numbers from 0 to {largest:g}", "less")
    for name in {"groups", "focus", "order"} & record.keys():
        finite_array(record[name], name, (), 1.0)
    if "families" in record:
        whole_numbers(record["families"], "families", (commands,))
    for part, spent in _mapping(record["seconds"], "seconds").items():
        finite_array(spent, f"seconds: {part}", ())


def check_summary(summary: Mapping[str, Any]) -> None:
    """Check a summary, `signimit.benchmark.results.summarise`.

    Raises:
        InvalidInputError: Names the entry that is missing, or is something else.
    """
    for name in ("entry", "title", "code"):
        plain_text(_entry(summary, name), name)
    for name in ("source", "judge"):
        plain_text(summary.get(name) or "", name)
    if not isinstance(_entry(summary, "oracle"), bool):
        raise InvalidInputError("oracle", "true or false", f"{summary['oracle']!r:.40}")
    if summary.get("all") is not None:
        _check_estimate(summary["all"], "all")
    for split, found in _mapping(_entry(summary, "splits"), "splits").items():
        _check_split(split)
        for name in ("sha256", *({"sessions_sha256"} & _mapping(found, split).keys())):
            plain_text(_entry(found, name), f"{split}: {name}")
        for name in ("sessions", "demonstrations"):
            _check_count(_entry(found, name), f"{split}: {name}")
        finite_array(_entry(found, "seconds"), f"{split}: seconds", ())
        stages = _mapping(_entry(found, "stages"), f"{split}: stages")
        _entry(stages, "obeyed")
        for stage in STAGES.keys() & stages.keys():
            _check_estimate(stages[stage], f"{split}: {stage}")


def _check_estimate(value: Any, where: str) -> None:
    for name in _ESTIMATE:
        finite_array(_entry(_mapping(value, where), name), f"{where}: {name}", ())


def _check_split(name: Any) -> None:
    if not isinstance(name, str) or name not in SPLITS:
        raise InvalidInputError("split", f"one of {', '.join(SPLITS)}", f"{name!r:.40}")


def _check_count(value: Any, where: str) -> None:
    if type(value) is not int or value < 0:
        raise InvalidInputError(where, "a whole number, 0 or more", f"{value!r:.40}")


def _mapping(value: Any, where: str) -> Mapping[str, Any]:
    if not isinstance(value, dict):
        raise InvalidInputError(where, "a JSON object", f"{value!r:.40}")
    return value


def _entry(value: Mapping[str, Any], name: str) -> Any:
    if name not in value:
        raise InvalidInputError("summary", f"an entry {name!r}", "none")
    return value[name]
