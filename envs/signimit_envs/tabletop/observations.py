"""What an agent observes: numbers, a picture, or both."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, Protocol

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from signimit import InvalidInputError, UnknownNameError
from signimit.signs import SAMPLES
from signimit_envs.arm.arm import Arm
from signimit_envs.arm.scene import MAX_JOINT_SPEED, TABLE
from signimit_envs.tabletop.reset_options import EpisodeStart
from signimit_envs.tabletop.sign_cards import draw_sign_cards
from signimit_envs.video.rendering import OffscreenView

LEAST_SIDE = 32  # pixels; less shows no sign
CARDS_SHARE = 4  # the signs take one in so many rows of a picture


class Sight(NamedTuple):
    """How pictures are taken.

    Attributes:
        camera: Its name in the model.
        width: Pixels.
        height: Pixels.
    """

    camera: str
    width: int
    height: int


class Observer(Protocol):
    """Observes an arm, its table and the signs of an episode."""

    @property
    def space(self) -> gym.Space[Any]:
        """What observations are like."""
        ...

    def start(self, situation: EpisodeStart) -> None:
        """Take note of what an episode starts from."""
        ...

    def observe(self) -> Any:
        """Return an observation that shares no memory with anything."""
        ...

    def close(self) -> None:
        """Free what OpenGL holds; may be called again."""
        ...


class StateObserver:
    """Observes positions, velocities and signs as numbers."""

    def __init__(self, arm: Arm, words: int, sight: Sight) -> None:
        """Observe an arm, and so many signs."""
        self._arm, self._measure = arm, arm.measure
        self.space = state_space(len(arm.object_bodies), words)

    def start(self, situation: EpisodeStart) -> None:
        """Keep objects and signs."""
        self._objects, self._signs = situation.objects, situation.signs

    def observe(self) -> dict[str, NDArray[np.float64]]:
        """Return the state."""
        state = self._measure()
        state["objects"] = self._objects.copy()
        state["signs"] = self._signs.copy()
        return state

    def close(self) -> None:
        """Hold nothing."""


class PixelObserver:
    """Observes a picture: the signs on cards, and below them what a camera sees.

    The cards have rows of their own, as the inventory in Crafter has, so that they never hide a part of the table.
    """

    def __init__(self, arm: Arm, words: int, sight: Sight) -> None:
        """Look at an arm; OpenGL is looked for at the first picture.

        Raises:
            InvalidInputError: If the picture is too small or too large.
        """
        if min(sight.width, sight.height) < LEAST_SIDE:
            expected = f"at least {LEAST_SIDE} by {LEAST_SIDE} pixels, to see signs"
            raise InvalidInputError("size of frames", expected, f"{sight.width} by {sight.height}")
        self._arm, self._sight = arm, sight
        self._rows = sight.height // CARDS_SHARE
        self._view = OffscreenView(arm.model, sight.width, sight.height - self._rows)
        self._cards = np.zeros((self._rows, sight.width, 3), np.uint8)
        self.space = gym.spaces.Box(0, 255, (sight.height, sight.width, 3), np.uint8)

    def start(self, situation: EpisodeStart) -> None:
        """Draw the signs, once an episode."""
        self._cards = draw_sign_cards(list(situation.signs), (self._sight.width, self._rows))

    def observe(self) -> NDArray[np.uint8]:
        """Take a picture, shape (height, width, 3).

        Raises:
            RenderingError: If there is no OpenGL.
        """
        return np.concatenate([self._cards, self._view.frame(self._arm.data, self._sight.camera)])

    def close(self) -> None:
        """Free what OpenGL holds; may be called again."""
        self._view.close()


class StatePixelObserver:
    """Observes the state and the picture."""

    def __init__(self, arm: Arm, words: int, sight: Sight) -> None:
        """Observe both ways."""
        self._state, self._pixels = StateObserver(arm, words, sight), PixelObserver(arm, words, sight)
        self.space = gym.spaces.Dict({**self._state.space, "pixels": self._pixels.space})

    def start(self, situation: EpisodeStart) -> None:
        """Take note in both ways."""
        self._state.start(situation)
        self._pixels.start(situation)

    def observe(self) -> dict[str, NDArray[Any]]:
        """Return the state with the picture as ``pixels``."""
        return {**self._state.observe(), "pixels": self._pixels.observe()}

    def close(self) -> None:
        """Free what OpenGL holds; may be called again."""
        self._pixels.close()


OBSERVERS: Mapping[str, Callable[[Arm, int, Sight], Observer]] = {
    "state": StateObserver,
    "pixels": PixelObserver,
    "state_pixels": StatePixelObserver,
}


def make_observer(obs_type: str, arm: Arm, words: int, sight: Sight) -> Observer:
    """Return an observer by the name of what it gives.

    Raises:
        UnknownNameError: If there is none of that name.
        InvalidInputError: If it cannot take such pictures.
    """
    if obs_type not in OBSERVERS:
        raise UnknownNameError("obs_type", obs_type, OBSERVERS)
    return OBSERVERS[obs_type](arm, words, sight)


def state_space(objects: int, words: int) -> gym.spaces.Dict:
    """Return bounds that nothing exceeds: the arm is 1.35 m long and starts 0.72 m from the table's centre."""

    def box(limit: float | NDArray[np.float64], *shape: int) -> gym.spaces.Box:
        bound = np.broadcast_to(np.asarray(limit, dtype=np.float64), shape)
        return gym.spaces.Box(-bound, bound, shape, np.float64)

    return gym.spaces.Dict(
        {
            "hand": box(2.1, 2),
            "hand_velocity": box(20.0, 2),
            "joints": box(np.pi, 3),
            "joint_velocities": box(2 * MAX_JOINT_SPEED, 3),
            "objects": box(TABLE + 1e-9, objects, 2),
            "signs": box(1.0, words, SAMPLES, 2),
        }
    )
