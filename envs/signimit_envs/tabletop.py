"""`signimit/Tabletop-v0`: signs to obey with a planar arm, commanded joint by joint."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import gymnasium as gym
import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit import InvalidInputError, UnknownNameError
from signimit.signs import SAMPLES
from signimit_envs.hand_control import HandController, JointCommand
from signimit_envs.judging import Judge
from signimit_envs.people import MOVEMENTS, People
from signimit_envs.physics_log import QuietLog
from signimit_envs.rendering import OffscreenView, WindowView, has_display
from signimit_envs.scene import CONTROL_RATE, MAX_JOINT_SPEED, SUBSTEPS, TABLE, compile_scene, object_bodies
from signimit_envs.situations import WORDS, Situation, draw_situation

Observation = dict[str, NDArray[np.float64]]

_LEAST_RESIDUAL = 1e-3  # m, farther than this from where it should start the hand is out of reach
_CAMERAS = ("perspective", "top")
_MODES = ("rgb_array", "human")


class TabletopEnv(gym.Env[dict[str, Any], NDArray[np.float32]]):
    """Obey two signs, unlabelled strokes, with a planar three-joint arm over a table with coloured objects.

    A synthetic person makes two signs; in this person's language the first names an object and the second a movement
    about it. Nobody says so: the request behind the signs is in ``info``, for scoring only. Metres, seconds, radians;
    x right, y away from the arm's base, origin at the middle of the table.

    Action space:
        ``Box(-1, 1, (3,), float32)``: velocities of shoulder, elbow and wrist, in units of 3.5 rad/s, for 1/50 s. What
        is beyond is clipped; the joints stop at their limits.

    Observation space:
        ``Dict`` of finite float64 boxes:

        ==================== ============ =====================================================================
        key                  shape        meaning
        ==================== ============ =====================================================================
        ``hand``             (2,)         position of the hand, m
        ``hand_velocity``    (2,)         its velocity, m/s
        ``joints``           (3,)         angles of shoulder, elbow and wrist, rad
        ``joint_velocities`` (3,)         their velocities, rad/s
        ``objects``          (O, 2)       positions of the objects, red, green, blue and so on, m
        ``signs``            (2, 64, 2)   the two signs, evenly resampled, centred, scaled to [-1, 1]
        ==================== ============ =====================================================================

    Reward:
        1 at the step where the request is seen to be fulfilled for the first time, else 0. The path of up to the last
        12 s is looked at every half second, first after 1.5 s: a look costs ten steps, so the reward may come up to
        half a second after the deed. `signimit.performed` is the judge.

    Starting state:
        What ``reset(options=...)`` gives of ``movement``, ``focus``, ``objects`` (O, 2), ``hand`` (2,) and ``signs``
        (two strokes of any length); the rest is drawn: objects and hand within 0.22 m and 0.18 m of the middle, objects
        at least 0.14 m apart. The arm rests.

    Episode end:
        Truncated after 12 s (600 steps). Success does not end an episode. A blow-up of the physics terminates it.

    Info:
        ``request`` (movement, focus), ``is_success`` (in this episode so far), ``performance`` (a
        `signimit.Performance`, of the moment of success; movement -1 before), ``ik_residual`` (m, what of the last
        displacement of the hand was beyond the arm; 0 here), ``physics_error`` (what went wrong; empty if nothing).

    Args:
        render_mode: ``"rgb_array"`` or, with a display, ``"human"``.
        objects: Number of objects, 2 to 6.
        movements: Labels of the movements that can be asked for, out of `signimit.people.MOVEMENT_LABELS`.
        people_seed: Who signs, and whose drawings the judge compares with.
        camera: ``"perspective"`` or ``"top"``.
        size: Width and height of frames, pixels, at most 1280.

    Version history:
        v0: first version.
    """

    metadata: dict[str, Any] = {  # noqa: RUF012 -- gymnasium declares it so
        "render_modes": list(_MODES) if has_display() else ["rgb_array"],
        "render_fps": CONTROL_RATE,
    }
    _action_size: ClassVar[int] = 3

    def __init__(
        self,
        render_mode: str | None = None,
        objects: int = 3,
        movements: Sequence[str] = MOVEMENTS,
        people_seed: int = 0,
        camera: str = "perspective",
        size: tuple[int, int] = (480, 480),
    ) -> None:
        """Build the scene; see the class for the arguments."""
        if render_mode not in (None, *_MODES):
            raise UnknownNameError("render mode", render_mode, _MODES)
        if camera not in _CAMERAS:
            raise UnknownNameError("camera", camera, _CAMERAS)
        self.render_mode = render_mode
        self.model = compile_scene(objects)
        self.data = mujoco.MjData(self.model)
        self.people = People.sample(objects, movements, np.random.default_rng(people_seed))
        self.controller = HandController(self.model)
        self.action_space = gym.spaces.Box(-1.0, 1.0, (self._action_size,), np.float32)
        self.observation_space = _observation_space(objects)
        self._judge = Judge(self.people.templates)
        self._bodies = object_bodies(self.model)
        self._hand_site = self.model.site("hand").id
        self._jacobian = np.zeros((3, self.model.nv))
        self._planar_jacobian = self._jacobian[:2]
        # Live views: to fetch them from the data in every control step would cost more than to read them.
        self._qpos, self._qvel, self._ctrl = self.data.qpos, self.data.qvel, self.data.ctrl
        self._hand = self.data.site_xpos[self._hand_site, :2]
        self._ranges = self.model.jnt_range.tolist()
        self._warnings = self.data.warning.number  # a live view; mj_resetData clears it
        self._speeds = np.full(3, MAX_JOINT_SPEED)
        self._camera = camera
        self._offscreen = OffscreenView(self.model, *size)
        self._window = WindowView(self.model) if render_mode == "human" else None

    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Start an episode.

        Args:
            seed: Seed of everything that is drawn from now on.
            options: Any of movement, focus, objects (O, 2), hand (2,) and signs (two strokes); the rest is drawn.

        Raises:
            SignimitError: If an option is unknown or cannot be used.
        """
        super().reset(seed=seed)
        start = draw_situation(options, self.people, len(self._bodies), self.np_random)
        joints, away = self.controller.posture_at(start.hand)
        if away > _LEAST_RESIDUAL:
            raise InvalidInputError("reset option hand", "a position within the arm's reach", f"{start.hand}")
        self._situation = start
        self._quiet_log = QuietLog()
        self._place(start, joints.tolist())
        self._judge.start(start.request, start.objects, start.hand)
        if self.render_mode == "human":
            self.render()
        return self._observation(), self._info(0.0, "")

    def step(self, action: ArrayLike) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Do one control step of 1/50 s.

        Args:
            action: Within [-1, 1]; what is beyond is clipped.

        Raises:
            InvalidInputError: If the action has another shape or is not finite.
        """
        command = self._command(self._checked(action))
        error = self._simulate(command.velocities)
        if error:
            self._place(self._situation, self._last_joints)
        observation = self._observation()
        reward = float(not error and self._judge.watch(observation["hand"]))
        if self.render_mode == "human":
            self.render()
        return observation, reward, bool(error), False, self._info(command.residual, error)

    def render(self) -> NDArray[np.uint8] | None:
        """Return a frame, shape (height, width, 3), or bring the window up to date.

        Raises:
            RenderingError: If there is no OpenGL or no display.
        """
        if self._window is not None:
            self._window.show(self.data)
            return None
        if self.render_mode is None:
            gym.logger.warn("render() does nothing without a render_mode: gym.make(..., render_mode='rgb_array').")
            return None
        return self._offscreen.frame(self.data, self._camera)

    def close(self) -> None:
        """Free windows and OpenGL; may be called again."""
        self._offscreen.close()
        if self._window is not None:
            self._window.close()

    def _command(self, action: NDArray[np.float64]) -> JointCommand:
        return JointCommand(np.multiply(action, self._speeds), 0.0)

    def _checked(self, action: ArrayLike) -> NDArray[np.float64]:
        try:
            values = np.asarray(action, dtype=np.float64)
        except (TypeError, ValueError):
            values = np.empty(0)
        if values.shape != (self._action_size,):
            raise InvalidInputError("action", f"{self._action_size} numbers in [-1, 1]", repr(action))
        for value in values.tolist():  # no comparison holds for NaN; for so few numbers a loop is the fastest
            if not -1.0 <= value <= 1.0:
                return self._clipped(values)
        return values

    def _clipped(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        if not np.isfinite(values).all():
            raise InvalidInputError("action", f"{self._action_size} finite numbers in [-1, 1]", repr(values))
        return values.clip(-1.0, 1.0)

    def _simulate(self, velocities: NDArray[np.float64]) -> str:
        """Track joint velocities for one control step, stopping at the joints' limits; return what went wrong."""
        self._ctrl[:] = [
            min(max(velocity, (low - joint) * CONTROL_RATE), (high - joint) * CONTROL_RATE)
            for velocity, joint, (low, high) in zip(velocities.tolist(), self._qpos.tolist(), self._ranges, strict=True)
        ]
        with self._quiet_log:
            mujoco.mj_step(self.model, self.data, SUBSTEPS)
        if any(self._warnings.tolist()):
            return "the physics blew up; the arm was put back where it was before this step"
        # What mj_step leaves behind was computed before its last integration.
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_comPos(self.model, self.data)
        self._last_joints = self._qpos.tolist()
        return ""

    def _place(self, start: Situation, joints: list[float]) -> None:
        """Put objects and a resting arm in their places."""
        self._last_joints = joints
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:] = joints
        self.data.mocap_pos[self._bodies, :2] = start.objects
        mujoco.mj_forward(self.model, self.data)

    def _observation(self) -> Observation:
        mujoco.mj_jacSite(self.model, self.data, self._jacobian, None, self._hand_site)
        start = self._situation
        return {
            "hand": self._hand.copy(),
            "hand_velocity": self._planar_jacobian.dot(self._qvel),
            "joints": self._qpos.copy(),
            "joint_velocities": self._qvel.copy(),
            "objects": start.objects.copy(),
            "signs": start.signs.copy(),
        }

    def _info(self, residual: float, error: str) -> dict[str, Any]:
        return {
            "request": self._situation.request,
            "is_success": self._judge.done,
            "performance": self._judge.performance,
            "ik_residual": residual,
            "physics_error": error,
        }


def _observation_space(objects: int) -> gym.spaces.Dict:
    """Bounds that nothing exceeds: the arm is 1.35 m long and starts 0.72 m from the table's centre."""

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
            "signs": box(1.0, WORDS, SAMPLES, 2),
        }
    )
