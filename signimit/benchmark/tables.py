"""The leaderboard, made from summaries of results."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from signimit.benchmark.obeying import SECONDS
from signimit.benchmark.results import Summary
from signimit.benchmark.splits import SPLITS
from signimit.benchmark.statistics import STAGES

MANY = 10_000  # sessions whose cost is told


def ranked(summaries: Sequence[Summary]) -> list[Summary]:
    """Sort: entries by the commands they obeyed, whoever met more splits first; oracles after them."""
    return sorted(summaries, key=lambda s: (s["oracle"], -len(s["splits"]), -mean_obeyed(s), s["entry"]))


def mean_obeyed(summary: Summary) -> float:
    """Return the mean over its splits of the share of commands obeyed."""
    shares = [split["stages"]["obeyed"]["mean"] for split in summary["splits"].values()]
    return sum(shares) / len(shares) if shares else 0.0


def overview(summaries: Sequence[Summary]) -> str:
    """Return the share of commands obeyed, in per cent: a line for each entry, a column for each split."""
    rows = ranked(summaries)
    names = [name for name in SPLITS if any(name in s["splits"] for s in rows)]
    lines = [_row(["", "all", *names]), _row(["---"] * (len(names) + 2))]
    for summary in rows:
        shares = [_percent(summary, name) for name in names]
        whole = f"**{100 * mean_obeyed(summary):.0f}**" if set(names) <= set(summary["splits"]) else "-"
        lines.append(_row([_entry(summary), whole, *shares]))
    return "\n".join(lines)


def _percent(summary: Summary, split: str) -> str:
    found = summary["splits"].get(split)
    return "-" if found is None else f"{100 * found['stages']['obeyed']['mean']:.0f}"


def split_table(summaries: Sequence[Summary], split: str) -> str:
    """Return all stages of a split with 95 % intervals, a line for each entry that met it."""
    rows = [s for s in ranked(summaries) if split in s["splits"]]
    stages = [stage for stage in STAGES if any(stage in s["splits"][split]["stages"] for s in rows)]
    lines = [_row(["", "sessions", *(STAGES[stage].title for stage in stages)]), _row(["---"] * (len(stages) + 2))]
    for summary in rows:
        found = summary["splits"][split]
        cells = [_cell(found["stages"].get(stage)) for stage in stages]
        lines.append(_row([_entry(summary), str(found["sessions"]), *cells]))
    return "\n".join(lines)


def _cell(estimate: dict[str, float] | None) -> str:
    if estimate is None:
        return "-"
    return "{mean:.2f} [{low:.2f}, {high:.2f}]".format(**estimate)


def _entry(summary: Summary) -> str:
    return f"*{summary['entry']}*" if summary["oracle"] else str(summary["entry"])


def _row(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def leaderboard(summaries: Sequence[Summary]) -> str:
    """Return the whole page, in Markdown."""
    return "\n".join(_page(summaries)) + "\n"


def _page(summaries: Sequence[Summary]) -> Iterator[str]:
    yield "# Leaderboard"
    yield ""
    yield "Written by `sh scripts/run.sh benchmark table` from the JSON files beside it; docs/benchmark.md says what is"
    yield f"measured. The people are synthetic. Each command moves a hand for {SECONDS:g} s at 50 Hz, without physics."
    yield ""
    yield "Commands obeyed, in per cent; *all* is the mean over the splits. Entries in italics are oracles: they are"
    yield "told what no learner is told."
    yield ""
    yield overview(summaries)
    yield ""
    yield "| entry | what it is | demonstrations | sessions | processor seconds a session | hours for 10,000 | code |"
    yield "|---|---|---|---|---|---|---|"
    for summary in ranked(summaries):
        yield _facts(summary)
    yield ""
    yield "Demonstrations are a session's, on average. Hours are of two processors."
    yield ""
    yield "## Stage by stage, with 95 % intervals"
    yield ""
    for stage in STAGES.values():
        yield f"* *{stage.title}*: {stage.meaning}."
    for name in SPLITS:
        if any(name in s["splits"] for s in summaries):
            yield from ("", f"### {name}", "", f"Changed: {SPLITS[name].change}.", "", split_table(summaries, name))


def _facts(summary: Summary) -> str:
    splits = summary["splits"].values()
    sessions = sum(s["sessions"] for s in splits)
    seconds = sum(s["seconds"] for s in splits) / max(1, sessions)
    shown = sum(s["demonstrations"] for s in splits) / max(1, sessions)
    cost = f"{seconds:.2f}", f"{hours_for(MANY, seconds):.1f}"
    return _row([_entry(summary), summary["title"], f"{shown:.0f}", str(sessions), *cost, f"`{summary['code']}`"])


def hours_for(sessions: int, seconds: float, processors: int = 2) -> float:
    """Return how long so many sessions take, h, each so many seconds of one processor."""
    return sessions * seconds / processors / 3600
