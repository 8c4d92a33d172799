"""Observations: numbers, a picture, or both."""

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

MIN_SIDE = 32  # pixels; signs cannot be told apart in a smaller picture
CARDS_SHARE = 4  # the cards with the signs take a quarter of a picture's rows


class CameraView(NamedTuple):
    """A camera and the size of its pictures.

    Attributes:
        camera: Name of the camera in the model.
        width: Width of a picture, pixels.
        height: Height of a picture, pixels.
    """

    camera: str
    width: int
    height: int


class Observer(Protocol):
    """Source of observations: an observation space, and the observations of the running episode."""

    @property
    def space(self) -> gym.Space[Any]:
        """The observation space."""
        ...

    def start(self, start: EpisodeStart) -> None:
        """Begin an episode."""
        ...

    def observe(self) -> Any:
        """Return an observation that shares no memory with anything."""
        ...

    def close(self) -> None:
        """Free the OpenGL context; may be called again."""
        ...


class StateObserver:
    """Observes positions, velocities and signs as numbers (``obs_type="state"``)."""

    def __init__(self, arm: Arm, words: int, view: CameraView) -> None:
        """Observe an arm and an utterance of ``words`` signs; no pictures are taken."""
        self._arm, self._measure = arm, arm.measure
        self.space = state_space(len(arm.object_bodies), words)

    def start(self, start: EpisodeStart) -> None:
        """Keep the objects and signs of the episode."""
        self._objects, self._signs = start.objects, start.signs

    def observe(self) -> dict[str, NDArray[np.float64]]:
        """Return the state."""
        state = self._measure()
        state["objects"] = self._objects.copy()
        state["signs"] = self._signs.copy()
        return state

    def close(self) -> None:
        """Free nothing."""


class PixelObserver:
    """Observes a picture: the signs on cards, and below them the camera's view (``obs_type="pixels"``).

    The cards have rows of their own, as the inventory in Crafter has, so that they never hide a part of the table.
    """

    def __init__(self, arm: Arm, words: int, view: CameraView) -> None:
        """Observe an arm through a camera; OpenGL is looked for at the first picture.

        Raises:
            InvalidInputError: If the picture is too small or too large.
        """
        if min(view.width, view.height) < MIN_SIDE:
            expected = f"at least {MIN_SIDE} by {MIN_SIDE} pixels, to see signs"
            raise InvalidInputError("size of frames", expected, f"{view.width} by {view.height}")
        self._arm, self._camera = arm, view.camera
        rows = view.height // CARDS_SHARE
        self._cards_size = view.width, rows
        self._offscreen = OffscreenView(arm.model, view.width, view.height - rows)
        self._cards = np.zeros((rows, view.width, 3), np.uint8)
        self.space = gym.spaces.Box(0, 255, (view.height, view.width, 3), np.uint8)

    def start(self, start: EpisodeStart) -> None:
        """Draw the cards, once an episode."""
        self._cards = draw_sign_cards(list(start.signs), self._cards_size)

    def observe(self) -> NDArray[np.uint8]:
        """Take a picture, shape (height, width, 3).

        Raises:
            RenderingError: If there is no OpenGL.
        """
        return np.concatenate([self._cards, self._offscreen.frame(self._arm.data, self._camera)])

    def close(self) -> None:
        """Free the OpenGL context; may be called again."""
        self._offscreen.close()


class StatePixelObserver:
    """Observes the state and the picture (``obs_type="state_pixels"``)."""

    def __init__(self, arm: Arm, words: int, view: CameraView) -> None:
        """Combine a `StateObserver` and a `PixelObserver`."""
        self._state, self._pixels = StateObserver(arm, words, view), PixelObserver(arm, words, view)
        self.space = gym.spaces.Dict({**self._state.space, "pixels": self._pixels.space})

    def start(self, start: EpisodeStart) -> None:
        """Begin an episode."""
        self._state.start(start)
        self._pixels.start(start)

    def observe(self) -> dict[str, NDArray[Any]]:
        """Return the state with the picture as ``pixels``."""
        return {**self._state.observe(), "pixels": self._pixels.observe()}

    def close(self) -> None:
        """Free the OpenGL context; may be called again."""
        self._pixels.close()


OBSERVERS: Mapping[str, Callable[[Arm, int, CameraView], Observer]] = {
    "state": StateObserver,
    "pixels": PixelObserver,
    "state_pixels": StatePixelObserver,
}


def make_observer(obs_type: str, arm: Arm, words: int, view: CameraView) -> Observer:
    """Return the observer of an ``obs_type``.

    Raises:
        UnknownNameError: If there is no such ``obs_type``.
        InvalidInputError: If pictures are observed and their size is too small or too large.
    """
    if obs_type not in OBSERVERS:
        raise UnknownNameError("obs_type", obs_type, OBSERVERS)
    return OBSERVERS[obs_type](arm, words, view)


def state_space(objects: int, words: int) -> gym.spaces.Dict:
    """Return the space of states, O objects and W signs; bounds are never exceeded.

    The arm is 1.35 m long and its base 0.72 m from the table's centre, so the hand stays within 2.1 m of it.
    """

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
