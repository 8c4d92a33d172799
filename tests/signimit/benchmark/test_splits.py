"""Every split is the paper's session with something changed."""

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit.benchmark.splits import (
    SPLITS,
    choose_splits,
    compose_split_session,
    entry_stream,
    with_more_demonstrations,
)
from signimit.exceptions import UnknownNameError
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit.teaching.people.choosing import CROWD, another_style, clumsy_strangers, same_people, strangers
from signimit.teaching.sessions import Session


@pytest.fixture(scope="module")
def paper() -> Session:
    return compose_split_session(SPLITS["paper"], 3)


def composed(name: str) -> Session:
    return compose_split_session(SPLITS[name], 3)


def shown_alike(a: Session, b: Session) -> bool:
    """Whether the same was demonstrated, to the last bit."""
    x, y = a.demonstrations.to_arrays(), b.demonstrations.to_arrays()
    return all(np.array_equal(x[name], y[name]) for name in x)


def least_distance(objects: NDArray[np.float64]) -> float:
    gaps = np.linalg.norm(objects[:, None] - objects, axis=2)
    return float(gaps[~np.eye(len(objects), dtype=bool)].min())


def test_the_same_seed_is_the_same_session_and_another_one_another(paper: Session) -> None:
    assert shown_alike(paper, composed("paper"))
    assert not shown_alike(paper, compose_split_session(SPLITS["paper"], 4))


def test_the_paper_shows_six_pairs_twice_and_asks_for_all_nine_in_random_order(paper: Session) -> None:
    assert sorted(paper.truth.requests) == sorted(PAPER_LANGUAGE.seen * 2)
    asked = [c.request for c in paper.commands]
    assert sorted(asked) == sorted(PAPER_LANGUAGE.requests)
    assert asked != sorted(asked)


def test_unseen_pairs_are_all_that_is_asked_for(paper: Session) -> None:
    session = composed("unseen-pair")
    assert shown_alike(session, paper)
    assert sorted(c.request for c in session.commands) == sorted([*PAPER_LANGUAGE.held_back] * 3)
    assert not {c.request for c in session.commands} & set(session.truth.requests)


def test_scenes_are_shown_left_and_asked_for_right() -> None:
    session = composed("unseen-scene")
    assert (session.demonstrations.objects[..., 0] < 0).all()
    assert all((c.objects[:, 0] > 0).all() for c in session.commands)


def test_a_style_changes_only_what_is_asked(paper: Session) -> None:
    session = composed("unseen-style")
    assert shown_alike(session, paper)
    usual, changed = ([np.ptp(s, axis=0).max() for c in x.commands for s in c.signs] for x in (paper, session))
    assert np.mean(changed) > 1.5 * np.mean(usual)
    usual, changed = ([len(s) for c in x.commands for s in c.signs] for x in (paper, session))
    assert np.mean(changed) < 0.95 * np.mean(usual)


def test_strangers_are_a_crowd_and_somebody_else_asks() -> None:
    who, how = (np.random.default_rng(n) for n in (0, 1))
    people = strangers(PAPER_LANGUAGE, 2, who, how)
    assert len(set(people.signs.writers)) == len(set(people.movements.writers)) == CROWD
    assert people.asking is not None
    assert len(set(people.asking.writers)) == 1
    assert not {s.points.tobytes() for s in people.asking} & {s.points.tobytes() for s in people.signs}


def test_the_same_signer_goes_on_with_strokes_that_were_not_used() -> None:
    people = same_people(PAPER_LANGUAGE, 2, np.random.default_rng(0), np.random.default_rng(1))
    assert people.asking is None
    other = another_style(PAPER_LANGUAGE, 2, np.random.default_rng(0), np.random.default_rng(1))
    assert np.array_equal(other.signs[0].points, people.signs[0].points)


def test_commands_of_the_same_signer_repeat_no_stroke_of_the_demonstrations(paper: Session) -> None:
    shown = {s.tobytes() for d in paper.demonstrations for s in d.signs}
    assert not shown & {s.tobytes() for c in paper.commands for s in c.signs}


def test_word_order_swaps_the_words_and_nothing_else(paper: Session) -> None:
    session = composed("word-order")
    language = session.truth.language
    assert (language.focus_word, language.movement_word) == (1, 0)
    assert session.truth.requests == paper.truth.requests
    assert np.array_equal(session.demonstrations.objects, paper.demonstrations.objects)


def test_a_filler_stands_between_the_words() -> None:
    session = composed("filler-word")
    assert {len(d.signs) for d in session.demonstrations} == {len(c.signs) for c in session.commands} == {3}
    assert (session.truth.language.focus_word, session.truth.language.movement_word) == (0, 2)


def test_many_and_few() -> None:
    many, few = composed("many"), composed("few")
    assert (len(many.demonstrations), many.demonstrations.objects.shape[1], len(many.commands)) == (16, 6, 16)
    assert len(set(many.truth.movement)) == 8
    assert sorted(few.truth.requests) == sorted(PAPER_LANGUAGE.seen)


def test_noise_wavers_what_is_drawn_and_leaves_scenes_alone(paper: Session) -> None:
    session = composed("noisy")
    assert np.array_equal(session.demonstrations.objects, paper.demonstrations.objects)
    assert not shown_alike(session, paper)


def test_objects_are_ambiguously_near(paper: Session) -> None:
    session = composed("ambiguous")
    near = [least_distance(o) for o in (*session.demonstrations.objects, *(c.objects for c in session.commands))]
    usual = [least_distance(o) for o in (*paper.demonstrations.objects, *(c.objects for c in paper.commands))]
    assert min(near) >= 0.035 - 1e-9
    np.testing.assert_allclose(near, np.array(usual) / 4)


def test_a_counterfactual_family_differs_in_one_thing() -> None:
    session = composed("counterfactual")
    for family in range(3):
        commands = [c for c in session.commands if c.family == family]
        assert len(commands) == 4
        moved = [c for c in commands if not any(np.array_equal(c.objects, d.objects) for d in commands if d is not c)]
        (permuted,) = moved
        rest = [c for c in commands if c is not permuted]
        assert not (permuted.objects == rest[0].objects).all(axis=1).any()
        assert {map(tuple, permuted.objects)} != {map(tuple, rest[0].objects)}
        assert sorted(map(tuple, permuted.objects)) == sorted(map(tuple, rest[0].objects))
        (first,) = (c for c in rest if c.signs[0] is permuted.signs[0] and c.signs[1] is permuted.signs[1])
        for other in (c for c in rest if c is not first):
            same = [a is b for a, b in zip(other.signs, first.signs, strict=True)]
            assert sum(same) == 1
            assert same == [
                other.request.focus == first.request.focus,
                other.request.movement == first.request.movement,
            ]
            assert np.array_equal(other.hand, first.hand)


@pytest.mark.parametrize(("name", "rounds"), [("paper", 2), ("once", 1), ("open-once", 1), ("mouse", 1)])
def test_movements_are_drawn_once_where_the_split_says_so(name: str, rounds: int) -> None:
    truth = composed(name).truth
    assert [len(drawings) for drawings in truth.templates] == [4 * rounds] * 3


def test_open_strokes_end_elsewhere_than_they_began() -> None:
    for drawings in composed("open-once").truth.templates:
        assert all(np.linalg.norm(d[-1] - d[0]) > 0.4 * np.ptp(d, axis=0).max() for d in drawings)


@pytest.mark.parametrize(("name", "count"), [("wrong-2", 2), ("irrelevant-2", 2), ("mouse", 1), ("strangers-mouse", 1)])
def test_hands_that_err_are_known_to_the_judge_and_further_ones_err_as_often(name: str, count: int) -> None:
    session = composed(name)
    assert len(session.truth.spoilt) == count
    more = with_more_demonstrations(session, 36)
    assert list(more.truth.spoilt[:count]) == list(session.truth.spoilt)
    assert [int((more.truth.spoilt // 12 == part).sum()) for part in range(3)] == [count] * 3


@pytest.mark.parametrize("name", ["retreat", "mouse"])
def test_hands_go_home(name: str) -> None:
    for demonstration in with_more_demonstrations(composed(name), 24).demonstrations:
        assert np.array_equal(demonstration.hand[-1], demonstration.hand[0])


def test_four_idle_words_stand_about_the_two_that_mean_something(paper: Session) -> None:
    session = composed("idle-4")
    assert {len(d.signs) for d in session.demonstrations} == {len(c.signs) for c in session.commands} == {6}
    assert sorted(session.truth.requests) == sorted(paper.truth.requests)


def test_objects_have_two_signs_each(paper: Session) -> None:
    session = composed("synonyms")
    assert session.truth.requests == paper.truth.requests
    usual, second = ([d.signs[0] for d in s.demonstrations] for s in (paper, session))
    same = [np.array_equal(a, b) for a, b in zip(usual, second, strict=True)]
    assert 0 < sum(same) < len(same)


def test_clumsy_strangers_are_all_different_people_and_farther_apart() -> None:
    people = clumsy_strangers(PAPER_LANGUAGE, 6, np.random.default_rng(0), np.random.default_rng(1))
    assert people.asking is None
    assert len(set(people.signs.writers)) == len(set(people.movements.writers)) == 6
    session = composed("strangers")
    signs = [s.tobytes() for d in session.demonstrations for s in d.signs]
    assert len(set(signs)) == len(signs)
    many = composed("strangers-many")
    assert (len(many.demonstrations), many.demonstrations.objects.shape[1], len(set(many.truth.movement))) == (28, 4, 7)


def test_more_demonstrations_are_by_the_same_people_and_show_no_pair_that_is_held_back(paper: Session) -> None:
    more = with_more_demonstrations(paper, 20)
    assert len(more.demonstrations) == len(more.truth.requests) >= 20
    assert more.demonstrations[:12].demonstrations == paper.demonstrations.demonstrations
    assert set(more.truth.requests) == set(PAPER_LANGUAGE.seen)
    signs = [s.tobytes() for d in more.demonstrations for s in d.signs]
    assert len(set(signs)) == len(signs)
    assert not set(signs) & {s.tobytes() for c in paper.commands for s in c.signs}
    assert with_more_demonstrations(paper, 12).demonstrations is paper.demonstrations


def test_the_generator_of_an_entry_is_the_same_each_time_and_does_not_tell_the_seed(paper: Session) -> None:
    first, again = entry_stream(paper), entry_stream(paper)
    assert first.random() == again.random() != entry_stream(composed("few")).random()
    assert first.bit_generator.seed_seq.entropy > 2**200  # type: ignore[attr-defined]


def test_an_unknown_split_is_answered_with_the_known_ones() -> None:
    assert [s.name for s in choose_splits(("few", "paper", "few"))] == ["few", "paper"]
    assert len(choose_splits(())) == 23
    with pytest.raises(UnknownNameError, match="Unknown split 'hard'; known are paper, unseen-pair, "):
        choose_splits(("hard",))
