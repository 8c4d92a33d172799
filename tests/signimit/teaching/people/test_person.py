"""Synthetic people: everybody has a style, and nobody draws anything twice the same way."""

import pickle

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit import InvalidInputError, UnknownNameError
from signimit.strokes import Stroke
from signimit.teaching.people import GOAL_LABELS, MOVEMENT_LABELS, SIGN_LABELS, Person, synthetic_library
from signimit.teaching.people.glyphs import GLYPHS
from signimit.teaching.people.person import corners


def outline(stroke: Stroke, count: int = 64) -> NDArray[np.float64]:
    way = np.r_[0, np.cumsum(np.linalg.norm(np.diff(stroke.points, axis=0), axis=1))]
    at = np.linspace(0, way[-1], count)
    points = np.column_stack([np.interp(at, way, stroke.points[:, axis]) for axis in (0, 1)])
    low, high = points.min(axis=0), points.max(axis=0)
    return np.asarray((points - (low + high) / 2) / (high - low).max())


@pytest.mark.parametrize("label", GLYPHS)
def test_every_glyph_is_drawn_as_a_plausible_stroke(label: str) -> None:
    person, rng = Person.sample(np.random.default_rng(3)), np.random.default_rng(4)
    for _ in range(3):
        stroke = person.draw(label, rng)
        half = np.ptp(stroke.points, axis=0).max() / 2
        speed = np.linalg.norm(np.diff(stroke.points, axis=0), axis=1) / 0.01
        assert 0.008 < half < 0.2
        assert speed.max() < 2.0  # m/s, a hand's
        assert 0.3 < stroke.times[-1] < 6.0
        assert np.allclose(np.diff(stroke.times), 0.01)


def test_a_movement_takes_a_second_or_a_few_and_a_digit_about_one() -> None:
    rng = np.random.default_rng(0)
    people = [Person.sample(rng) for _ in range(20)]
    loops = [p.draw(label, rng).times[-1] for p in people for label in ("circle", "triangle up", "triangle down")]
    digits = [p.draw(label, rng).times[-1] for p in people for label in SIGN_LABELS]
    assert 1.3 < np.median(loops) < 3.0
    assert 0.6 < np.median(digits) < 1.3


def test_no_two_samples_are_the_same() -> None:
    library = synthetic_library(["circle", "4"], samples=12, rng=np.random.default_rng(0))
    assert len({stroke.points.tobytes() for stroke in library}) == len(library) == 24


def test_the_same_generator_state_gives_the_same_bytes() -> None:
    first, again, other = (
        synthetic_library(["star", "9"], writers=2, samples=2, rng=np.random.default_rng(seed)) for seed in (1, 1, 2)
    )
    assert [s.points.tobytes() for s in first] == [s.points.tobytes() for s in again]
    assert [s.times.tobytes() for s in first] == [s.times.tobytes() for s in again]
    assert [s.points.tobytes() for s in first] != [s.points.tobytes() for s in other]


@pytest.mark.parametrize("label", [*SIGN_LABELS, *MOVEMENT_LABELS])
def test_people_differ_more_from_one_another_than_from_themselves(label: str) -> None:
    library = synthetic_library([label], writers=8, samples=6, rng=np.random.default_rng(5))
    shapes = np.array([outline(s) for s in library]).reshape(8, 6, -1)
    within = shapes.var(axis=1).mean()
    between = shapes.mean(axis=1).var(axis=0).mean()
    assert between > within


def test_a_person_survives_pickling_and_habits_cannot_be_written() -> None:
    person = Person.sample(np.random.default_rng(0))
    same: Person = pickle.loads(pickle.dumps(person))
    first, again = (p.draw("8", np.random.default_rng(1)).points for p in (person, same))
    assert np.array_equal(first, again)
    with pytest.raises(ValueError, match="read-only"):
        person.habits["8"][0] = 0.0


def test_the_built_in_people_stay_who_they_are() -> None:
    """Published seeds would mean other sessions if these numbers changed."""
    stroke = Person.sample(np.random.default_rng(0)).draw("circle", np.random.default_rng(1))
    assert len(stroke) == 228
    expected = [(-0.00662, 0.096861), (0.103666, 0.016681), (0.009272, 0.107925)]
    np.testing.assert_allclose(stroke.points[[0, 50, -1]], expected, atol=1e-6)


def test_a_library_is_called_synthetic_and_counts_its_writers() -> None:
    library = synthetic_library(SIGN_LABELS, writers=3, samples=2, rng=np.random.default_rng(0))
    assert library.source == "synthetic"
    assert len(library) == 10 * 3 * 2
    assert sorted(set(library.writers)) == ["synthetic 1", "synthetic 2", "synthetic 3"]
    assert len(library.select("7", "synthetic 2")) == 2


def test_a_clockwise_turn_and_a_smooth_junction_are_told_from_a_corner() -> None:
    square = np.array([(0, 0), (1, 0), (1, 1), (2, 1.0)])
    assert corners(square, np.zeros(3)).tolist() == [False, True, True]
    quarter = np.pi / 2
    circle = np.array([(0, 1), (-1, 0), (0, -1), (1, 0.0)])
    assert not corners(circle, np.full(3, quarter)).any()


def test_tremor_is_small_and_about_ten_hertz() -> None:
    person = Person.sample(np.random.default_rng(0))
    times = np.arange(0, 20, 0.01)
    tremor = person._tremor(times, np.random.default_rng(1))
    power = np.abs(np.fft.rfft(tremor[:, 0])) ** 2
    frequency = np.fft.rfftfreq(len(times), 0.01)
    assert power[(frequency > 7.5) & (frequency < 12.5)].sum() > 0.95 * power.sum()
    assert np.sqrt((tremor**2).mean()) == pytest.approx(person.style.tremor, rel=0.2)


def test_unknown_glyphs_and_empty_libraries_are_refused() -> None:
    rng = np.random.default_rng(0)
    with pytest.raises(UnknownNameError, match="Unknown glyph 'heart'; known are 0, 1"):
        Person.sample(rng).draw("heart", rng)
    with pytest.raises(InvalidInputError, match="synthetic library: samples: expected at least 1, found 0"):
        synthetic_library(["1"], samples=0, rng=rng)
    with pytest.raises(InvalidInputError, match="synthetic library: writers"):
        synthetic_library(["1"], writers=0, rng=rng)


def test_a_reach_ends_near_the_object() -> None:
    rng = np.random.default_rng(2)
    for label in GOAL_LABELS:
        stroke = Person.sample(rng).draw(label, rng)
        assert np.linalg.norm(stroke.points[-1]) < 0.04 < np.linalg.norm(stroke.points[0])


def test_the_usual_spread_is_one_and_what_has_bounds_keeps_them() -> None:
    usual, same, wide = (Person.sample(np.random.default_rng(9), *spread) for spread in ((), (1.0,), (3.0,)))
    assert usual.style == same.style
    np.testing.assert_allclose(wide.habits["circle"], 3 * usual.habits["circle"])
    assert (wide.style.fluency, wide.style.roundness) == (usual.style.fluency, usual.style.roundness)
    assert np.log(wide.style.aspect) == pytest.approx(3 * np.log(usual.style.aspect))
