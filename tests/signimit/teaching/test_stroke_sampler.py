"""Decks deal no stroke twice while an unused one is left."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from signimit import Stroke, StrokeLibrary, UnknownNameError
from signimit.teaching.stroke_sampler import StrokeSampler, as_sampler


def library(**counts: int) -> StrokeLibrary:
    """Strokes labelled "x", so many by each writer."""
    strokes = [Stroke(np.array([(0, 0), (1, i)]), np.array([0, 1.0])) for i in range(sum(counts.values()))]
    writers = [writer for writer, count in counts.items() for _ in range(count)]
    return StrokeLibrary(tuple(strokes), ("x",) * len(strokes), tuple(writers))


@given(a=st.integers(1, 6), b=st.integers(1, 6), seed=st.integers(0, 99))
@settings(deadline=None, derandomize=True, max_examples=30)
def test_every_stroke_is_dealt_once_before_any_comes_again(a: int, b: int, seed: int) -> None:
    deck, rng = StrokeSampler(library(ann=a, bob=b)), np.random.default_rng(seed)
    first = [deck.draw("x", rng)[0] for _ in range(a + b)]
    assert {id(s) for s in first} == {id(s) for s in deck.library}
    assert deck.draw("x", rng)[0] in first


def test_several_are_dealt_from_one_writer() -> None:
    strokes = library(ann=4, bob=4)
    deck, rng = StrokeSampler(strokes), np.random.default_rng(0)
    writer = {id(s): w for s, w in zip(strokes, strokes.writers, strict=True)}
    pairs = [deck.draw("x", rng, 2) for _ in range(4)]
    assert all(writer[id(a)] == writer[id(b)] for a, b in pairs)
    assert len({id(s) for pair in pairs for s in pair}) == 8


def test_a_writer_with_too_few_is_left_while_another_has_enough() -> None:
    deck, rng = StrokeSampler(library(ann=1, bob=2)), np.random.default_rng(0)
    assert {id(s) for s in deck.draw("x", rng, 2)} == {id(s) for s in deck.library[1:]}


def test_a_single_stroke_is_dealt_again_and_again() -> None:
    deck, rng = StrokeSampler(library(ann=1)), np.random.default_rng(0)
    assert [id(s) for s in deck.draw("x", rng, 2)] == [id(deck.library[0])] * 2


def test_the_same_generator_state_deals_the_same() -> None:
    hands = [
        [id(s) for s in StrokeSampler(cards).draw("x", np.random.default_rng(4), 5)] for cards in [library(a=9)] * 2
    ]
    assert hands[0] == hands[1]


def test_a_label_that_nobody_drew_is_refused_with_those_there_are() -> None:
    with pytest.raises(UnknownNameError, match="Unknown label 'y'; known are x"):
        StrokeSampler(library(a=1)).draw("y", np.random.default_rng(0))


def test_a_deck_stays_the_same_deck() -> None:
    deck = StrokeSampler(library(a=1))
    assert as_sampler(deck) is deck
    assert as_sampler(deck.library) is not deck
