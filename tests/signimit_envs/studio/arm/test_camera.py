"""The camera shows what the mapping says, once for all, and goes on without OpenGL."""

from __future__ import annotations

import io
import json
import queue
import struct
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from signimit_envs.exceptions import RenderingError
from signimit_envs.studio.arm.camera import HAND_HEIGHT, Camera, picture_mapping
from signimit_envs.studio.arm.live_state import LiveState
from signimit_envs.tabletop_hand import TabletopHandEnv
from signimit_envs.video.backend import choose_backend
from signimit_envs.video.storyboard import PARKED

OBJECT_HEIGHT, CAP_HEIGHT = 0.044, 0.13  # m, of what the camera sees of objects and of the hand
OBJECTS = np.array([[-0.3, 0.25], [0.1, 0.1], [0.3, -0.2]])


def _state(joints: NDArray[np.float64] = PARKED, objects: NDArray[np.float64] = OBJECTS) -> LiveState:
    return LiveState(None, None, None, 0.0, 0.0, joints, np.zeros(2), objects, (), False, 0.0)


class Watched:
    """A camera, and the frames that it gave out."""

    def __init__(self, state: LiveState) -> None:
        self.frames: queue.Queue[bytes] = queue.Queue()
        self.camera = Camera(lambda: state, lambda: True, self.frames.put)

    def frame(self) -> tuple[dict[str, Any], bytes]:
        frame = self.frames.get(timeout=60)
        size = struct.unpack(">I", frame[:4])[0]
        return json.loads(frame[4 : 4 + size]), frame[4 + size :]


@pytest.fixture
def opengl() -> None:
    try:
        choose_backend()
    except RenderingError as error:
        pytest.skip(str(error))


@pytest.fixture
def watched() -> Iterator[Watched]:
    started = Watched(_state())
    started.camera.start()
    yield started
    started.camera.close()


def _pixel(place: NDArray[np.float64], height: float) -> NDArray[np.float64]:
    """What the page does, the other way round, at any height above the table."""
    mapping = picture_mapping()
    table, hand = (mapping["metres_per_pixel"][plane] for plane in ("table", "hand"))
    scale = table + (hand - table) * height / HAND_HEIGHT
    middle = np.array([mapping["width"], mapping["height"]]) / 2
    return np.asarray(middle + (place - mapping["centre"]) / scale * [1, -1])


def _middle(picture: bytes, colour: tuple[int, int, int]) -> NDArray[np.float64]:
    """Return the middle of what is about of a colour, pixels."""
    pixels = np.asarray(Image.open(io.BytesIO(picture)), dtype=float)
    rows, columns = np.nonzero(np.abs(pixels - colour).max(axis=2) < 45)
    return np.array([columns.mean(), rows.mean()])


@pytest.mark.usefixtures("opengl")
def test_objects_are_in_the_picture_where_the_mapping_says(watched: Watched) -> None:
    picture = watched.camera.still(OBJECTS).result(60)
    assert Image.open(io.BytesIO(picture)).size == (640, 480)
    for place, colour in zip(OBJECTS, [(232, 64, 54), (66, 160, 84), (56, 118, 220)], strict=True):
        assert np.linalg.norm(_middle(picture, colour) - _pixel(place, OBJECT_HEIGHT)) < 4


@pytest.mark.usefixtures("opengl")
def test_the_hand_is_in_the_picture_where_the_mapping_says() -> None:
    env, hand = TabletopHandEnv(), np.array([-0.15, 0.2])
    env.reset(seed=0, options={"hand": hand, "objects": -OBJECTS})
    assert env.data.site("hand").xpos[2] == pytest.approx(HAND_HEIGHT, abs=1e-6)
    watched = Watched(_state(env.data.qpos.copy(), -OBJECTS))
    watched.camera.start()
    _, picture = watched.frame()
    watched.camera.close()
    env.close()
    assert np.linalg.norm(_middle(picture, (255, 230, 30)) - _pixel(hand, CAP_HEIGHT)) < 3


@pytest.mark.usefixtures("opengl")
def test_pictures_of_many_tables_can_be_asked_for(watched: Watched) -> None:
    objects = np.random.default_rng(0).uniform(-0.2, 0.2, (6, 2))
    futures = [watched.camera.still(objects[:count]) for count in (2, 6, 3)]
    assert all(future.result(60).startswith(b"\xff\xd8") for future in futures)


def test_without_opengl_frames_have_no_picture_and_stills_say_why(monkeypatch: pytest.MonkeyPatch) -> None:
    def blind() -> str:
        raise RenderingError("no OpenGL library was found", "Install one.")

    monkeypatch.setattr("signimit_envs.video.rendering.choose_backend", blind)
    watched = Watched(_state())
    watched.camera.start()
    header, picture = watched.frame()
    assert (header["objects"], picture) == (OBJECTS.tolist(), b"")
    assert "no OpenGL library was found" in watched.camera.unavailable_reason(60)
    with pytest.raises(RenderingError, match="no OpenGL library was found"):
        watched.camera.still(OBJECTS).result(60)
    watched.camera.close()


def test_a_camera_can_be_closed_before_it_looked_and_twice() -> None:
    camera = Watched(_state()).camera
    camera.close()
    camera.close()
