"""Renderer of the scene in films, from above: arm, objects, the demonstrator's hand, and trails on the table."""

from __future__ import annotations

import itertools

import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit_envs.arm.scene import compile_scene, object_bodies
from signimit_envs.video.rendering import OffscreenView
from signimit_envs.video.storyboard import Shot

ROBOT_TRAIL = (0.07, 0.07, 0.09, 1.0)  # rgba
HUMAN_TRAIL = (0.42, 0.13, 0.52, 1.0)
_TRAIL_HEIGHT, _TRAIL_RADIUS = 0.005, 0.0045  # m
_HAND_RADIUS = 0.028  # m, of the ball that stands for the demonstrator's hand
_CAMERA = "top"
_VIEW_HEIGHT = 1.08  # m of the table that an orthographic picture is high: the tabletop and a margin
_MAX_SEGMENTS = 240  # of a trail; longer ones are thinned out, since a scene holds a limited number of geometries


class SceneRenderer:
    """Renderer of the scenes of shots with one number of objects."""

    def __init__(self, objects: int, width: int, height: int, orthographic: bool = False) -> None:
        """Compile the scene for pictures of a size; OpenGL is looked for at the first picture.

        Args:
            objects: Number of objects.
            width: Width of pictures, pixels.
            height: Height of pictures, pixels.
            orthographic: Look from infinitely far above, so that a hand above its trail is seen on it.
        """
        self._model = compile_scene(objects)
        if orthographic:
            camera = self._model.camera(_CAMERA).id
            self._model.cam_projection[camera] = mujoco.mjtProjection.mjPROJ_ORTHOGRAPHIC
            self._model.cam_fovy[camera] = _VIEW_HEIGHT
        self._data = mujoco.MjData(self._model)
        self._bodies = object_bodies(self._model)
        self._view = OffscreenView(self._model, width, height)

    def picture(self, shot: Shot) -> NDArray[np.uint8]:
        """Draw the scene of a shot as seen from above, y up, shape (height, width, 3).

        Raises:
            RenderingError: If there is no OpenGL.
        """
        self._data.qpos[:] = shot.joints
        self._data.mocap_pos[self._bodies, :2] = shot.objects
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_camlight(self._model, self._data)

        def decorate(scene: mujoco.MjvScene) -> None:
            add_trail(scene, shot.trail, HUMAN_TRAIL if shot.phase in ("A", "B") else ROBOT_TRAIL)
            if shot.human_hand is not None:
                add_ball(scene, shot.human_hand, _HAND_RADIUS, HUMAN_TRAIL)

        return self._view.frame(self._data, _CAMERA, decorate)

    def close(self) -> None:
        """Free the OpenGL context; may be called again."""
        self._view.close()


def add_trail(scene: mujoco.MjvScene, points: NDArray[np.float64], colour: tuple[float, ...]) -> None:
    """Add a line through points on the table, shape (T, 2), m, to a scene before it is drawn."""
    if len(points) < 2:
        return
    kept = points[np.unique(np.linspace(0, len(points) - 1, _MAX_SEGMENTS + 1).astype(int))]
    corners = np.column_stack([kept, np.full(len(kept), _TRAIL_HEIGHT)])
    for start, end in itertools.pairwise(corners):
        geom = _new_geom(scene, mujoco.mjtGeom.mjGEOM_CAPSULE, colour)
        if geom is None:
            return
        mujoco.mjv_connector(geom, mujoco.mjtGeom.mjGEOM_CAPSULE, _TRAIL_RADIUS, start, end)


def add_ball(scene: mujoco.MjvScene, place: NDArray[np.float64], radius: float, colour: tuple[float, ...]) -> None:
    """Add a ball that rests on the table at a place, shape (2,), m, to a scene before it is drawn."""
    geom = _new_geom(scene, mujoco.mjtGeom.mjGEOM_SPHERE, colour)
    if geom is not None:
        geom.size[:] = radius
        geom.pos[:] = (*place, radius)


def _new_geom(scene: mujoco.MjvScene, kind: mujoco.mjtGeom, colour: tuple[float, ...]) -> mujoco.MjvGeom | None:
    """Take the scene's next free geometry; None if there is none."""
    if scene.ngeom >= scene.maxgeom:
        return None
    geom = scene.geoms[scene.ngeom]
    mujoco.mjv_initGeom(geom, kind, np.zeros(3), np.zeros(3), np.eye(3).ravel(), np.array(colour, dtype=np.float32))
    scene.ngeom += 1
    return geom
