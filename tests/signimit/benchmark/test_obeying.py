"""The loop hands over a hand, and moves it as it is told."""

from typing import Any

import numpy as np
import pytest

from signimit.benchmark.obeying import FASTEST, obey
from signimit.benchmark.protocol import Observation
from signimit.exceptions import InvalidInputError
from signimit.teaching.languages import Request
from signimit.teaching.sessions import Command

COMMAND = Command(Request(0, 0), (np.eye(2), np.ones((2, 2))), np.zeros((3, 2)), np.array([0.1, -0.1]), 0)


class Recorder:
    """Commands what it is made with, and remembers what it saw."""

    def __init__(self, velocity: Any) -> None:
        self.velocity, self.seen = velocity, list[Observation]()

    def observe(self, demonstrations: object) -> None: ...

    def begin(self, signs: tuple[Any, ...], objects: Any) -> None:
        self.begun = (signs, objects)

    def act(self, observation: Observation) -> Any:
        self.seen.append(observation)
        return self.velocity


def test_the_hand_starts_where_the_command_says_and_moves_as_told() -> None:
    entry = Recorder([0.1, 0.05])
    path = obey(entry, COMMAND)
    assert path.shape == (501, 2)
    np.testing.assert_allclose(path[0], [0.1, -0.1])
    np.testing.assert_allclose(path[-1], [1.1, 0.4])
    assert entry.begun == (COMMAND.signs, COMMAND.objects)


def test_what_is_observed_is_the_hand_its_last_velocity_and_the_time() -> None:
    entry = Recorder([0.1, 0.05])
    path = obey(entry, COMMAND, seconds=1.0)
    np.testing.assert_array_equal([o.hand for o in entry.seen], path[:-1])
    np.testing.assert_allclose([o.seconds for o in entry.seen], np.arange(50) * 0.02)
    np.testing.assert_array_equal(entry.seen[0].velocity, [0, 0])
    np.testing.assert_array_equal(entry.seen[1].velocity, [0.1, 0.05])


def test_what_is_too_fast_is_slowed_down_as_a_whole() -> None:
    path = obey(Recorder([24.0, -6.0]), COMMAND, seconds=0.1)
    np.testing.assert_allclose(np.diff(path, axis=0) / 0.02, [[FASTEST, -FASTEST / 4]] * 5)


def test_an_entry_cannot_move_the_hand_by_writing_to_what_it_sees() -> None:
    class Vandal(Recorder):
        def act(self, observation: Observation) -> Any:
            observation.hand[:] = 7.0
            observation.velocity[:] = 7.0
            return [0.0, 0.0]

    np.testing.assert_array_equal(obey(Vandal(None), COMMAND, seconds=0.1), [[0.1, -0.1]] * 6)
    np.testing.assert_array_equal(COMMAND.hand, [0.1, -0.1])


def test_a_velocity_that_is_used_again_is_not_written_to() -> None:
    velocity = np.array([24.0, -6.0])
    obey(Recorder(velocity), COMMAND, seconds=0.1)
    np.testing.assert_array_equal(velocity, [24.0, -6.0])


@pytest.mark.parametrize("given", [np.nan, None, [0.1], [0.1, np.inf], [[0.1, 0.2]], "fast", [0.1, None]])
def test_what_is_not_a_velocity_is_refused(given: Any) -> None:
    with pytest.raises(
        InvalidInputError, match=r"act at step 0: expected a finite velocity of shape \(2,\), m/s, found"
    ):
        obey(Recorder(given), COMMAND)
