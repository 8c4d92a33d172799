"""Imperfections change hands only, as many as they say, and the truth knows which."""

from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from signimit import DemonstrationSet, InvalidInputError, StrokeLibrary
from signimit.paths import box_centre
from signimit.teaching.composition import GroundTruth, compose_demonstrations
from signimit.teaching.imperfections import (
    CLEAR,
    SLOW_PERIOD,
    TREMOR,
    Imperfection,
    answer_wrongly,
    draw_beside_the_point,
    go_home,
    stop_early,
    tremble,
)
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit.teaching.people import SIGN_LABELS, synthetic_library
from signimit.teaching.scenes import LEAST_SEPARATION
from signimit.teaching.stroke_sampler import StrokeSampler

BESIDE = partial(draw_beside_the_point, labels=("star",))
DRAWN = 120  # samples at the end of a hand path that are certainly of a drawing


@pytest.fixture(scope="module")
def movements() -> StrokeLibrary:
    return synthetic_library((*PAPER_LANGUAGE.movements, "star"), samples=12, rng=np.random.default_rng(2))


@pytest.fixture(scope="module")
def session(movements: StrokeLibrary) -> tuple[DemonstrationSet, GroundTruth]:
    signs = synthetic_library(SIGN_LABELS, samples=8, rng=np.random.default_rng(1))
    return compose_demonstrations(PAPER_LANGUAGE, signs, movements, np.random.default_rng(3))


def spoil(
    session: tuple[DemonstrationSet, GroundTruth], movements: StrokeLibrary, imperfection: Imperfection
) -> tuple[DemonstrationSet, GroundTruth]:
    return imperfection(*session, StrokeSampler(movements), np.random.default_rng(4))


@pytest.mark.parametrize("imperfection", [partial(answer_wrongly, count=3), partial(BESIDE, count=3)])
def test_so_many_hands_do_something_else_and_the_truth_says_which(
    session: tuple[DemonstrationSet, GroundTruth], movements: StrokeLibrary, imperfection: Imperfection
) -> None:
    before = session[0]
    after, truth = spoil(session, movements, imperfection)
    other = [not np.array_equal(a.hand, b.hand) for a, b in zip(before, after, strict=True)]
    assert_array_equal(other, ~truth.sound)
    assert sum(other) == 3
    assert truth.requests == session[1].requests
    assert session[1].sound.all()
    for a, b in zip(before, after, strict=True):
        assert_array_equal(np.concatenate(a.signs), np.concatenate(b.signs))
        assert_array_equal(a.objects, b.objects)


def test_a_wrong_answer_is_what_another_request_asks_for(
    session: tuple[DemonstrationSet, GroundTruth], movements: StrokeLibrary
) -> None:
    after, truth = spoil(session, movements, partial(answer_wrongly, count=12))
    places = np.array([box_centre(d.hand[-DRAWN:]) for d in after])
    away = np.linalg.norm(after.objects - places[:, None], axis=2)
    assert (away.min(axis=1) < LEAST_SEPARATION / 2).all()
    assert (away.argmin(axis=1) != truth.focus).any()
    assert not truth.sound.any()


def test_what_is_beside_the_point_is_about_no_object(
    session: tuple[DemonstrationSet, GroundTruth], movements: StrokeLibrary
) -> None:
    after, truth = spoil(session, movements, partial(BESIDE, count=4))
    for t in truth.spoilt:
        place = box_centre(after[t].hand[-DRAWN // 2 :])
        assert np.linalg.norm(after[t].objects - place, axis=1).min() > CLEAR / 2


def test_a_hand_goes_home_by_a_smooth_reach_and_nothing_is_spoilt(
    session: tuple[DemonstrationSet, GroundTruth], movements: StrokeLibrary
) -> None:
    after, truth = spoil(session, movements, go_home)
    assert truth.sound.all()
    for a, b in zip(session[0], after, strict=True):
        assert_array_equal(b.hand[: len(a.hand)], a.hand)
        assert_array_equal(b.hand[-1], a.hand[0])
        home = np.linalg.norm(np.diff(b.hand[len(a.hand) - 1 :], axis=0), axis=1)
        assert 0 < home[0] < home.max() / 3
        assert home[-1] < home.max() / 3


def test_a_trembling_hand_is_seen_seldom_and_stays_near_its_way(
    session: tuple[DemonstrationSet, GroundTruth], movements: StrokeLibrary
) -> None:
    after, truth = spoil(session, movements, tremble)
    assert truth.sound.all()
    for a, b in zip(session[0], after, strict=True):
        np.testing.assert_allclose(np.diff(b.times), SLOW_PERIOD)
        off = np.abs(b.hand - a.hand[np.searchsorted(a.times, b.times - 1e-9)])
        assert TREMOR / 2 < off.max() <= TREMOR


def test_a_hand_that_stops_early_leaves_out_less_than_its_last_round(
    session: tuple[DemonstrationSet, GroundTruth], movements: StrokeLibrary
) -> None:
    after, truth = spoil(session, movements, stop_early)
    assert truth.sound.all()
    for a, b in zip(session[0], after, strict=True):
        assert len(a.hand) / 2 < len(b.hand) < len(a.hand)
        assert_array_equal(b.hand, a.hand[: len(b.hand)])


def test_wrong_answers_come_on_top_of_each_other_and_never_more_than_there_are_demonstrations(
    session: tuple[DemonstrationSet, GroundTruth], movements: StrokeLibrary
) -> None:
    once = spoil(session, movements, partial(answer_wrongly, count=6))
    twice = spoil(once, movements, partial(BESIDE, count=6))
    assert_array_equal(twice[1].spoilt, np.arange(12))
    with pytest.raises(InvalidInputError, match="at most 0 demonstrations that are spoilt, found 1"):
        spoil(twice, movements, answer_wrongly)


def test_the_truth_of_some_demonstrations_knows_which_of_them_are_sound(
    session: tuple[DemonstrationSet, GroundTruth], movements: StrokeLibrary
) -> None:
    _, truth = spoil(session, movements, partial(answer_wrongly, count=5))
    kept = np.array([7, 2, 11, 0, 4])
    assert_array_equal(truth.select(kept).sound, truth.sound[kept])
    assert truth.select(kept).requests == tuple(truth.requests[t] for t in kept)
