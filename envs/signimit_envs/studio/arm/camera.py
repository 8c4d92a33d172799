"""The camera: renders the live arm once for all pages that watch, in a thread that owns OpenGL."""

from __future__ import annotations

import io
import json
import logging
import queue
import struct
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from signimit_envs.arm.scene import OBJECT_COUNTS, compile_scene
from signimit_envs.exceptions import RenderingError
from signimit_envs.studio.arm.live_state import LiveState, is_alike
from signimit_envs.video.backend import INSTALL
from signimit_envs.video.scene_renderer import SceneRenderer
from signimit_envs.video.storyboard import PARKED, Shot

WIDTH, HEIGHT = 640, 480
FRAME_RATE = 30.0  # 1/s, while something moves
IDLE_RATE = 4.0  # 1/s, while nothing does
HAND_HEIGHT = 0.06  # m above the table, of the hand's tip
_QUALITY = 80
_MOST_RENDERERS = 2  # one for each number of objects; each holds a compiled scene
OPENGL_PATIENCE = 60.0  # s, for OpenGL to be found
_log = logging.getLogger(__name__)


def picture_mapping() -> dict[str, Any]:
    """Return how pixels of a picture map to metres, on the table and at the height of the hand."""
    model = compile_scene()
    number = model.camera("top").id
    x, y, height = model.cam_pos[number]
    per_metre = 2 * np.tan(np.radians(model.cam_fovy[number]) / 2) / HEIGHT
    scales = {"table": float(height * per_metre), "hand": float((height - HAND_HEIGHT) * per_metre)}
    return {"width": WIDTH, "height": HEIGHT, "centre": [float(x), float(y)], "metres_per_pixel": scales}


def object_colours() -> list[str]:
    """Return the colours of the objects as a page writes them, in order."""
    model, colours = compile_scene(OBJECT_COUNTS[-1]), []
    for number in range(OBJECT_COUNTS[-1]):
        geom = model.body_geomadr[model.body(f"object_{number}").id]
        material = model.geom_matid[geom]
        rgba = model.geom_rgba[geom] if material < 0 else model.mat_rgba[material]
        colours.append("#" + "".join(f"{round(255 * float(part)):02x}" for part in rgba[:3]))
    return colours


class Camera:
    """Renders frames of the live arm while a page watches, and still pictures of tables."""

    def __init__(self, look: Callable[[], LiveState], watched: Callable[[], bool], publish: Callable[[bytes], object]):
        """Remember what to draw; OpenGL is looked for in the camera's own thread.

        Args:
            look: Returns the state of the arm.
            watched: Tells whether a page watches.
            publish: Takes a frame, called in the camera's thread.
        """
        self._look, self._watched, self._publish = look, watched, publish
        self._wanted: queue.SimpleQueue[tuple[NDArray[np.float64], Future[bytes]]] = queue.SimpleQueue()
        self._stop, self._ready = threading.Event(), threading.Event()
        self._thread = threading.Thread(target=self._run, name="camera", daemon=True)
        self._renderers: dict[int, SceneRenderer] = {}
        self._unavailable: RenderingError | None = None
        self.frames = 0

    def start(self) -> None:
        """Start the thread."""
        self._thread.start()

    def close(self) -> None:
        """Stop and free OpenGL; may be called again, and before `start`."""
        self._stop.set()
        if self._thread.is_alive():
            self._thread.join()

    def unavailable_reason(self, patience: float = 0.0) -> str:
        """Say why there are no pictures, waiting so many seconds for the first one; empty if there are some."""
        self._ready.wait(patience)
        return str(self._unavailable or "")

    def still(self, objects: NDArray[np.float64]) -> Future[bytes]:
        """Render a JPEG of a table with objects, shape (O, 2), m, the arm out of the way.

        Returns:
            The picture, later; a RenderingError if there is no OpenGL.
        """
        future: Future[bytes] = Future()
        self._wanted.put((objects, future))
        return future

    def _run(self) -> None:
        try:
            self._jpeg(self._look().objects, PARKED)
        except RenderingError as error:
            self._unavailable = error
            _log.warning("no pictures: %s", error)
        self._ready.set()
        due, before, drawn_at = time.perf_counter(), None, 0.0
        while not self._stop.is_set():
            while not self._wanted.empty():
                objects, future = self._wanted.get()
                try:
                    future.set_result(self._jpeg(objects, PARKED))
                except Exception as error:
                    future.set_exception(error)
            state, now = self._look(), time.perf_counter()
            still = before is not None and is_alike(before, state)
            if self._watched() and not (still and now - drawn_at < 1.0 / IDLE_RATE):
                self._publish(self._frame(state))
                before, drawn_at = state, now
                self.frames += 1
            due = max(due + 1.0 / FRAME_RATE, time.perf_counter() - 1.0 / FRAME_RATE)
            self._stop.wait(max(0.0, due - time.perf_counter()))
        for renderer in self._renderers.values():
            renderer.close()

    def _frame(self, state: LiveState) -> bytes:
        picture = b""
        if self._unavailable is None:
            try:
                picture = self._jpeg(state.objects, state.joints)
            except Exception as error:  # whatever OpenGL does, the page can draw the table itself
                _log.exception("a frame could not be drawn; going on without pictures")
                self._unavailable = RenderingError(f"OpenGL failed ({error})", INSTALL)
        header = json.dumps(frame_header(state), separators=(",", ":")).encode()
        return struct.pack(">I", len(header)) + header + picture

    def _jpeg(self, objects: NDArray[np.float64], joints: NDArray[np.float64]) -> bytes:
        if self._unavailable is not None:
            raise RenderingError(self._unavailable.reason, self._unavailable.remedy)
        shot = Shot(phase="", caption="", objects=objects, joints=joints)
        encoded = io.BytesIO()
        Image.fromarray(self._renderer(len(objects)).picture(shot)).save(encoded, "JPEG", quality=_QUALITY)
        return encoded.getvalue()

    def _renderer(self, objects: int) -> SceneRenderer:
        if objects not in self._renderers:
            while len(self._renderers) >= _MOST_RENDERERS:
                self._renderers.pop(next(iter(self._renderers))).close()
            self._renderers[objects] = SceneRenderer(objects, WIDTH, HEIGHT)
        return self._renderers[objects]


def frame_header(state: LiveState) -> dict[str, Any]:
    """Return the JSON that is sent beside each picture."""
    task = state.task
    return {
        "session": state.session,
        "answer": task.answer if task else None,
        "time": round(state.time, 2),
        "hand": np.round(state.hand, 4).tolist(),
        "objects": np.round(state.objects, 4).tolist(),
        "trail": state.trail,
        "text": task.text if task else "",
        "focus": task.focus if task else None,
        "moving": task is not None,
        "done": state.done,
        "shoved": state.shoved,
    }
