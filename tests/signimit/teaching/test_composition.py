"""Sessions composed from strokes: what is in them, and that the truth cannot be reached from them."""

import gc
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from signimit import DemonstrationSet, InvalidInputError, StrokeLibrary, UnknownNameError
from signimit.teaching.composition import (
    GroundTruth,
    compose_demonstrations,
    compose_loops,
    compose_path,
    compose_prototypes,
    compose_utterance,
    movement_templates,
)
from signimit.teaching.languages import PAPER_LANGUAGE, Language
from signimit.teaching.people import GOAL_LABELS, MOVEMENT_LABELS, SIGN_LABELS, synthetic_library
from signimit.teaching.stroke_sampler import StrokeSampler


@pytest.fixture(scope="module")
def signs() -> StrokeLibrary:
    return synthetic_library(SIGN_LABELS, samples=8, rng=np.random.default_rng(1))


@pytest.fixture(scope="module")
def movements() -> StrokeLibrary:
    return synthetic_library(MOVEMENT_LABELS + GOAL_LABELS, samples=9, rng=np.random.default_rng(2))


@pytest.fixture(scope="module")
def session(signs: StrokeLibrary, movements: StrokeLibrary) -> tuple[DemonstrationSet, GroundTruth]:
    return compose_demonstrations(PAPER_LANGUAGE, signs, movements, np.random.default_rng(3))


def label_of(points: np.ndarray, library: StrokeLibrary) -> str:
    return next(
        label for s, label in zip(library, library.labels, strict=True) if s.points.tobytes() == points.tobytes()
    )


def test_the_papers_session_has_twelve_demonstrations_two_of_each_request_shown(
    session: tuple[DemonstrationSet, GroundTruth],
) -> None:
    demonstrations, truth = session
    assert len(demonstrations) == len(truth.movement) == len(truth.focus) == 12
    assert sorted(truth.requests) == sorted(PAPER_LANGUAGE.seen * 2)
    assert list(truth.requests) != sorted(truth.requests)  # shuffled
    assert truth.movement_names[0] == PAPER_LANGUAGE.movements[truth.movement[0]]


def test_signs_are_the_languages_words_in_its_order(
    session: tuple[DemonstrationSet, GroundTruth], signs: StrokeLibrary
) -> None:
    for demonstration, (movement, focus) in zip(*((session[0]), session[1].requests), strict=True):
        first, second = (label_of(sign, signs) for sign in demonstration.signs)
        assert (first, second) == (PAPER_LANGUAGE.focus_signs[focus], PAPER_LANGUAGE.movement_signs[movement])


def test_the_hand_draws_twice_about_the_object_asked_for(session: tuple[DemonstrationSet, GroundTruth]) -> None:
    demonstrations, truth = session
    for demonstration, (_, focus) in zip(demonstrations, truth.requests, strict=True):
        tail = demonstration.hand[len(demonstration.hand) // 2 :]  # the second loop, at least
        centre = (tail.min(axis=0) + tail.max(axis=0)) / 2 - demonstration.objects[focus]
        assert np.linalg.norm(centre) < 0.03
        assert 0.08 < np.ptp(tail, axis=0).max() / 2 < 0.14
        assert_allclose(np.diff(demonstration.times), 0.02)
        steps = np.linalg.norm(np.diff(demonstration.hand, axis=0), axis=1) / 0.02
        assert steps.max() < 1.5


def test_no_stroke_is_shown_twice(session: tuple[DemonstrationSet, GroundTruth]) -> None:
    words = [sign.tobytes() for demonstration in session[0] for sign in demonstration.signs]
    assert len(set(words)) == 24
    loops = [loop.tobytes() for drawings in session[1].templates for loop in drawings]
    assert len(set(loops)) == 24


def test_a_shared_sampler_remembers_across_calls(signs: StrokeLibrary) -> None:
    sampler, rng = StrokeSampler(signs), np.random.default_rng(0)
    asked = [compose_utterance(PAPER_LANGUAGE, sampler, 0, 0, rng)[0].tobytes() for _ in range(8)]
    assert len(set(asked)) == 8


def test_the_same_generator_state_composes_the_same_bytes(signs: StrokeLibrary, movements: StrokeLibrary) -> None:
    def bytes_of(seed: int) -> list[bytes]:
        made, _ = compose_demonstrations(PAPER_LANGUAGE, signs, movements, np.random.default_rng(seed))
        return [array.tobytes() for array in made.to_arrays().values()]

    assert bytes_of(5) == bytes_of(5)
    assert bytes_of(5) != bytes_of(6)


def test_a_published_seed_keeps_its_session() -> None:
    signs = synthetic_library(SIGN_LABELS, samples=2, rng=np.random.default_rng(0))
    movements = synthetic_library(PAPER_LANGUAGE.movements, samples=2, rng=np.random.default_rng(1))
    made, truth = compose_demonstrations(PAPER_LANGUAGE, signs, movements, np.random.default_rng(2))
    assert truth.requests[0] == (1, 0)
    assert_allclose(made[0].objects, [(0.027397, -0.125978), (-0.029642, 0.060947), (0.205672, 0.065903)], atol=1e-6)
    assert made[0].hand.shape == (236, 2)
    assert_allclose(made[0].hand[-1], (-0.059112, -0.019633), atol=1e-6)


def test_labels_and_truth_cannot_be_reached_from_the_demonstrations(
    session: tuple[DemonstrationSet, GroundTruth],
) -> None:
    waiting: list[object] = [session[0]]
    seen: set[int] = set()
    while waiting:
        thing = waiting.pop()
        if id(thing) in seen or isinstance(thing, type):
            continue
        seen.add(id(thing))
        assert not isinstance(thing, (GroundTruth, Language, StrokeLibrary, StrokeSampler))
        assert not (isinstance(thing, str) and thing in (*SIGN_LABELS, *MOVEMENT_LABELS))
        waiting += gc.get_referents(thing)


def test_truth_cannot_be_written(session: tuple[DemonstrationSet, GroundTruth]) -> None:
    for array in (session[1].movement, session[1].focus, session[1].templates[0][0]):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


def test_word_order_and_filler_are_obeyed(signs: StrokeLibrary, movements: StrokeLibrary) -> None:
    language = Language(focus_word=2, movement_word=0, filler_signs=("0",))
    made, truth = compose_demonstrations(language, signs, movements, np.random.default_rng(0))
    for demonstration, (movement, focus) in zip(made, truth.requests, strict=True):
        words = [label_of(sign, signs) for sign in demonstration.signs]
        assert words == [language.movement_signs[movement], "0", language.focus_signs[focus]]


def test_more_objects_and_movements_than_the_papers(signs: StrokeLibrary, movements: StrokeLibrary) -> None:
    language = Language(
        focus_signs=("0", "1", "2", "3"), movement_signs=("4", "5"), movements=("star", "zigzag"), repetitions=1
    )
    made, truth = compose_demonstrations(language, signs, movements, np.random.default_rng(0))
    assert made.objects.shape == (6, 4, 2)
    assert set(truth.movement_names) == {"star", "zigzag"}


def test_templates_are_drawn_about_the_origin(movements: StrokeLibrary) -> None:
    templates = movement_templates(PAPER_LANGUAGE, movements, np.random.default_rng(0), count=3)
    assert [len(drawings) for drawings in templates] == [3, 3, 3]
    for loop in (loop for drawings in templates for loop in drawings):
        assert_allclose(loop.min(axis=0) + loop.max(axis=0), 0, atol=1e-3)
        assert 0.085 < np.ptp(loop, axis=0).max() / 2 <= 0.12


def test_a_reach_is_made_once_and_ends_at_the_object(movements: StrokeLibrary) -> None:
    language = Language(movements=("reach from the left",), movement_signs=("4",))
    (reach,) = compose_loops(language, movements, 0, np.random.default_rng(0))
    assert_allclose(reach[-1], 0, atol=1e-12)
    assert reach[0, 0] < -0.15


def test_a_path_starts_at_the_hand_and_holds_each_loop_whole() -> None:
    loop = np.array([(0.1, 0.0), (0.0, 0.1), (-0.1, 0.0)])
    path = compose_path(np.array([0.2, 0.2]), [loop, loop + 0.01])
    assert_allclose(path[0], (0.2, 0.2))
    assert_allclose(path[-3:], loop + 0.01)
    assert any(np.array_equal(path[i : i + 3], loop) for i in range(len(path)))


def test_prototypes_are_the_languages(signs: StrokeLibrary) -> None:
    strokes = compose_prototypes(PAPER_LANGUAGE, signs, np.random.default_rng(0))
    assert [label_of(s.points, signs) for s in strokes] == ["7", "8", "9"]


def test_a_library_without_a_word_or_a_movement_is_refused(signs: StrokeLibrary, movements: StrokeLibrary) -> None:
    rng = np.random.default_rng(0)
    with pytest.raises(UnknownNameError, match=r"Unknown label '[23]'; known are 1"):
        compose_demonstrations(PAPER_LANGUAGE, signs.select("1"), movements, rng)
    with pytest.raises(UnknownNameError, match=r"Unknown label 'triangle"):
        compose_demonstrations(PAPER_LANGUAGE, signs, movements.select("circle"), rng)


def test_requests_outside_the_language_are_refused(signs: StrokeLibrary) -> None:
    for movement, focus in ((3, 0), (0, 3), (-1, 0)):
        with pytest.raises(InvalidInputError, match="an index below 3"):
            compose_utterance(PAPER_LANGUAGE, signs, movement, focus, np.random.default_rng(0))


def test_a_language_says_how_often_a_movement_is_drawn(movements: StrokeLibrary) -> None:
    for rounds in (1, 2, 3):
        language = replace(PAPER_LANGUAGE, rounds=rounds)
        assert len(compose_loops(language, movements, 0, np.random.default_rng(0))) == rounds
    with pytest.raises(InvalidInputError, match="language: rounds: expected at least 1, found 0"):
        replace(PAPER_LANGUAGE, rounds=0)
