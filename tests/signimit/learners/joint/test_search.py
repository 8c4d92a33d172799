"""The search never lowers the objective, ends where nobody wants to move, and finds what is planted."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit import WordOrder
from signimit.learners.joint.measurements import Measurements
from signimit.learners.joint.objective import NOTHING, PEOPLE, Hypothesis, Objective
from signimit.learners.joint.search import best_choices, best_partition_value, first_hypotheses, search

Array = NDArray[np.float64]
Labels = NDArray[np.int64]
properties = settings(deadline=None, derandomize=True, max_examples=30)
sessions = st.tuples(st.integers(1, 12), st.integers(1, 3), st.integers(0, 10_000))
ORDER = WordOrder(0, 1)


def random_objective(count: int, places: int, seed: int) -> tuple[Objective, list[Hypothesis]]:
    """Evidence that agrees with nothing, and all starts for it."""
    rng = np.random.default_rng(seed)
    unlike, words = rng.normal(-1, 4, (count, count)), rng.normal(0, 3, (2, count, count))
    unlike, words = unlike + unlike.T, words + words.transpose(0, 2, 1)
    words[:, np.arange(count), np.arange(count)] = 0.0
    offsets, place = rng.normal(0, 0.4, (count, places, 2)), rng.normal(0, 3, (count, places))
    seen = Measurements(unlike, np.zeros_like(words), offsets, place)
    return Objective(seen, words, ORDER, PEOPLE), first_hypotheses(seen, words[ORDER.movement], PEOPLE)


def planted(done: Labels, place: Labels, asked: Labels, focus: Labels) -> tuple[Objective, list[Hypothesis]]:
    """Drawings of three objects' scenes that lie at their places, and words that say what is asked for."""
    count = len(done)
    unlike = np.where(done[:, None] == done, -5.0, 3.0)
    unlike[done == NOTHING] = unlike[:, done == NOTHING] = 3.0
    offsets = np.random.default_rng(0).uniform(2, 9, (count, 3, 2))
    offsets[np.arange(count), place] = 0.0
    evidence = np.where(np.arange(3) == place[:, None], 2.0, -4.0)
    evidence[done == NOTHING] = -4.0
    words = np.stack([np.where(meaning[:, None] == meaning, 3.0, -3.0) for meaning in (focus, asked)])
    words[:, np.arange(count), np.arange(count)] = 0.0
    seen = Measurements(unlike, np.zeros_like(words), offsets, evidence)
    return Objective(seen, words, ORDER, PEOPLE), first_hypotheses(seen, words[ORDER.movement], PEOPLE)


class Watched(Objective):
    """An objective that notes its value before and after each move."""

    def __init__(self, objective: Objective) -> None:
        self.__dict__.update(objective.__dict__)
        self.starts: list[float] = []
        self.moves: list[tuple[float, float]] = []

    def start(self, hypothesis: Hypothesis) -> None:
        super().start(hypothesis)
        self.starts.append(self.value())

    def move(self, member: int, movement: int, place: int, asked_movement: int, asked_focus: int) -> None:
        before = self.value()
        super().move(member, movement, place, asked_movement, asked_focus)
        self.moves.append((before, self.value()))


def everything(known: Hypothesis) -> list[list[int]]:
    return [values.tolist() for values in known]


@properties
@given(sessions)
def test_no_move_of_a_search_lowers_the_objective(session: tuple[int, int, int]) -> None:
    objective, starts = random_objective(*session)
    _, found = search(watched := Watched(objective), starts)
    assert all(after > before for before, after in watched.moves)
    assert set(found.asked_movement) <= set(found.movement)  # what is asked for is shown


@properties
@given(sessions)
def test_what_is_found_is_no_worse_than_any_start_and_nobody_wants_to_move(session: tuple[int, int, int]) -> None:
    objective, starts = random_objective(*session)
    ranked = []
    for hypothesis in starts:
        objective.start(hypothesis)
        ranked.append(objective.value())
    before = [everything(hypothesis) for hypothesis in starts]
    value, found = search(objective, starts)
    assert [everything(hypothesis) for hypothesis in starts] == before
    assert value >= max(ranked) - 1e-9
    objective.start(found)
    assert objective.value() == pytest.approx(value)
    for t in range(session[0]):
        for choice in product(range(found.movement.max() + 1), range(session[1])):
            other = Hypothesis(*(values.copy() for values in found))
            other.movement[t] = other.asked_movement[t] = choice[0]
            other.place[t] = other.asked_focus[t] = choice[1]
            objective.start(other)
            assert objective.value() <= value + 1e-6


def test_the_six_highest_starts_are_followed() -> None:
    objective, starts = random_objective(12, 3, 0)
    assert len(starts) > 6
    search(watched := Watched(objective), starts)
    ranked, followed = watched.starts[: len(starts)], watched.starts[len(starts) :]
    assert followed == sorted(ranked, reverse=True)[:6]


def test_starts_are_of_drawings_alone_and_of_drawings_and_words() -> None:
    drawn, said = np.array([0, 0, 1, 1]), np.array([0, 1, 0, 1])
    unlike = np.where(drawn[:, None] == drawn, -2.0, 0.0)
    words = 9.0 * (said[:, None] == said)
    seen = Measurements(unlike, np.zeros((2, 4, 4)), np.zeros((4, 1, 2)), np.zeros((4, 1)))
    found = [start.movement.tolist() for start in first_hypotheses(seen, words, PEOPLE)]
    assert drawn.tolist() in found
    assert said.tolist() in found


@properties
@given(sessions)
def test_names_of_movements_are_nothing(session: tuple[int, int, int]) -> None:
    objective, starts = random_objective(*session)
    for hypothesis in starts:
        names = np.append(np.random.default_rng(session[2]).permutation(session[0] + 5), NOTHING)
        renamed = hypothesis._replace(movement=names[hypothesis.movement], asked_movement=names[hypothesis.movement])
        objective.start(hypothesis)
        first = objective.value()
        objective.start(renamed)
        assert objective.value() == first
        assert everything(objective.hypothesis) == everything(hypothesis.compact())


@properties
@given(sessions)
def test_sums_that_follow_the_moves_are_those_of_a_fresh_start(session: tuple[int, int, int]) -> None:
    objective, starts = random_objective(*session)
    rng = np.random.default_rng(session[2])
    objective.start(starts[0])
    for _ in range(6):
        movements = int(objective.hypothesis.movement.max()) + 2
        movement, place = int(rng.integers(-1, movements)), int(rng.integers(session[1]))
        shown = objective.hypothesis.movement[objective.hypothesis.movement != NOTHING]
        asked = int(rng.choice(shown)) if movement == NOTHING and len(shown) else max(movement, 0)
        objective.move(int(rng.integers(session[0])), movement, place, asked, int(rng.integers(session[1])))
        followed, scores = objective.value(), objective.scores()
        known = objective.hypothesis
        objective.start(known)
        assert objective.value() == pytest.approx(followed)
        order = list(dict.fromkeys(m for m in (*known.movement, *known.asked_movement) if m != NOTHING))
        columns = [*order, scores.done.shape[1] - 1]
        np.testing.assert_allclose(objective.scores().done, scores.done[:, columns], atol=1e-9)
        np.testing.assert_allclose(objective.scores().movement, scores.movement[:, columns], atol=1e-9)
        np.testing.assert_allclose(objective.scores().focus, scores.focus, atol=1e-9)


DONE = np.array([0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2])
PLACE = np.array([0, 0, 0, 1, 1, 1, 2, 2, 2, 0, 1, 2])


@pytest.mark.parametrize("kind", ["sound", "another movement", "another object", "beside the point"])
def test_what_is_planted_is_found(kind: str) -> None:
    done, place, asked, focus = DONE.copy(), PLACE.copy(), DONE.copy(), PLACE.copy()
    if kind == "another movement":
        asked[4] = 2
    if kind == "another object":
        focus[4] = 0
    if kind == "beside the point":
        done[4] = NOTHING
    objective, starts = planted(done, place, asked, focus)
    _, found = search(objective, starts)
    assert found.movement.tolist() == done.tolist()
    assert found.asked_movement.tolist() == asked.tolist()
    assert found.asked_focus.tolist() == focus.tolist()
    on_the_table = done != NOTHING
    assert found.place[on_the_table].tolist() == place[on_the_table].tolist()
    wrong = np.flatnonzero(~found.meant)
    assert wrong.tolist() == ([] if kind == "sound" else [4])


def test_what_is_found_in_three_demonstrations_is_the_best_of_all_answers() -> None:
    for seed in range(3):
        objective, starts = random_objective(3, 1, seed)
        best, nowhere_else = -np.inf, np.zeros(3, dtype=np.int64)
        for movement in product(range(-1, 3), repeat=3):
            shown = sorted(set(movement) - {NOTHING})
            for asked in product(shown, repeat=3):
                objective.start(Hypothesis(np.array(movement), nowhere_else, np.array(asked), nowhere_else))
                best = max(best, objective.value())
        assert search(objective, starts)[0] == pytest.approx(best)


def test_starts_are_one_to_twelve_movements_each_once_and_one_demonstration_has_one() -> None:
    rng = np.random.default_rng(0)
    for count, most in ((1, 1), (2, 1), (5, 4), (20, 12)):
        seen = Measurements(rng.normal(size=(count, count)), np.zeros((2, count, count)), *np.zeros((2, count, 3)))
        seen = seen._replace(drawings=seen.drawings + seen.drawings.T, place_evidence=np.eye(3)[np.arange(count) % 3])
        starts = first_hypotheses(seen, np.zeros((count, count)), PEOPLE)
        assert {int(start.movement.max()) + 1 for start in starts} == set(range(1, most + 1))
        assert len({tuple(start.movement) for start in starts}) == len(starts)
        for start in starts:
            assert start.meant.all()
            assert start.place.tolist() == [t % 3 for t in range(count)]


def test_a_choice_is_what_is_asked_for_or_something_else_or_beside_the_point() -> None:
    objective, _ = planted(DONE, PLACE, DONE, PLACE)
    objective.start(Hypothesis(DONE, PLACE, DONE, PLACE))
    scores = objective.scores()
    choices = best_choices(scores)
    assert choices.shape == (12, 3)
    assert (choices[:, 0] > choices[:, 1:].max(axis=1)).all()
    # twelve who do what they ask for: one that did something else would lose 3 nats and the choice among 3 x 3
    np.testing.assert_allclose(choices[:, 0] - choices[:, 1], 3 + np.log(9))


def test_words_that_mean_nothing_are_divided_at_no_price() -> None:
    kinds = np.array([0, 1, 0, 1, 1])
    evidence = np.where(kinds[:, None] == kinds, 2.0, -3.0)
    np.fill_diagonal(evidence, 0.0)
    # two signs: 2 nats for their pair, weighted 2 / 2; three: 6 for their three pairs, weighted 2 / 3
    assert best_partition_value(evidence) == pytest.approx(2 + 4)
    assert best_partition_value(np.zeros((1, 1))) == 0
    assert best_partition_value(-np.ones((4, 4)) + np.eye(4)) == 0  # none alike: each is its own
