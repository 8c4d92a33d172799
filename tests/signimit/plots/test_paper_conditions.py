"""The figures of the study of the paper's conditions: a panel for each factor, intervals around every point."""

import pytest

pytest.importorskip("matplotlib")

from signimit.benchmark.studies.paper_conditions import IdealGamma, LevelScore, Result
from signimit.benchmark.studies.paper_levels import study_levels
from signimit.plots.paper_conditions import draw_groups, draw_policy

MAP = [IdealGamma(c, s, 51, 51 if c > 3 * s else 0) for c in (1.0, 4.0, 16.0) for s in (0.0, 0.6, 1.2)]
USUAL = [
    Result(people, senses, "M_1", "random", 0, 51, 20, 31, 3, 4, 4.0, 0.6, 12)
    for people in ("built-in", "real")
    for senses in ("++-", "+++")
]


def scores() -> list[LevelScore]:
    rows = []
    for people in ("built-in", "real"):
        for level in study_levels():
            senses = "".join("+" if sense > 0 else "-" for sense in level.variation.senses)
            drawn = (0.6, 0.4, 0.8) if senses == "++-" else (float("nan"),) * 3
            counts = (2, 0.5, 0.3, 0.7, 0.4, 0.1, 0.1, 4.0, 0.6, 1.0)
            rows.append(LevelScore(people, senses, level.factor, level.value, *counts, *drawn, 0.2))
    return rows


def test_groups_have_a_panel_for_each_factor_that_they_depend_on_and_a_map() -> None:
    figure = draw_groups(scores(), USUAL, MAP)
    titles = {panel.get_title(loc="left") for panel in figure.axes} - {""}
    factors = {level.factor for level in study_levels()} - {"k nearest points", "speed of the hand"}
    assert titles == factors | {"made-up γ: runs right, %"}


def test_the_policy_has_a_panel_for_each_factor_that_it_depends_on() -> None:
    figure = draw_policy(scores())
    titles = {panel.get_title(loc="left") for panel in figure.axes}
    assert titles == {level.factor for level in study_levels()} - {"M_1", "which turns the other way"}
    assert len(figure.legends) == 1
