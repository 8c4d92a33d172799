"""The environment `signimit/Tabletop-v0`: a planar arm that two signs instruct."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import gymnasium as gym
import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit import InvalidInputError, UnknownNameError
from signimit.teaching.languages import Language, Request
from signimit.teaching.people.choosing import Source
from signimit_envs.arm.arm import Arm
from signimit_envs.arm.inverse_kinematics import HandController
from signimit_envs.arm.scene import CONTROL_RATE, MAX_HAND_SPEED, compile_scene
from signimit_envs.tabletop.actions import checked_action, make_control
from signimit_envs.tabletop.language_options import choose_language, choose_person
from signimit_envs.tabletop.observations import CameraView, make_observer
from signimit_envs.tabletop.people import choose_tabletop_people
from signimit_envs.tabletop.reset_options import draw_episode_start
from signimit_envs.tabletop.rewards import make_reward
from signimit_envs.tabletop.success import SuccessDetector
from signimit_envs.video.rendering import OffscreenView
from signimit_envs.video.window import WindowView, opens_windows

_START_TOLERANCE = 1e-3  # m; a start that inverse kinematics miss by more is out of the arm's reach
_CAMERAS = ("perspective", "top")
_MODES = ("rgb_array", "human")


class TabletopEnv(gym.Env[Any, NDArray[np.float32]]):
    """Obey two signs, unlabelled strokes, with a planar three-joint arm over a table with coloured objects.

    A person makes signs; in this person's language one names an object and one a movement about it. Nobody says so:
    the request behind the signs is in ``info``, for scoring only. Metres, seconds, radians; x right, y away from the
    arm's base, origin at the middle of the table.

    Action space:
        What is beyond -1 and 1 is clipped; the joints stop at their limits. ``control`` decides what an action is:

        =================== ========================= ================================================== ===========
        ``control``         space                     meaning of an element, held for 1/50 s             unit of 1
        =================== ========================= ================================================== ===========
        ``joint``           Box(-1, 1, (3,), float32) angular velocity of shoulder, elbow and wrist      3.5 rad/s
        ``hand``            Box(-1, 1, (2,), float32) velocity of the hand along x and y; mink solves    1.2 m/s
                                                      for the joints, as far as they reach
        =================== ========================= ================================================== ===========

    Observation space:
        ``obs_type="state"``: a ``Dict`` of finite float64 boxes, O objects and W signs:

        ==================== ============ =====================================================================
        key                  shape        meaning
        ==================== ============ =====================================================================
        ``hand``             (2,)         position of the hand, m
        ``hand_velocity``    (2,)         its velocity, m/s
        ``joints``           (3,)         angles of shoulder, elbow and wrist, rad
        ``joint_velocities`` (3,)         their velocities, rad/s
        ``objects``          (O, 2)       positions of the objects, red, green, blue and so on, m
        ``signs``            (W, 64, 2)   the signs, evenly resampled, centred, scaled to [-1, 1]
        ==================== ============ =====================================================================

        ``obs_type="pixels"``: ``Box(0, 255, (height, width, 3), uint8)``, one picture. Its upper quarter shows the
        signs on cards, in order, each stroke from black at its beginning to orange at its end; below is what the camera
        sees. Velocities are not in a picture: stack frames (`gymnasium.wrappers.FrameStackObservation`).

        ``obs_type="state_pixels"``: the ``Dict`` with that picture as ``pixels``.

        Pictures need OpenGL; without one the first reset raises a `RenderingError`, and so does a picture in another
        thread than the first, or in a process that was forked off after one (give workers ``context="spawn"``). A deep
        copy or a pickle goes on as the original does, with a renderer of its own. `render` shows the scene alone:
        with `gymnasium.wrappers.AddRenderObservation` say ``render_only=False``, or the signs are not observed.

    Reward:
        ``reward="sparse"``: 1 at the step where the request is seen to be fulfilled for the first time, else 0. The
        request is fulfilled when `signimit.performed` takes the path of up to the last 12 s for the requested movement
        about the requested object, rather than for any other: the end of the path, as long as one drawing of it, must
        follow a drawing of the mover's from its beginning to its end, in order, with a misfit of at most 0.22 half
        sizes, past at least 95 % of it, in 0.77 to 1.34 times its size. A hand that joins the drawing elsewhere has to
        draw a whole round after its first turn. So half a turn is no success however long the hand rests after it, nor
        is another shape, nor the right one the wrong way round. The path is looked at every half second, first after
        1.5 s: a look costs many steps, so the reward may come up to half a second after the deed.

        ``reward="dense"``: that plus γ Φ(s') - Φ(s), with γ the ``discount``; it leaves optimal policies as they are
        (Ng, Harada and Russell, ICML 1999). The potential Φ, in [0, 1], is 3/4 of how much of the requested drawing
        the hand has passed, the drawing's way, plus 1/4 of how close it is to it
        (`signimit_envs.tabletop.rewards.Potential`). It is 0 after a blow-up.

    Starting state:
        What ``reset(options=...)`` gives of ``movement``, ``focus``, ``objects`` (O, 2), ``hand`` (2,) and ``signs``
        (W strokes of any length); the rest is drawn: objects and hand within 0.22 m and 0.18 m of the middle, objects
        at least 0.14 m apart. The arm rests.

    Episode end:
        Truncated after 12 s (600 steps). Success does not end an episode. A blow-up of the physics terminates it.

    Info:
        ``request`` (movement, focus), ``is_success`` (in this episode so far), ``performance`` (a
        `signimit.Performance`, of the latest look; movement -1 for none, misfit infinite while the hand has not been
        all about the requested drawing), ``success_performance`` (that of the look that saw the request fulfilled;
        movement -1 before), ``ik_residual`` (m, what of the last
        displacement of the hand was beyond the arm; 0 with joint control), ``physics_error`` (what went wrong; empty if
        nothing).

    Args:
        render_mode: ``"rgb_array"`` or, with a display, ``"human"``.
        objects: Number of objects, 2 to 6; 3 if nothing says otherwise.
        movements: Labels of the movements that can be asked for, out of
            `signimit.teaching.people.MOVEMENT_LABELS`; the paper's three if nothing says otherwise.
        people_seed: Who signs, and whose drawings the judge compares with.
        camera: ``"perspective"`` or ``"top"``.
        size: Width and height of pictures, rendered or observed, pixels; at most 1280, at least 32 to observe.
        obs_type: ``"state"``, ``"pixels"`` or ``"state_pixels"``.
        control: ``"joint"`` or ``"hand"``; the default of ``signimit/TabletopHand-v0`` is the latter.
        language: A `signimit.teaching.languages.Language`, or a mapping of its fields, which an `EnvSpec` can keep
            as JSON: signs of the objects and of the movements, their order, fillers. It brings its own number of
            objects and its movements. Left out: digits, the first ones for the objects and the next for the movements,
            object first. ``prototypes``, ``unseen`` and ``repetitions`` are about demonstrations and do nothing here.
        signer: Stroke library file with the signs, or the file and a person in it; left out, a synthetic person.
        mover: The same for the drawings that the judge compares with.
        reward: ``"sparse"`` or ``"dense"``.
        discount: The γ of the dense reward; give the agent the same.

    Version history:
        v0: first version.
    """

    metadata: dict[str, Any] = {  # noqa: RUF012 -- gymnasium declares it so
        "render_modes": list(_MODES),
        "render_fps": CONTROL_RATE,
    }
    max_hand_speed: ClassVar[float] = MAX_HAND_SPEED
    """Speed in m/s along each axis that an action of 1 stands for with hand control."""

    def __init__(
        self,
        render_mode: str | None = None,
        objects: int | None = None,
        movements: Sequence[str] | None = None,
        people_seed: int = 0,
        camera: str = "perspective",
        size: tuple[int, int] = (480, 480),
        *,
        obs_type: str = "state",
        control: str = "joint",
        language: Language | Mapping[str, Any] | None = None,
        signer: Source | Sequence[str | None] | str | None = None,
        mover: Source | Sequence[str | None] | str | None = None,
        reward: str = "sparse",
        discount: float = 0.99,
    ) -> None:
        """Build the scene; see the class for the arguments."""
        if render_mode not in (None, *_MODES):
            raise UnknownNameError("render mode", render_mode, _MODES)
        if camera not in _CAMERAS:
            raise UnknownNameError("camera", camera, _CAMERAS)
        if not opens_windows():  # the class names all modes, or Gymnasium would draw "human" itself, with pygame
            self.metadata = {**self.metadata, "render_modes": ["rgb_array"]}
        self.render_mode = render_mode
        spoken = choose_language(language, objects, movements)
        self._arm = Arm(compile_scene(spoken.objects))
        self.model, self.data = self._arm.model, self._arm.data
        self.people = choose_tabletop_people(
            spoken, np.random.default_rng(people_seed), choose_person(signer, "signer"), choose_person(mover, "mover")
        )
        self.controller = HandController(self.model)
        self.control, self._control = control, make_control(control, self.controller)
        self.action_space = gym.spaces.Box(-1.0, 1.0, (self._control.size,), np.float32)
        self._observer = make_observer(obs_type, self._arm, spoken.words, CameraView(camera, *size))
        self.observation_space = self._observer.space
        self._request: Request | None = None  # before the first reset
        self._success = SuccessDetector(self.people.templates)
        self._reward = make_reward(reward, discount)
        self._camera = camera
        self._offscreen = OffscreenView(self.model, *size)
        self._window = WindowView(self.model) if render_mode == "human" else None

    def reset(self, *, seed: int | None = None, options: Mapping[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Start an episode.

        Args:
            seed: Seed of all random draws from now on.
            options: Any of movement, focus, objects (O, 2), hand (2,) and signs (W strokes); the rest is drawn.

        Raises:
            SignimitError: If an option is unknown or cannot be used.
            RenderingError: If pictures are to be observed and there is no OpenGL.
        """
        super().reset(seed=seed)
        start = draw_episode_start(options, self.people, len(self._arm.object_bodies), self.np_random)
        joints, away = self.controller.posture_at(start.hand)
        if away > _START_TOLERANCE:
            raise InvalidInputError("reset option hand", "a position within the arm's reach", f"{start.hand}")
        self._request = start.request
        self._arm.place(start.objects, joints)
        self._success.start(start.request, start.objects, start.hand)
        self._reward.start(self._success.drawing, start.objects[start.request.focus], start.hand)
        self._observer.start(start)
        if self.render_mode == "human":
            self.render()
        return self._observer.observe(), self._info(0.0, "")

    def step(self, action: ArrayLike) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Do one control step of 1/50 s.

        Args:
            action: Within [-1, 1]; what is beyond is clipped.

        Raises:
            InvalidInputError: If there was no reset, or the action has another shape or is not finite.
        """
        if self._request is None:
            raise InvalidInputError("environment", "a reset before the first step", "none")
        arm = self._arm
        command = self._control.command(checked_action(action, self._control.size), self.data.qpos)
        error = arm.track(command.velocities)
        fulfilled = not error and self._success.watch(arm.hand)
        reward = self._reward.of_step(arm.hand, fulfilled, bool(error))
        if self.render_mode == "human":
            self.render()
        residual = 0.0 if error else command.residual  # of a state that blew up nothing can be solved
        return self._observer.observe(), reward, bool(error), False, self._info(residual, error)

    def render(self) -> NDArray[np.uint8] | None:
        """Return a frame, shape (height, width, 3), or bring the window up to date.

        Raises:
            InvalidInputError: If there was no reset.
            RenderingError: If there is no OpenGL or no display.
        """
        if self._request is None:
            raise InvalidInputError("environment", "a reset before the first picture", "none")
        if self._window is not None:
            self._window.show(self.data)
            return None
        if self.render_mode is None:
            gym.logger.warn("render() does nothing without a render_mode: gym.make(..., render_mode='rgb_array').")
            return None
        return self._offscreen.frame(self.data, self._camera)

    @property
    def hand(self) -> NDArray[np.float64]:
        """Where the hand is, shape (2,), m, whatever is observed; a copy."""
        return np.array(self._arm.hand, dtype=np.float64)

    def close(self) -> None:
        """Free windows and OpenGL; may be called again."""
        self._offscreen.close()
        self._observer.close()
        if self._window is not None:
            self._window.close()

    def _info(self, residual: float, error: str) -> dict[str, Any]:
        return {
            "request": self._request,
            "is_success": self._success.done,
            "performance": self._success.performance,
            "success_performance": self._success.success_performance,
            "ik_residual": residual,
            "physics_error": error,
        }
