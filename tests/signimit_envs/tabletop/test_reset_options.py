"""What a reset may be given, and what it draws itself."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import signimit
from signimit.signs import normalised_sign
from signimit.teaching.languages import Request
from signimit_envs.tabletop.language_options import MOVEMENTS, digit_language
from signimit_envs.tabletop.people import choose_tabletop_people
from signimit_envs.tabletop.reset_options import draw_episode_start

PEOPLE = choose_tabletop_people(digit_language(3, MOVEMENTS), np.random.default_rng(0))
WAVE = np.column_stack([np.linspace(0, 1, 30), np.sin(np.linspace(0, 6, 30))])


def draw(options: dict[str, Any] | None = None, seed: int = 0) -> Any:
    return draw_episode_start(options, PEOPLE, 3, np.random.default_rng(seed))


def test_what_is_left_out_is_drawn_within_the_promised_areas() -> None:
    drawn = [draw(seed=seed) for seed in range(60)]
    assert {d.request for d in drawn} == {(m, f) for m in range(3) for f in range(3)}
    for situation in drawn:
        gaps = np.hypot(*(situation.objects[:, None] - situation.objects[None]).transpose(2, 0, 1)) + np.eye(3)
        assert gaps.min() >= 0.14
        assert (np.abs(np.vstack([situation.objects, situation.hand])) <= [0.22, 0.18]).all()
        assert situation.signs.shape == (2, 64, 2)
        assert np.abs(situation.signs).max() <= 1.0


def test_what_is_given_is_taken() -> None:
    objects = [[0.1, 0.1], [-0.1, 0.1], [0.0, -0.1]]
    situation = draw(
        {"movement": np.int64(2), "focus": 1, "objects": objects, "hand": (0.3, -0.3), "signs": [WAVE] * 2}
    )
    assert situation.request == (2, 1)
    np.testing.assert_array_equal(situation.objects, objects)
    np.testing.assert_array_equal(situation.hand, [0.3, -0.3])
    np.testing.assert_allclose(situation.signs, [normalised_sign(WAVE)] * 2)


def test_the_same_request_is_never_signed_the_same_way_twice() -> None:
    first, second = (draw({"movement": 1, "focus": 2}, seed).signs for seed in (0, 1))
    assert np.abs(first - second).max() > 0.01


def test_signs_of_one_word_are_more_alike_than_signs_of_different_words() -> None:
    a, b = (draw({"focus": 0}, seed).signs[0] for seed in (0, 1))
    c = draw({"focus": 1}, 0).signs[0]
    assert signimit.dtw_distance(a, b) < signimit.dtw_distance(a, c)


def test_the_first_sign_names_the_object_and_the_second_the_movement() -> None:
    for movement, focus in ((0, 1), (2, 0)):
        signs = PEOPLE.speak(Request(movement, focus), np.random.default_rng(3))
        rng = np.random.default_rng(3)
        for sign, word in zip(signs, (str(focus + 1), str(movement + 4)), strict=True):
            np.testing.assert_array_equal(sign, PEOPLE.signs.draw(word, rng).points)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"colour": 1}, "Unknown reset option 'colour'; known are movement, focus, objects, hand, signs"),
        ({"movement": 3}, "reset option movement: expected a whole number from 0 to 2, found 3"),
        ({"movement": -1}, "reset option movement: expected a whole number from 0 to 2, found -1"),
        ({"focus": 1.0}, "reset option focus: expected a whole number from 0 to 2, found 1.0"),
        ({"focus": True}, "reset option focus: expected a whole number from 0 to 2, found True"),
        ({"focus": "red"}, "reset option focus: expected a whole number from 0 to 2, found 'red'"),
        ({"objects": [[0, 0]]}, r"reset option objects: expected numbers of shape \(3, 2\), found shape \(1, 2\)"),
        ({"objects": [[0, 0], [0, np.nan], [0, 0]]}, "reset option objects: expected finite numbers, found nan"),
        ({"objects": [[0, 0], [9, 0], [0, 0]]}, r"reset option objects: expected positions with .* found \(9, 0\)"),
        ({"hand": [0.5, 0]}, r"reset option hand: .*\|x\| <= 0.42 m and \|y\| <= 0.38 m, found \(0.5, 0\)"),
        ({"hand": [0, np.inf]}, "reset option hand: expected finite numbers, found inf"),
        ({"hand": "home"}, "reset option hand: expected numbers of shape"),
        ({"signs": [WAVE]}, r"reset option signs: expected 2 strokes of shape \(T, 2\), found 1"),
        ({"signs": 3}, r"reset option signs: expected 2 strokes of shape \(T, 2\), found int"),
        ({"signs": [WAVE, [[0, 0]]]}, "reset option signs: 1: sign: expected at least 2 points, found 1"),
        ({"signs": [WAVE * np.nan, WAVE]}, "reset option signs: 0: sign: expected finite numbers"),
    ],
)
def test_what_cannot_be_is_refused_in_one_sentence(options: dict[str, Any], message: str) -> None:
    with pytest.raises(signimit.SignimitError, match=message):
        draw(options)
