"""Samplers draw no stroke twice while an unused one is left, or whatever was drawn before."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from signimit import Stroke, StrokeLibrary, UnknownNameError
from signimit.teaching.people import synthetic_library
from signimit.teaching.stroke_sampler import ReplacingSampler, StrokeSampler, SynonymSource, as_source


def library(**counts: int) -> StrokeLibrary:
    """Strokes labelled "x", so many by each writer."""
    strokes = [Stroke(np.array([(0, 0), (1, i)]), np.array([0, 1.0])) for i in range(sum(counts.values()))]
    writers = [writer for writer, count in counts.items() for _ in range(count)]
    return StrokeLibrary(tuple(strokes), ("x",) * len(strokes), tuple(writers))


@given(a=st.integers(1, 6), b=st.integers(1, 6), seed=st.integers(0, 99))
@settings(deadline=None, derandomize=True, max_examples=30)
def test_every_stroke_is_drawn_once_before_any_comes_again(a: int, b: int, seed: int) -> None:
    sampler, rng = StrokeSampler(library(ann=a, bob=b)), np.random.default_rng(seed)
    first = [sampler.draw("x", rng) for _ in range(a + b)]
    assert {id(s) for s in first} == {id(s) for s in sampler.library}
    assert sampler.draw("x", rng) in first


def test_several_are_drawn_from_one_writer() -> None:
    strokes = library(ann=4, bob=4)
    sampler, rng = StrokeSampler(strokes), np.random.default_rng(0)
    writer = {id(s): w for s, w in zip(strokes, strokes.writers, strict=True)}
    pairs = [sampler.draw_several("x", rng, 2) for _ in range(4)]
    assert all(writer[id(a)] == writer[id(b)] for a, b in pairs)
    assert len({id(s) for pair in pairs for s in pair}) == 8


def test_a_writer_with_too_few_is_left_while_another_has_enough() -> None:
    sampler, rng = StrokeSampler(library(ann=1, bob=2)), np.random.default_rng(0)
    assert {id(s) for s in sampler.draw_several("x", rng, 2)} == {id(s) for s in sampler.library[1:]}


def test_a_single_stroke_is_drawn_again_and_again() -> None:
    sampler, rng = StrokeSampler(library(ann=1)), np.random.default_rng(0)
    assert [id(s) for s in sampler.draw_several("x", rng, 2)] == [id(sampler.library[0])] * 2


def test_the_same_generator_state_draws_the_same() -> None:
    drawn = [
        [id(s) for s in StrokeSampler(cards).draw_several("x", np.random.default_rng(4), 5)]
        for cards in [library(a=9)] * 2
    ]
    assert drawn[0] == drawn[1]


def test_a_label_that_nobody_drew_is_refused_with_those_there_are() -> None:
    with pytest.raises(UnknownNameError, match="Unknown label 'y'; known are x"):
        StrokeSampler(library(a=1)).draw("y", np.random.default_rng(0))


def test_a_sampler_stays_the_same_sampler() -> None:
    sampler = StrokeSampler(library(a=1))
    assert as_source(sampler) is sampler
    assert as_source(sampler.library) is not sampler


def test_with_replacement_the_generator_alone_decides() -> None:
    sampler = ReplacingSampler(library(ann=3, bob=3))
    first, again = (sampler.draw_several("x", np.random.default_rng(1), 20) for _ in range(2))
    assert [id(s) for s in first] == [id(s) for s in again]
    assert len({id(s) for s in first}) == 6
    with pytest.raises(UnknownNameError, match="Unknown label 'y'; known are x"):
        sampler.draw("y", np.random.default_rng(0))


def test_two_ways_of_one_sign_come_in_turn_and_other_signs_as_they_are() -> None:
    person = synthetic_library("17", samples=4, rng=np.random.default_rng(0))
    label_of = {stroke.points.tobytes(): label for stroke, label in zip(person, person.labels, strict=True)}
    source, rng = SynonymSource(StrokeSampler(person), {"1": "7"}), np.random.default_rng(0)
    drawn = [label_of[source.draw(label, rng).points.tobytes()] for label in "11711"]
    assert drawn == ["1", "7", "7", "1", "7"]
    assert {label_of[stroke.points.tobytes()] for stroke in source.draw_several("1", rng, 2)} == {"1"}
