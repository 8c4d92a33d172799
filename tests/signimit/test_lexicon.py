"""Which signs there are: ways of writing one meaning are told apart, by hand and from people's signs."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit import DemonstrationSet, WordOrder, learn
from signimit.learners.base import Asked, Understanding
from signimit.lexicon import Sign, find_forms, find_lexicon
from signimit.teaching.composition import compose_demonstrations
from signimit.teaching.languages import Language
from signimit.teaching.people import synthetic_library
from signimit.teaching.stroke_sampler import as_source

Array = NDArray[np.float64]


def distances(forms: list[int], within: float, across: float) -> Array:
    kinds = np.array(forms)
    table = np.where(kinds[:, None] == kinds, within, across)
    np.fill_diagonal(table, 0.0)
    return table


@pytest.mark.parametrize(
    ("within", "across", "ways"),
    [
        (0.2, 0.9, 2),  # log(0.9 / 0.2) + log(0.9 / 0.55) = 2.0, above 0.75
        (0.2, 0.36, 1),  # log(0.36 / 0.2) + log(0.36 / 0.55) = 0.16
        (0.25, 0.55, 2),  # log(0.55 / 0.25) + 0 = 0.79
        (0.27, 0.55, 1),  # 0.71
        (0.6, 0.9, 2),  # log(0.9 / 0.6) + log(0.9 / 0.55) = 0.90
        (0.7, 0.9, 1),  # 0.74
    ],
)
def test_the_contrast_that_parts_ways_of_writing_by_hand(within: float, across: float, ways: int) -> None:
    forms = find_forms(distances([0, 0, 1, 1], within, across))
    assert forms.tolist() == ([0, 0, 1, 1] if ways == 2 else [0, 0, 0, 0])


@pytest.mark.parametrize("forms", [[0], [0, 1], [0, 0, 1], [0, 1, 0, 0, 0]])
def test_one_odd_sign_is_no_other_way_of_writing(forms: list[int]) -> None:
    assert not find_forms(distances(forms, 0.1, 1.1)).any()


def test_three_ways_of_writing_are_parted_one_after_another() -> None:
    forms = [0, 1, 2, 1, 0, 2, 2]
    assert find_forms(distances(forms, 0.1, 1.1)).tolist() == forms


def test_signs_that_were_seen_exactly_so_are_one_form() -> None:
    """As those of demonstrations that were passed twice are; pairs at one person's distance are no other way then."""
    assert not find_forms(np.zeros((5, 5))).any()
    assert not find_forms(distances([0, 0, 1, 1, 2, 2], 0.0, 0.35)).any()


@settings(deadline=None, derandomize=True, max_examples=30)
@given(st.permutations([0, 0, 0, 1, 1, 2, 2, 2]))
def test_forms_are_numbered_as_they_appear_in_whatever_order(forms: list[int]) -> None:
    found = find_forms(distances(forms, 0.15, 1.0)).tolist()
    assert list(dict.fromkeys(found)) == [0, 1, 2]
    assert len(set(zip(found, forms, strict=True))) == 3


def test_without_distances_each_meaning_has_one_sign_and_objects_come_first() -> None:
    known = Understanding(np.array([0, 1, 0]), np.array([2, 2, 0]), WordOrder(1, 0))
    assert find_lexicon(known) == (
        Sign("focus", 0, (2,)),
        Sign("focus", 2, (0, 1)),
        Sign("movement", 0, (0, 2)),
        Sign("movement", 1, (1,)),
    )


def test_signs_are_those_of_what_was_asked_for_not_of_what_was_done() -> None:
    asked = Asked(np.array([0, 1, 1]), np.array([0, 0, 1]))
    known = Understanding(np.array([0, 1, -1]), np.array([1, 0, -1]), WordOrder(0, 1), asked=asked)
    assert [(sign.role, sign.meaning, sign.exemplars) for sign in find_lexicon(known)] == [
        ("focus", 0, (0, 1)),
        ("focus", 1, (2,)),
        ("movement", 0, (0,)),
        ("movement", 1, (1, 2)),
    ]


PLAIN = Language(repetitions=4)


def session(seed: int, synonyms: dict[str, str]) -> tuple[DemonstrationSet, NDArray[np.int64]]:
    """Demonstrations whose words for objects have two signs each, in turn."""
    rng = np.random.default_rng(seed)
    signs = synthetic_library((*PLAIN.focus_signs, *PLAIN.movement_signs, *synonyms.values()), samples=12, rng=rng)
    shown, truth = compose_demonstrations(PLAIN, signs, synthetic_library(PLAIN.movements, samples=8, rng=rng), rng)
    demos, turn = list(shown), np.zeros(3, dtype=bool)
    for t, focus in enumerate(truth.focus):
        turn[focus] = not turn[focus]
        if synonyms and turn[focus]:
            other = as_source(signs).draw(synonyms[PLAIN.focus_signs[focus]], rng)
            demos[t] = replace(demos[t], signs=(other.points, demos[t].signs[1]))
    return DemonstrationSet(demos), truth.focus


@pytest.mark.parametrize("seed", [0, 1])
def test_two_ways_of_writing_each_object_are_found(seed: int) -> None:
    demos, focus = session(seed, {"1": "0", "2": "8", "3": "9"})
    model = learn(demos)
    np.testing.assert_array_equal(model.focus, focus)
    signs = [sign for sign in model.lexicon if sign.role == "focus"]
    assert [sign.meaning for sign in signs] == [0, 0, 1, 1, 2, 2]
    assert sum(sign.role == "movement" for sign in model.lexicon) == 3


@pytest.mark.parametrize("seed", [0, 1])
def test_people_with_one_sign_for_each_meaning_have_six(seed: int) -> None:
    demos, _ = session(seed, {})
    lexicon = learn(demos).lexicon
    assert [(sign.role, sign.meaning) for sign in lexicon] == [(r, m) for r in ("focus", "movement") for m in range(3)]
    for role in ("focus", "movement"):
        members = [t for sign in lexicon if sign.role == role for t in sign.exemplars]
        assert sorted(members) == list(range(len(demos)))
