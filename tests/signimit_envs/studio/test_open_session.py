"""What the page is told of the imitator's belief is what the imitator believes."""

from __future__ import annotations

import json

import numpy as np
import pytest

from signimit.teaching.languages import Request
from signimit.teaching.scenes import sample_hand, sample_scene
from signimit_envs.studio.open_session import LearningResult, learn_session
from signimit_envs.studio.page.built_in_people import draw_answer, draw_utterance, examples, templates
from signimit_envs.studio.page.prompts import LANGUAGES, get_language, next_request, prompt_text, sign_labels
from signimit_envs.studio.store.events import Created, Demonstrated, DrawnDemonstration
from signimit_envs.studio.store.history import History, apply_event, replay_events

SEED = 7


def demonstrated(request: Request, number: int) -> DrawnDemonstration:
    rng = np.random.default_rng([number, 1])
    objects, hand = sample_scene(rng), sample_hand(rng)
    signs = draw_utterance("paper", SEED, request, number)
    return DrawnDemonstration(signs, objects, draw_answer("paper", SEED, request, number, (objects, hand)), request)


@pytest.fixture(scope="module")
def steps() -> list[tuple[History, LearningResult]]:
    """A whole session, demonstration by demonstration."""
    history = replay_events([Created("t", "2020-01-01T00:00:00", "paper", 3, SEED)])
    learned, found = learn_session(history, None), []
    for number in range(12):
        request = next_request(LANGUAGES["paper"], SEED, [one.prompt for one in history.shown]).request
        history = apply_event(history, Demonstrated((demonstrated(request, number),)))
        learned = learn_session(history, learned)
        found.append((history, learned))
    return found


def test_before_the_first_demonstration_there_is_a_scene_and_no_belief() -> None:
    learned = learn_session(replay_events([Created("t", "2020-01-01T00:00:00", "free", 5, SEED)]), None)
    assert learned.model is None
    assert learned.belief is None
    assert learned.objects.shape == (5, 2)


def test_after_all_prompts_the_belief_is_the_language(steps: list[tuple[History, LearningResult]]) -> None:
    history, learned = steps[-1]
    belief, prompts = learned.belief, [one.prompt for one in history.shown]
    assert belief is not None
    assert belief["focus"] == [prompt.focus for prompt in prompts if prompt]
    movements = [prompt.movement for prompt in prompts if prompt]
    assert len(set(zip(belief["labels"], movements, strict=True))) == 3
    assert (belief["word_order"]["focus"], belief["word_order"]["movement"]) == (0, 1)
    assert belief["word_orders"][0]["loss"] == 0
    assert belief["word_orders"][1]["loss"] > 0


def test_each_belief_can_be_sent_and_has_probabilities_that_sum_to_one(
    steps: list[tuple[History, LearningResult]],
) -> None:
    for history, learned in steps:
        belief = learned.belief
        assert belief is not None
        json.dumps(belief, allow_nan=False)
        count = len(history.shown)
        np.testing.assert_allclose(np.sum(belief["focus_probability"], axis=1), np.ones(count), atol=0.005)
        np.testing.assert_allclose(np.sum(belief["movement_probability"], axis=1), np.ones(count), atol=0.005)
        members = sorted(n for movement in belief["movements"] for n in movement["members"])
        assert members == list(range(count))
        assert {doubt["number"] for doubt in belief["doubtful"]} <= set(range(count))


def test_the_lexicon_shows_the_signs_of_each_meaning(steps: list[tuple[History, LearningResult]]) -> None:
    belief = steps[-1][1].belief
    assert belief is not None
    assert [len(entry["strokes"]) for entry in belief["lexicon"]["objects"]] == [4, 4, 4]
    assert [len(entry["drawings"]) for entry in belief["lexicon"]["movements"]] == [4, 4, 4]
    strokes = np.array(belief["lexicon"]["objects"][0]["strokes"])
    assert 0.9 < np.abs(strokes).max() <= 1.0


def test_one_demonstration_more_gives_the_belief_of_all_at_once(steps: list[tuple[History, LearningResult]]) -> None:
    history, stepwise = steps[-1]
    at_once = learn_session(history, None)
    assert stepwise.belief is not None
    assert at_once.belief is not None
    for key in ("labels", "focus", "word_order", "wish", "focus_probability"):
        assert stepwise.belief[key] == at_once.belief[key]


def test_the_wish_is_made_of_signs_that_were_seen(steps: list[tuple[History, LearningResult]]) -> None:
    for history, learned in steps:
        assert learned.belief is not None
        wish = learned.belief["wish"]
        assert all(0 <= number < len(history.shown) for number in wish["copied"])
        assert len(wish["signs"]) == 2
        assert "I think they ask for movement" in wish["text"]


def test_the_next_scene_is_the_same_whenever_the_session_is_read(steps: list[tuple[History, LearningResult]]) -> None:
    history, learned = steps[4]
    again = learn_session(history, None)
    np.testing.assert_array_equal(learned.objects, again.objects)
    np.testing.assert_array_equal(learned.hand, again.hand)


def test_what_cannot_be_learned_from_is_said_and_can_be_undone(
    steps: list[tuple[History, LearningResult]], monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def broken(*arguments: object) -> None:
        raise ZeroDivisionError("strange")

    monkeypatch.setattr("signimit_envs.studio.open_session.learn", broken)
    history, _ = steps[2]
    learned = learn_session(history, None)
    assert learned.model is None
    assert learned.belief == {"failed": "This cannot be learned from: strange"}
    assert "ZeroDivisionError" in caplog.text


def test_prompts_ask_for_everything_that_is_to_be_seen_twice_and_then_again() -> None:
    language = LANGUAGES["paper"]
    prompts: list[Request] = []
    for left in [*range(12, 0, -1), 0, 0]:
        following = next_request(language, 5, prompts)
        assert following.left == left
        prompts.append(following.request)
    assert sorted(prompts[:12]) == sorted([*language.seen, *language.seen])
    assert sorted(prompts[:6]) == sorted(language.seen)


def test_a_deleted_demonstration_is_asked_for_again() -> None:
    language = LANGUAGES["paper"]
    prompts = [next_request(language, 5, []).request]
    prompts.append(next_request(language, 5, prompts).request)
    assert next_request(language, 5, prompts[1:]).request == prompts[0]


def test_the_prompt_names_the_signs_in_the_order_they_are_made() -> None:
    request = Request(2, 0)
    told = "Sign 1, then 6. Then draw a circle about the red object; once is enough."
    assert prompt_text(LANGUAGES["paper"], request) == told
    assert sign_labels(LANGUAGES["movement first"], request) == ("6", "1")


@pytest.mark.parametrize("name", LANGUAGES)
def test_built_in_people_can_draw_every_language(name: str) -> None:
    language = get_language(name)
    assert language is not None
    for request in language.requests:
        signs, drawing = examples(name, 1, request)
        assert len(signs) == 2
        assert np.abs(drawing).max() == pytest.approx(1.0, abs=1e-6)
    assert len(templates(name, 1)) == len(language.movements)


def test_built_in_people_never_draw_the_same_twice() -> None:
    request, scene = Request(2, 1), (sample_scene(np.random.default_rng(0)), np.zeros(2))
    signs = [draw_utterance("paper", 1, request, attempt)[0].points for attempt in (0, 1, 0)]
    assert signs[0].shape != signs[1].shape or not np.array_equal(signs[0], signs[1])
    np.testing.assert_array_equal(signs[0], signs[2])
    path = draw_answer("paper", 1, request, 0, scene)
    assert np.linalg.norm(path.points[0] - scene[1]) < 1e-9
