"""Cells compose what their names say, the same again for the same seed."""

from collections import Counter

import numpy as np
import pytest

from signimit import InvalidInputError
from signimit.benchmark.studies.cells import NOISE, Cell, People, compose_session, study_cells, wavering
from signimit.teaching.people import synthetic_library


def small(condition: str) -> Cell:
    return Cell(movements=3, objects=3, repetitions=1, condition=condition)


@pytest.mark.parametrize("condition", ["plain", "noise", "unbalanced", "mixed"])
def test_the_same_cell_and_seed_give_the_same_session(condition: str) -> None:
    first, again = (compose_session(small(condition), 3) for _ in range(2))
    for a, b in zip(first.demonstrations, again.demonstrations, strict=True):
        np.testing.assert_array_equal(a.hand, b.hand)
        np.testing.assert_array_equal(np.concatenate(a.signs), np.concatenate(b.signs))
    other = compose_session(small(condition), 4)
    assert not np.array_equal(first.demonstrations[0].objects, other.demonstrations[0].objects)


def test_every_pair_is_shown_and_asked_for_in_the_plain_condition() -> None:
    session = compose_session(Cell(movements=2, objects=3, repetitions=2), 0)
    shown = Counter(session.truth.requests)
    assert len(shown) == 6
    assert set(shown.values()) == {2}
    assert [pair for pair, _, _ in session.commands] == sorted(shown)


def test_one_pair_in_three_is_never_shown_but_asked_for() -> None:
    session = compose_session(small("unseen third"), 0)
    assert len(set(session.truth.requests)) == 6
    assert len(session.commands) == 9


def test_unbalanced_counts_are_three_and_one() -> None:
    counts = Counter(compose_session(small("unbalanced"), 0).truth.requests)
    assert {count for pair, count in counts.items() if pair.movement % 2} == {1}
    assert {count for pair, count in counts.items() if not pair.movement % 2} == {3}


@pytest.mark.parametrize(("condition", "places"), [("swapped", (1, 0, 2)), ("constant filler", (2, 0, 3))])
def test_words_stand_where_the_condition_says(condition: str, places: tuple[int, int, int]) -> None:
    session = compose_session(small(condition), 0)
    language = session.truth.language
    assert (language.focus_word, language.movement_word, len(session.demonstrations[0].signs)) == places


def test_the_waver_has_the_amount_it_says() -> None:
    library = synthetic_library(("circle",), samples=40, rng=np.random.default_rng(0))
    noisy = wavering(library, np.random.default_rng(1))
    shares = [
        np.sqrt(np.mean((a.points - b.points) ** 2)) / (np.ptp(b.points, axis=0).max() / 2)
        for a, b in zip(noisy.strokes, library.strokes, strict=True)
    ]
    assert np.mean(shares) == pytest.approx(NOISE, rel=0.15)


def test_people_are_chosen_among_those_who_drew_everything() -> None:
    rng, cell = np.random.default_rng(0), Cell(movements=2, objects=2, repetitions=1)
    signs = synthetic_library("0123456789", samples=3, rng=rng)
    movements = synthetic_library(("triangle up", "triangle down"), samples=4, rng=rng)
    assert len(compose_session(cell, 0, People(signs, movements)).demonstrations) == 4
    with pytest.raises(InvalidInputError, match="somebody who drew"):
        compose_session(cell, 0, People(signs, signs))


def test_cells_have_names_of_their_own_and_those_of_real_people_come_last() -> None:
    cells = study_cells(real=True)
    assert len({c.name for c in cells}) == len(cells)
    assert [c.name for c in cells[: len(study_cells(real=False))]] == [c.name for c in study_cells(real=False)]


@pytest.mark.parametrize("changes", [{"movements": 9}, {"objects": 7}, {"condition": "drunk"}, {"movements": 0}])
def test_cells_that_nobody_can_play_are_refused(changes: dict[str, object]) -> None:
    with pytest.raises(InvalidInputError, match="cell"):
        Cell(**({"movements": 2, "objects": 2, "repetitions": 1} | changes))  # type: ignore[arg-type]
