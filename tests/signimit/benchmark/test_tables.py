"""The leaderboard says what the summaries say."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from signimit.benchmark.judge import CRITERION
from signimit.benchmark.results import Summary
from signimit.benchmark.tables import leaderboard, overview, ranked, split_table


def estimate(mean: float) -> dict[str, Any]:
    return {"mean": mean, "low": mean / 2, "high": (mean + 1) / 2, "total": 9 * mean, "count": 9}


def summary(entry: str, oracle: bool = False, **obeyed: float) -> Summary:
    splits = {
        name.replace("_", "-"): {
            "sessions": 4,
            "demonstrations": 48,
            "seconds": 2.0,
            "stages": {"obeyed": estimate(share)} | ({} if entry == "clone" else {"focus": estimate(0.5)}),
        }
        for name, share in obeyed.items()
    }
    return {"entry": entry, "title": f"the {entry}", "oracle": oracle, "code": "abc", "splits": splits}


SUMMARIES = [
    summary("partial", paper=1.0),
    summary("clone", paper=0.25, unseen_pair=0.05),
    summary("all-knowing", oracle=True, paper=1.0, unseen_pair=1.0),
    summary("good", paper=0.9, unseen_pair=0.8) | {"all": {"mean": 0.85, "low": 0.8, "high": 0.9}},
]


def test_entries_are_ranked_by_what_they_obeyed_oracles_last() -> None:
    assert [s["entry"] for s in ranked(SUMMARIES)] == ["good", "clone", "partial", "all-knowing"]


def test_the_overview_has_a_column_for_each_split() -> None:
    assert overview(SUMMARIES).splitlines() == [
        "|  | all | paper | unseen-pair |",
        "| --- | --- | --- | --- |",
        "| *commands, n* |  | 9 | 9 |",
        "| good | **85 [80, 90]** | 90 [45, 95] | 80 [40, 90] |",
        "| clone | **15** | 25 [12, 62] | 5 [2, 52] |",
        "| partial | - | 100 [50, 100] | - |",
        "| *all-knowing* | **100** | 100 [50, 100] | 100 [50, 100] |",
    ]


def test_a_stage_that_is_not_told_is_a_dash() -> None:
    lines = split_table(SUMMARIES, "unseen-pair").splitlines()
    assert lines[0] == "|  | sessions | commands | focus | obeyed |"
    assert lines[2] == "| good | 4 | 9 | 0.50 [0.25, 0.75] | 0.80 [0.40, 0.90] |"
    assert lines[3] == "| clone | 4 | 9 | - | 0.05 [0.03, 0.53] |"
    assert not any("partial" in line for line in lines)


def test_the_page_explains_every_split_and_entry() -> None:
    page = leaderboard(SUMMARIES)
    assert "### unseen-pair\n\nChanged: only the pairs that were never shown are asked for.\n" in page
    assert "### many" not in page
    assert "| clone | the clone | 12 | 8 | 0.50 | 0.7 | `abc` |" in page
    assert CRITERION in page


def test_the_figure_has_a_panel_for_each_split(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib", reason="figures need matplotlib")
    from signimit.plots.benchmark import draw_results

    figure = draw_results(SUMMARIES)
    assert [panel.get_title(loc="left") for panel in figure.axes] == ["paper, n = 9", "unseen-pair, n = 9"]
    paper = figure.axes[0]
    assert [label.get_text() for label in paper.get_yticklabels()] == ["good", "clone", "partial", "all-knowing"]
    lines = [np.asarray(line.get_xydata()) for line in paper.get_lines()]
    points = [line.tolist() for line in lines if len(line) == 1]
    assert points == [[[0.9, 0]], [[0.25, 1]], [[1.0, 2]], [[1.0, 3]]]
