"""Two people's drawings of one thing are compared the same way, whoever drew them."""

from __future__ import annotations

import numpy as np
import pytest

from signimit.benchmark.scoring import WORST
from signimit.benchmark.studies.clumsiness import (
    built_in_strangers,
    clumsiness_table,
    compare_strangers,
    distance_to,
    nearest_spread,
    real_strangers,
)
from signimit.exceptions import InvalidInputError
from signimit.strokes import Stroke
from signimit.teaching.people import synthetic_library

SHAPES = ("circle", "square")


def test_people_of_greater_spread_draw_less_alike() -> None:
    usual, clumsy = (built_in_strangers(spread, 8, 0, SHAPES) for spread in (1.0, 2.25))
    for label in SHAPES:
        assert usual.dissimilarity[label].shape == (8 * 7 / 2,)
        assert usual.misfit[label].shape == (8 * 7,)
        assert np.median(usual.dissimilarity[label]) < np.median(clumsy.dissimilarity[label])
        assert np.median(usual.misfit[label]) < np.median(clumsy.misfit[label])


def test_the_spread_that_people_have_is_the_nearest() -> None:
    real = built_in_strangers(2.0, 16, 7, SHAPES)
    built_in = {spread: built_in_strangers(spread, 16, 0, SHAPES) for spread in (1.0, 2.0, 4.0)}
    assert nearest_spread(real, built_in) == 2.0
    assert distance_to(real, real) == {"dissimilarity": 0.0, "misfit": 0.0}
    lines = clumsiness_table(real, list(built_in.values())).splitlines()
    assert [line.split(" | ")[0] for line in lines[3:]] == [f"| built-in people, spread {s}" for s in ("1", "2", "4")]


def test_a_drawing_and_its_mirror_image_are_one_thing_and_one_that_is_too_short_is_the_worst() -> None:
    rng = np.random.default_rng(0)
    ring = np.linspace(0, 2 * np.pi, 80)
    circle = Stroke(np.column_stack([np.cos(ring), np.sin(ring)]), np.arange(80) * 0.02)
    image = Stroke(circle.points * (-1.0, 1.0), circle.times)
    zigzag = Stroke(np.column_stack([np.linspace(-1, 1, 80), rng.choice([-1.0, 1.0], 80)]), circle.times)
    found = compare_strangers("three", {"circle": (circle, image, zigzag)})
    assert found.misfit["circle"].max() == pytest.approx(WORST)
    assert found.misfit["circle"].min() < 0.1


def test_the_first_drawing_of_each_person_counts() -> None:
    library = synthetic_library(SHAPES, writers=3, samples=2, rng=np.random.default_rng(1))
    assert {label: len(drawn) for label, drawn in real_strangers(library, SHAPES).drawings.items()} == {
        "circle": 3, "square": 3,
    }  # fmt: skip
    with pytest.raises(InvalidInputError, match="drawings of real people: expected star by at least 3 people, found 0"):
        real_strangers(library, ("circle", "star"))
