"""Tables in Markdown, and the leaderboard made from summaries of results."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

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
    lines = []
    for summary in rows:
        means = {name: found["stages"]["obeyed"]["mean"] for name, found in summary["splits"].items()}
        whole = f"**{100 * mean_obeyed(summary):.0f}**" if set(names) <= set(means) else "-"
        shares = (f"{100 * means[name]:.0f}" if name in means else "-" for name in names)
        lines.append((_entry(summary), whole, *shares))
    return markdown_table(("", "all", *names), lines)


def split_table(summaries: Sequence[Summary], split: str) -> str:
    """Return all stages of a split with 95 % intervals, a line for each entry that met it."""
    rows = [s for s in ranked(summaries) if split in s["splits"]]
    stages = [stage for stage in STAGES if any(stage in s["splits"][split]["stages"] for s in rows)]
    lines = []
    for summary in rows:
        found = summary["splits"][split]
        estimates = (found["stages"].get(stage) for stage in stages)
        cells = ("-" if e is None else "{mean:.2f} [{low:.2f}, {high:.2f}]".format(**e) for e in estimates)
        lines.append((_entry(summary), found["sessions"], *cells))
    return markdown_table(("", "sessions", *(STAGES[stage].title for stage in stages)), lines)


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
        facts.append((_entry(summary), summary["title"], f"{shown:.0f}", sessions, *cost, f"`{summary['code']}`"))
    columns = ("entry", "what it is", "demonstrations", "sessions", "processor seconds a session", "hours for 10,000")
    stages = "\n".join(f"* *{stage.title}*: {stage.meaning}." for stage in STAGES.values())
    met = (name for name in SPLITS if any(name in s["splits"] for s in summaries))
    parts = (f"\n### {n}\n\nChanged: {SPLITS[n].change}.\n\n{split_table(summaries, n)}\n" for n in met)
    return f"""# Leaderboard

Written by `sh scripts/run.sh benchmark table` from the JSON files beside it; docs/benchmark.md says what is
measured. The people are synthetic. Each command moves a hand for {SECONDS:g} s at 50 Hz, without physics.

Commands obeyed, in per cent; *all* is the mean over the splits. Entries in italics are oracles: they are
told what no learner is told.

{overview(summaries)}

{markdown_table((*columns, "code"), facts)}

Demonstrations are a session's, on average. Hours are of two processors.

## Stage by stage, with 95 % intervals

{stages}
{"".join(parts)}"""


def hours_for(sessions: int, seconds: float, processors: int = 2) -> float:
    """Return how long sessions take that each need so many seconds of one processor, h."""
    return sessions * seconds / processors / 3600
