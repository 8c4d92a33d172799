"""Small sessions of every hard kind are understood, and degenerate ones answered."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit import Demonstration, DemonstrationSet, ImitationModel, WordOrder, learn
from signimit.learners.joint.learner import word_orders
from signimit.learners.joint.measurements import measure
from signimit.learners.joint.objective import PEOPLE, Hypothesis, Objective, word_evidence
from signimit.learners.joint.search import best_partition_value
from signimit.strokes import StrokeLibrary
from signimit.teaching.composition import GroundTruth, compose_demonstrations, compose_utterance
from signimit.teaching.languages import Language, Request
from signimit.teaching.people import synthetic_library

Array = NDArray[np.float64]
PLAIN = Language()
FILLERS = Language(filler_signs=("0", "7", "8"), focus_word=2, movement_word=0)

FOUR = Language(movements=("circle", "square", "star", "zigzag"), movement_signs=("4", "5", "6", "0"), repetitions=1)


@cache
def people(language: Language, seed: int) -> tuple[StrokeLibrary, StrokeLibrary]:
    """Return one person who signs and one who moves."""
    rng = np.random.default_rng([seed, 1])
    signs = (*language.focus_signs, *language.movement_signs, *language.filler_signs)
    return synthetic_library(signs, samples=10, rng=rng), synthetic_library(language.movements, samples=10, rng=rng)


@cache
def shown(language: Language, seed: int) -> tuple[DemonstrationSet, GroundTruth]:
    return compose_demonstrations(language, *people(language, seed), np.random.default_rng(seed))


@cache
def learned(language: Language, seed: int) -> ImitationModel:
    return learn(shown(language, seed)[0])


def same_partition(labels: NDArray[np.int64], others: NDArray[np.int64]) -> bool:
    pairs = set(zip(labels.tolist(), others.tolist(), strict=True))
    return len(pairs) == len(set(labels.tolist())) == len(set(others.tolist()))


@pytest.mark.parametrize(
    "language",
    [
        PLAIN,
        Language(focus_word=1, movement_word=0),
        FILLERS,
        Language(unseen=(Request(0, 0), Request(1, 1), Request(2, 2), Request(0, 1))),
        Language(unseen=(Request(2, 0), Request(2, 1), Request(0, 2))),  # movement 2 about one object only
        FOUR,
    ],
    ids=["plain", "swapped order", "filler word", "unseen pairs", "movement of one object", "four movements, once"],
)
@pytest.mark.parametrize("seed", [0, 1])
def test_everything_is_understood(language: Language, seed: int, request: pytest.FixtureRequest) -> None:
    if (language, seed) == (FOUR, 1):
        why = "star and zigzag, drawn twice each, asked for by a 6 and a 0 that look alike, are taken for one"
        request.applymarker(pytest.mark.xfail(strict=True, reason=why))
    model, truth = learned(language, seed), shown(language, seed)[1]
    assert same_partition(model.labels, truth.movement)
    np.testing.assert_array_equal(model.focus, truth.focus)
    assert model.word_order == (language.focus_word, language.movement_word)


def test_a_movement_shown_once_is_a_movement_of_its_own() -> None:
    demos, truth = shown(PLAIN, 2)
    kept = [t for t in range(12) if truth.movement[t] != 2] + [int(np.flatnonzero(truth.movement == 2)[0])]
    model = learn(DemonstrationSet([demos[t] for t in kept]))
    assert same_partition(model.labels, truth.movement[kept])
    np.testing.assert_array_equal(model.focus, truth.focus[kept])


def test_pairs_that_were_never_shown_are_answered() -> None:
    model, truth = learned(PLAIN, 0), shown(PLAIN, 0)[1]
    named = {m: int(model.labels[np.flatnonzero(truth.movement == m)[0]]) for m in range(3)}
    for m, f in PLAIN.held_back:
        signs = compose_utterance(PLAIN, people(PLAIN, 0)[0], m, f, np.random.default_rng(9))
        response = model.respond(signs, np.array([[0.0, 0.0], [0.2, 0.0], [0.0, 0.2]]))
        assert (response.movement, response.focus) == (named[m], f)
        assert 1 / 9 < response.confidence <= 1


def beside(demonstration: Demonstration, focus: int, other: int) -> Demonstration:
    """Put another object where the one in focus lies."""
    objects = demonstration.objects.copy()
    objects[other] = objects[focus]
    return replace(demonstration, objects=objects)


def ambiguous(readable: bool) -> tuple[NDArray[np.int64], NDArray[np.int64], Array]:
    """Learn with two objects of demonstration 4 in one place.

    Returns:
        Those objects, the focused one first; the true foci; the model's belief in each object.
    """
    demos, truth = shown(PLAIN, 0)
    pair = np.array([truth.focus[4], (truth.focus[4] + 1) % 3])
    doubtful = beside(demos[4], *pair)
    if not readable:
        doubtful = replace(doubtful, signs=(doubtful.signs[0][::-1], doubtful.signs[1]))
    model = learn(DemonstrationSet([*demos[:4], doubtful, *demos[5:]]))
    return pair, truth.focus, model.diagnostics["focus_probability"]


def test_a_sign_that_nobody_knows_leaves_two_objects_in_one_place_in_doubt() -> None:
    pair, focus, belief = ambiguous(readable=False)
    assert belief[4, pair].min() > 0.05
    assert belief[4, pair].sum() > 0.99
    others = np.delete(np.arange(12), 4)
    assert (belief[others, focus[others]] > 0.9).all()


def test_a_known_sign_tells_two_objects_in_one_place_apart() -> None:
    pair, _, belief = ambiguous(readable=True)
    assert belief[4].argmax() == pair[0]


def test_beliefs_are_probabilities_and_agree_with_the_answer() -> None:
    model = learned(PLAIN, 1)
    focus, movement = (model.diagnostics[f"{name}_probability"] for name in ("focus", "movement"))
    np.testing.assert_allclose(focus.sum(axis=1), 1)
    np.testing.assert_allclose(movement.sum(axis=1), 1)
    np.testing.assert_array_equal(focus.argmax(axis=1), model.focus)
    np.testing.assert_array_equal(movement.argmax(axis=1), model.labels)


def test_the_evidence_for_the_word_order_is_that_of_the_order_chosen() -> None:
    evidence = learned(FILLERS, 0).diagnostics["word_order_evidence"]
    assert evidence.max() == evidence[learned(FILLERS, 0).word_order]
    assert np.isneginf(np.diag(evidence)).all()


def test_the_evidence_for_an_order_is_the_objective_and_the_partition_of_words_that_mean_nothing() -> None:
    model, seen = learned(FILLERS, 0), measure(shown(FILLERS, 0)[0])
    words = word_evidence(seen.sign_distances, PEOPLE)
    objective = Objective(seen, words, model.word_order, PEOPLE)
    asked = model.understanding.requests
    objective.start(Hypothesis(model.labels, model.focus, asked.movement, asked.focus))
    expected = objective.value() + best_partition_value(words[1])
    assert best_partition_value(words[1]) > 1
    assert model.diagnostics["word_order_evidence"][model.word_order] == pytest.approx(expected)


@pytest.mark.parametrize("seed", [0, 1])
def test_the_order_of_demonstrations_does_not_matter(seed: int) -> None:
    demos, order = shown(PLAIN, seed)[0], np.random.default_rng(seed).permutation(12)
    model, shuffled = learned(PLAIN, seed), learn(DemonstrationSet([demos[t] for t in order]))
    assert same_partition(shuffled.labels, model.labels[order])
    np.testing.assert_array_equal(shuffled.focus, model.focus[order])
    assert shuffled.word_order == model.word_order


def test_where_the_table_stands_does_not_matter() -> None:
    demos, shift = shown(PLAIN, 1)[0], np.array([0.3, -0.5])
    moved = [replace(d, objects=d.objects + shift, hand=d.hand + shift) for d in demos]
    model, again = learned(PLAIN, 1), learn(DemonstrationSet(moved))
    np.testing.assert_array_equal(again.labels, model.labels)
    np.testing.assert_array_equal(again.focus, model.focus)


def test_the_same_demonstrations_give_the_same_bytes() -> None:
    first, again = learned(PLAIN, 0), learn(shown(PLAIN, 0)[0], rng=7)
    assert first.labels.tobytes() == again.labels.tobytes()
    for name, array in first.diagnostics.items():
        assert array.tobytes() == again.diagnostics[name].tobytes()


def test_a_saved_model_answers_as_before(tmp_path: Path) -> None:
    model = learned(PLAIN, 0)
    model.save(tmp_path / "model.npz")
    loaded = ImitationModel.load(tmp_path / "model.npz")
    signs = compose_utterance(PLAIN, people(PLAIN, 0)[0], 1, 2, np.random.default_rng(3))
    ours, theirs = (m.respond(signs, shown(PLAIN, 0)[0][0].objects) for m in (model, loaded))
    assert (ours.movement, ours.focus, ours.confidence) == (theirs.movement, theirs.focus, theirs.confidence)


def test_word_orders_are_all_pairs_of_places_and_one_word_is_both() -> None:
    assert word_orders(1) == [WordOrder(0, 0)]
    assert word_orders(2) == [WordOrder(0, 1), WordOrder(1, 0)]
    assert len(set(word_orders(4))) == 12
    assert all(order.focus != order.movement for order in word_orders(4))


@pytest.mark.parametrize("extra", [1, 3])
def test_words_that_mean_nothing_do_not_mislead(extra: int) -> None:
    """Movement and focus stand first and last; between them stand signs that follow nothing."""
    demos, truth = shown(PLAIN, 0)
    rng, pool = np.random.default_rng(5), people(FILLERS, 0)[0].strokes
    chatty = []
    for d in demos:
        idle = tuple(pool[int(rng.integers(len(pool)))].points for _ in range(extra))
        chatty.append(replace(d, signs=(d.signs[1], *idle, d.signs[0])))
    model = learn(DemonstrationSet(chatty))
    assert model.word_order == (extra + 1, 0)
    assert same_partition(model.labels, truth.movement)
    np.testing.assert_array_equal(model.focus, truth.focus)


def one_word(demos: DemonstrationSet) -> list[Demonstration]:
    return [replace(d, signs=d.signs[:1]) for d in demos]


def one_object(demos: DemonstrationSet) -> list[Demonstration]:
    return [replace(d, objects=d.objects[:1]) for d in demos]


def piled(demos: DemonstrationSet) -> list[Demonstration]:
    return [replace(d, objects=np.zeros_like(d.objects)) for d in demos]


def two_samples(demos: DemonstrationSet) -> list[Demonstration]:
    return [replace(d, hand=d.hand[[0, -1]], times=d.times[[0, -1]]) for d in demos]


DEGENERATE: dict[str, Callable[[DemonstrationSet], list[Demonstration]]] = {
    "one demonstration": lambda demos: [demos[0]],
    "two demonstrations": lambda demos: list(demos[:2]),
    "identical demonstrations": lambda demos: [demos[0]] * 5,
    "one object": one_object,
    "one word": one_word,
    "objects on top of each other": piled,
    "hands of two samples": two_samples,
}


@pytest.mark.parametrize("kind", DEGENERATE)
def test_degenerate_sets_are_answered(kind: str) -> None:
    demos = DemonstrationSet(DEGENERATE[kind](shown(PLAIN, 0)[0]))
    model = learn(demos)
    response = model.respond(demos[0].signs, demos[0].objects)
    assert model.labels.shape == model.focus.shape == (len(demos),)
    assert 0 < response.confidence <= 1
    assert np.isfinite(response.policy(np.zeros(2))).all()


def test_nobody_is_doubted_who_is_alone() -> None:
    model = learn(DemonstrationSet(shown(PLAIN, 0)[0][:1]))
    assert model.labels.tolist() == [0]
    assert model.trust.tolist() == [1]
    assert [(sign.role, sign.exemplars) for sign in model.lexicon] == [("focus", (0,)), ("movement", (0,))]


@pytest.mark.parametrize("copies", [2, 12])
def test_demonstrations_passed_twice_make_no_new_movements(copies: int) -> None:
    demos, truth = shown(PLAIN, 0)
    model = learn(DemonstrationSet([*demos, *list(demos)[:copies]]))
    assert same_partition(model.labels, np.append(truth.movement, truth.movement[:copies]))


def test_the_same_demonstration_again_and_again_is_one_movement() -> None:
    model = learn(DemonstrationSet([shown(PLAIN, 0)[0][0]] * 5))
    assert model.labels.tolist() == [0] * 5
    assert len(set(model.focus.tolist())) == 1
