"""Demonstrations of which one thing is varied: what a variation changes, and what it leaves."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from signimit.benchmark.studies.varied_demonstrations import (
    ONE_SENSE,
    REACHES,
    UP_AGAINST,
    Variation,
    begun_near,
    choose_mover,
    compose_varied,
    ideal_library,
    rotation,
    sample_distant_scene,
)
from signimit.exceptions import InvalidInputError
from signimit.paths import half_size, step_lengths

MOVER = choose_mover(None, 0)
USUAL = compose_varied(MOVER, Variation(), 0)


def test_the_same_seed_gives_the_same_demonstrations() -> None:
    again = compose_varied(MOVER, Variation(), 0)
    assert all(np.array_equal(a, b) for a, b in zip(USUAL.paths, again.paths, strict=True))
    assert np.array_equal(USUAL.movement, again.movement)


@pytest.mark.parametrize(
    "change",
    [
        {"senses": ONE_SENSE}, {"shape": "ideal"}, {"pace": "even"}, {"rounds": 5}, {"density": 3.0}, {"waver": 0.1},
        {"one_drawing": True}, {"sizes": (0.06, 0.15)}, *({"reach": reach} for reach in REACHES),
    ],
)  # fmt: skip
def test_requests_and_scenes_are_the_same_whatever_is_varied(change: dict[str, Any]) -> None:
    varied = compose_varied(MOVER, replace(Variation(), **change), 0)
    assert np.array_equal(varied.objects, USUAL.objects)
    assert np.array_equal(varied.movement, USUAL.movement)
    assert np.array_equal(varied.focus, USUAL.focus)


@pytest.mark.parametrize("shape", ["drawn", "ideal"])
def test_every_movement_turns_in_the_sense_that_is_asked_for(shape: str) -> None:
    session = compose_varied(MOVER, Variation(senses=UP_AGAINST, shape=shape), 3)
    for sense, drawings in zip(UP_AGAINST, session.drawings, strict=True):
        assert all(sense * rotation(loop) > 0 for loop in drawings)


def test_even_points_are_equally_far_apart() -> None:
    for loop in compose_varied(MOVER, Variation(pace="even"), 0).drawings[0]:
        steps = step_lengths(loop)
        assert steps.max() < 1.2 * np.median(steps)  # chords of corners are shorter than the way
    usual = step_lengths(USUAL.drawings[0][0])
    assert usual.max() > 2 * np.median(usual)


def test_a_hand_joins_the_nearest_point_of_a_loop_and_goes_all_the_way_round() -> None:
    loop = USUAL.drawings[2][0]
    begun = begun_near(loop, np.array([1.0, 0.0]))
    assert begun[:, 0].max() == begun[0, 0]
    assert np.allclose(begun[0], begun[-1])
    assert len(begun) == len(loop)


def test_density_is_the_number_of_points_a_second() -> None:
    dense = compose_varied(MOVER, Variation(density=4.0), 0)
    shares = [len(d) / len(u) for d, u in zip(dense.paths, USUAL.paths, strict=True)]
    assert np.allclose(shares, 4.0, atol=0.1)


def test_sizes_are_those_asked_for() -> None:
    session = compose_varied(MOVER, Variation(sizes=(0.1, 0.1)), 0)
    assert np.allclose([half_size(loop) for loops in session.drawings for loop in loops], 0.1, rtol=0.02)


def test_objects_are_apart_on_a_table_as_large_as_that_needs() -> None:
    scene = sample_distant_scene(np.random.default_rng(0), 0.5)
    assert min(np.linalg.norm(scene[a] - scene[b]) for a, b in ((0, 1), (0, 2), (1, 2))) >= 0.5


def test_people_of_a_library_take_turns() -> None:
    library = ideal_library()
    assert set(choose_mover(library, 7).writers) == {"ideal"}


@pytest.mark.parametrize("change", [{"shape": "round"}, {"pace": "fast"}, {"reach": "far"}, {"rounds": 7}])
def test_a_variation_that_there_is_not_is_refused(change: dict[str, Any]) -> None:
    with pytest.raises(InvalidInputError, match=next(iter(change))):
        replace(Variation(), **change)
