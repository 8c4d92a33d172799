"""Conditions compose what their names say, the same again for the same seed."""

from collections import Counter

import numpy as np
import pytest

from signimit import InvalidInputError, StrokeLibrary
from signimit.benchmark.studies.conditions import (
    AS_WITH_A_MOUSE,
    BESIDE,
    IMPERFECT,
    Recordings,
    compose_study_session,
    study_condition,
    study_conditions,
)
from signimit.teaching.people import synthetic_library
from signimit.teaching.sessions import Condition


def small(variant: str) -> Condition:
    return study_condition(3, 3, 1, variant)


@pytest.mark.parametrize("variant", ["plain", "noise", "unbalanced", "mixed", *IMPERFECT])
def test_the_same_condition_and_seed_give_the_same_session(variant: str) -> None:
    first, again = (compose_study_session(small(variant), 3) for _ in range(2))
    for a, b in zip(first.demonstrations, again.demonstrations, strict=True):
        np.testing.assert_array_equal(a.hand, b.hand)
        np.testing.assert_array_equal(np.concatenate(a.signs), np.concatenate(b.signs))
    other = compose_study_session(small(variant), 4)
    assert not np.array_equal(first.demonstrations[0].objects, other.demonstrations[0].objects)


def test_every_pair_is_shown_and_asked_for_in_the_plain_condition() -> None:
    session = compose_study_session(study_condition(2, 3, 2), 0)
    shown = Counter(session.truth.requests)
    assert len(shown) == 6
    assert set(shown.values()) == {2}
    assert [command.request for command in session.commands] == sorted(shown)


def test_one_pair_in_three_is_never_shown_but_asked_for() -> None:
    session = compose_study_session(small("unseen third"), 0)
    assert len(set(session.truth.requests)) == 6
    assert len(session.commands) == 9


def test_unbalanced_counts_are_three_and_one() -> None:
    counts = Counter(compose_study_session(small("unbalanced"), 0).truth.requests)
    assert {count for pair, count in counts.items() if pair.movement % 2} == {1}
    assert {count for pair, count in counts.items() if not pair.movement % 2} == {3}


@pytest.mark.parametrize(("variant", "places"), [("swapped", (1, 0, 2)), ("constant filler", (2, 0, 3))])
def test_words_stand_where_the_variant_says(variant: str, places: tuple[int, int, int]) -> None:
    session = compose_study_session(small(variant), 0)
    language = session.truth.language
    assert (language.focus_word, language.movement_word, len(session.demonstrations[0].signs)) == places


def test_people_are_chosen_among_those_who_drew_everything() -> None:
    rng = np.random.default_rng(0)
    signs = synthetic_library("0123456789", samples=3, rng=rng)
    movements = synthetic_library(("triangle up", "triangle down"), samples=4, rng=rng)
    condition = study_condition(2, 2, 1, recordings=Recordings(signs, movements))
    assert len(compose_study_session(condition, 0).demonstrations) == 4
    with pytest.raises(InvalidInputError, match="strokes of triangle up, triangle down"):
        compose_study_session(study_condition(2, 2, 1, recordings=Recordings(signs, signs)), 0)


def test_conditions_have_names_of_their_own_and_those_of_real_people_come_last() -> None:
    library = synthetic_library("1", samples=1, rng=np.random.default_rng(0))
    conditions, synthetic = study_conditions(Recordings(library, library)), study_conditions()
    assert len({c.name for c in conditions}) == len(conditions)
    assert [c.name for c in conditions[: len(synthetic)]] == [c.name for c in synthetic]
    assert conditions[0].name == "synthetic 2x2x1 plain"
    assert {c.name.split()[0] for c in conditions[len(synthetic) :]} == {"real"}


@pytest.mark.parametrize("changes", [{"movements": 9}, {"objects": 7}, {"variant": "drunk"}, {"movements": 0}])
def test_conditions_that_nobody_can_play_are_refused(changes: dict[str, object]) -> None:
    with pytest.raises(InvalidInputError, match="condition"):
        study_condition(**({"movements": 2, "objects": 2, "repetitions": 1} | changes))  # type: ignore[arg-type]


@pytest.mark.parametrize(("variant", "spoilt"), [("once", 0), ("1 wrong", 1), ("2 wrong", 2), (BESIDE, 1)])
def test_so_many_demonstrations_are_spoilt(variant: str, spoilt: int) -> None:
    assert len(compose_study_session(small(variant), 0).truth.spoilt) == spoilt


def test_once_the_hand_draws_half_as_long_and_at_home_it_ends_where_it_began() -> None:
    plain, once, home, mouse = (
        compose_study_session(small(variant), 0) for variant in ("plain", "once", "goes home", AS_WITH_A_MOUSE)
    )
    lengths = [sum(len(d.hand) for d in session.demonstrations) for session in (plain, once)]
    assert lengths[1] < 0.7 * lengths[0]
    assert all(np.array_equal(d.hand[0], d.hand[-1]) for s in (home, mouse) for d in s.demonstrations)
    assert not mouse.truth.sound.all()


def test_each_object_has_two_signs_and_both_are_shown() -> None:
    rng = np.random.default_rng(0)
    signs = synthetic_library("0123456789", samples=6, rng=rng)
    movements = synthetic_library(("triangle up", "triangle down"), samples=8, rng=rng)
    session = compose_study_session(study_condition(2, 3, 1, "synonyms", Recordings(signs, movements)), 0)
    label_of = {stroke.points.tobytes(): label for stroke, label in zip(signs, signs.labels, strict=True)}
    shown = {
        (int(focus), label_of[demonstration.signs[0].tobytes()])
        for focus, demonstration in zip(session.truth.focus, session.demonstrations, strict=True)
    }
    assert shown == {(0, "1"), (0, "7"), (1, "2"), (1, "8"), (2, "3"), (2, "9")}


def test_where_all_movements_are_taught_none_is_beside_the_point() -> None:
    with pytest.raises(InvalidInputError, match="all 8 taken"):
        study_condition(8, 3, 1, BESIDE)


def test_a_crowd_of_real_people_may_have_drawn_apex_up_triangles_only() -> None:
    rng = np.random.default_rng(0)
    signs = synthetic_library("0123456789", samples=3, writers=2, rng=rng)
    drawn = synthetic_library(("triangle up",), samples=4, writers=2, rng=rng)
    movements = StrokeLibrary(drawn.strokes, ("triangle",) * len(drawn), drawn.writers, "")
    condition = study_condition(2, 2, 1, "mixed", Recordings(signs, movements))
    assert len(compose_study_session(condition, 0).demonstrations) == 4
