"""Tables in Markdown, and the leaderboard made from summaries of results."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from signimit.benchmark.judge import CRITERION
from signimit.benchmark.results import Summary
from signimit.benchmark.running import SECONDS
from signimit.benchmark.splits import SPLITS
from signimit.benchmark.statistics import STAGES

MANY = 10_000  # sessions whose cost is told


def markdown_table(head: Sequence[object], rows: Iterable[Sequence[object]]) -> str:
    """Return a Markdown table of a head and rows of as many cells."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)


def ranked(summaries: Sequence[Summary]) -> list[Summary]:
    """Sort summaries by the number of splits, then the share of commands obeyed; oracles come last."""
    return sorted(summaries, key=lambda s: (s["oracle"], -len(s["splits"]), -mean_obeyed(s), s["entry"]))


def mean_obeyed(summary: Summary) -> float:
    """Return the mean over its splits of the share of commands obeyed."""
    shares = [split["stages"]["obeyed"]["mean"] for split in summary["splits"].values()]
    return sum(shares) / len(shares) if shares else 0.0


def overview(summaries: Sequence[Summary]) -> str:
    """Return the share of commands obeyed, in per cent: a line for each entry, a column for each split."""
    rows = ranked(summaries)
    names = [name for name in SPLITS if any(name in s["splits"] for s in rows)]
    counts = {
        name: {s["splits"][name]["stages"]["obeyed"]["count"] for s in rows if name in s["splits"]} for name in names
    }
    lines = [("*commands, n*", "", *(" or ".join(map(str, sorted(counts[name]))) for name in names))]
    for summary in rows:
        found = {name: split["stages"]["obeyed"] for name, split in summary["splits"].items()}
        whole = summary.get("all") or {"mean": mean_obeyed(summary)}
        cells = (_percent(found[name]) if name in found else "-" for name in names)
        lines.append((_entry(summary), f"**{_percent(whole)}**" if set(names) <= set(found) else "-", *cells))
    return markdown_table(("", "all", *names), lines)


def _percent(estimate: Mapping[str, float]) -> str:
    """Say a mean in per cent, with its interval if it is known."""
    interval = (
        " [{:.0f}, {:.0f}]".format(*(100 * estimate[end] for end in ("low", "high"))) if "low" in estimate else ""
    )
    return f"{100 * estimate['mean']:.0f}{interval}"


def split_table(summaries: Sequence[Summary], split: str) -> str:
    """Return all stages of a split with 95 % intervals, a line for each entry that met it."""
    rows = [s for s in ranked(summaries) if split in s["splits"]]
    stages = [stage for stage in STAGES if any(stage in s["splits"][split]["stages"] for s in rows)]
    lines = []
    for summary in rows:
        found = summary["splits"][split]
        estimates = (found["stages"].get(stage) for stage in stages)
        cells = ("-" if e is None else "{mean:.2f} [{low:.2f}, {high:.2f}]".format(**e) for e in estimates)
        lines.append((_entry(summary), found["sessions"], found["stages"]["obeyed"]["count"], *cells))
    return markdown_table(("", "sessions", "commands", *(STAGES[stage].title for stage in stages)), lines)


def _entry(summary: Summary) -> str:
    return f"*{summary['entry']}*" if summary["oracle"] else str(summary["entry"])


def leaderboard(summaries: Sequence[Summary]) -> str:
    """Return the whole page, in Markdown."""
    facts = []
    for summary in ranked(summaries):
        splits = summary["splits"].values()
        sessions = sum(s["sessions"] for s in splits)
        seconds = sum(s["seconds"] for s in splits) / max(1, sessions)
        shown = sum(s["demonstrations"] for s in splits) / max(1, sessions)
        cost = f"{seconds:.2f}", f"{hours_for(MANY, seconds):.1f}"
        code = (summary.get("source") or summary["code"])[:16]
        facts.append((_entry(summary), summary["title"], f"{shown:.0f}", sessions, *cost, f"`{code}`"))
    columns = ("entry", "what it is", "demonstrations", "sessions", "processor seconds a session", "hours for 10,000")
    stages = "\n".join(f"* *{stage.title}*: {stage.meaning}." for stage in STAGES.values())
    judges = " or ".join(dict.fromkeys(f"`{s.get('judge', 'of version 0.1.0')}`" for s in summaries))
    met = (name for name in SPLITS if any(name in s["splits"] for s in summaries))
    parts = (f"\n### {n}\n\nChanged: {SPLITS[n].change}.\n\n{split_table(summaries, n)}\n" for n in met)
    return f"""# Leaderboard

Written by `sh scripts/run.sh benchmark table` from the JSON files beside it; docs/benchmark.md says what is
measured. The people are synthetic. Each command moves a hand for {SECONDS:g} s at 50 Hz, without physics.

Commands obeyed, in per cent, with 95 % intervals; *all* is the mean over the splits. Entries in italics are oracles:
they are told what no learner is told. All rows were judged by one judge, {judges}, on the same sessions.

{CRITERION}

{overview(summaries)}

{markdown_table((*columns, "code"), facts)}

Demonstrations are a session's, on average. Hours are of two processors. The code is that of the entry's own file or
package, or of signimit where the entry is part of it; it is not compared.

## Stage by stage, with 95 % intervals

{stages}
{"".join(parts)}"""


def hours_for(sessions: int, seconds: float, processors: int = 2) -> float:
    """Return how long sessions take that each need so many seconds of one processor, h."""
    return sessions * seconds / processors / 3600
