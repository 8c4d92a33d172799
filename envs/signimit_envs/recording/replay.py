"""Replay of recordings: exact simulation from the recorded controls, observations and films of recorded states."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from typing import Any, NamedTuple

import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError, UnknownNameError
from signimit_envs.arm.scene import OBJECT_COUNTS, object_bodies
from signimit_envs.recording.episodes import RecordedEpisode, Recording
from signimit_envs.recording.origin import STATE_SPEC, RecordingOrigin
from signimit_envs.video.rendering import OffscreenView

_LEAST_MEMORY = 2**16  # bytes a simulation may take; with less MuJoCo fails in some postures, which take up to 2 kB


class Divergence(NamedTuple):
    """First difference between a simulation and the recording.

    Attributes:
        step: The first control step, from 0, after which the states differ.
        difference: Largest difference of an element of the state then.
    """

    step: int
    difference: float


def find_divergence(origin: RecordingOrigin, episode: RecordedEpisode) -> Divergence | None:
    """Simulate an episode from its first state with the recorded controls, and compare every state bit for bit.

    A blow-up of the physics, after which the environment put the arm back, is not simulated: the recorded state is
    taken.

    Returns:
        The first difference; None if all states are equal.

    Raises:
        FileFormatError: If the states or controls are not those of the model.
    """
    model, data = _prepared(origin, episode)
    state = np.empty_like(episode.states[0])
    mujoco.mj_setState(model, data, episode.states[0], STATE_SPEC)
    for step, (controls, after) in enumerate(zip(episode.controls, episode.states[1:], strict=True)):
        if episode.terminations[step]:
            mujoco.mj_setState(model, data, after, STATE_SPEC)
            continue
        data.ctrl[:] = controls
        mujoco.mj_step(model, data, origin.substeps)
        mujoco.mj_getState(model, data, state, STATE_SPEC)
        if state.tobytes() != after.tobytes():
            return Divergence(step, float(np.abs(state - after).max()))
    return None


def observe_states(origin: RecordingOrigin, episode: RecordedEpisode) -> dict[str, NDArray[np.float64]]:
    """Observe a recorded episode as the environment does, from its physics states alone.

    Returns:
        ``time`` (T + 1,), s; ``hand`` (T + 1, 2), m; ``hand_velocity`` (T + 1, 2), m/s; ``joints`` (T + 1, 3), rad;
        ``joint_velocities`` (T + 1, 3), rad/s; ``objects`` (T + 1, O, 2), m.

    Raises:
        FileFormatError: If the states are not those of the model, or it is not that of the tabletop.
    """
    model, data = _prepared(origin, episode)
    hand, bodies = _observed_parts(model)
    jacobian = np.zeros((3, model.nv))
    rows: list[dict[str, Any]] = []
    for _ in _play(model, data, episode):
        mujoco.mj_jacSite(model, data, jacobian, None, hand)
        rows.append(
            {
                "time": np.array(data.time),
                "hand": data.site_xpos[hand, :2].copy(),
                "hand_velocity": jacobian[:2].dot(data.qvel),
                "joints": data.qpos.copy(),
                "joint_velocities": data.qvel.copy(),
                "objects": data.mocap_pos[bodies, :2].copy(),
            }
        )
    return {name: np.stack([row[name] for row in rows]) for name in rows[0]}


def film_states(
    origin: RecordingOrigin, episode: RecordedEpisode, camera: str = "perspective", size: tuple[int, int] = (480, 480)
) -> Iterator[NDArray[np.uint8]]:
    """Film a recorded episode, T + 1 frames of shape (height, width, 3).

    Args:
        origin: The recording's origin.
        episode: The episode.
        camera: A camera of the recorded model.
        size: Width and height, pixels.

    Raises:
        FileFormatError: If the states are not those of the model.
        UnknownNameError: If there is no such camera.
        InvalidInputError: If the size is too small or too large.
        RenderingError: If there is no OpenGL.
    """
    model, data = _prepared(origin, episode)
    cameras = [model.camera(number).name for number in range(model.ncam)]
    if camera not in cameras:
        raise UnknownNameError("camera", camera, cameras)
    with closing(OffscreenView(model, *size)) as view:
        for _ in _play(model, data, episode):
            yield view.frame(data, camera)


def check_recording(recording: Recording, where: str) -> Recording:
    """Return a recording whose every episode can be replayed, observed and filmed; readers of files end with this.

    Raises:
        FileFormatError: If its model does not compile, is not that of the tabletop, or has other states or controls
            than were recorded; the message begins with ``where``.
    """
    try:
        model, _ = _prepared(recording.origin, recording[0])  # all have rows of the same shapes
        _observed_parts(model)
    except FileFormatError as error:
        raise error.inside(where) from None
    return recording


def _prepared(origin: RecordingOrigin, episode: RecordedEpisode) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """Compile the recorded model, and check that the episode's states and controls are its own."""
    model = origin.compile_model()
    sizes = mujoco.mj_stateSize(model, STATE_SPEC), model.nu
    found = episode.states.shape[1], episode.controls.shape[1]
    if sizes != found:
        expected = f"states of {sizes[0]} and controls of {sizes[1]} numbers, as the model has"
        raise FileFormatError("recorded episode", expected, f"{found[0]} and {found[1]}")
    if model.narena < _LEAST_MEMORY:
        raise FileFormatError("recorded model", f"at least {_LEAST_MEMORY} bytes of memory", f"{model.narena}")
    return model, mujoco.MjData(model)


def _observed_parts(model: mujoco.MjModel) -> tuple[int, list[int]]:
    """Return the number of the hand's site and the mocap numbers of the objects.

    Raises:
        FileFormatError: If the model is not that of a tabletop with an arm of three joints.
    """
    joints, drives, objects = (model.nq, model.nv), model.nu, model.nmocap
    if joints != (3, 3) or drives != 3 or objects not in OBJECT_COUNTS:
        expected = f"3 joints, 3 drives and {OBJECT_COUNTS[0]} to {OBJECT_COUNTS[-1]} objects"
        raise FileFormatError("recorded model", expected, f"{joints[0]}, {drives} and {objects}")
    named = [(mujoco.mjtObj.mjOBJ_BODY, f"object_{number}") for number in range(objects)]
    for kind, name in [(mujoco.mjtObj.mjOBJ_SITE, "hand"), *named]:
        if mujoco.mj_name2id(model, kind, name) < 0:
            raise FileFormatError("recorded model", f"a site 'hand' and {objects} objects, by name", f"no {name!r}")
    bodies = object_bodies(model)
    if sorted(bodies) != list(range(objects)):
        raise FileFormatError("recorded model", "objects that are mocap bodies", "others")
    return model.site("hand").id, bodies


def _play(model: mujoco.MjModel, data: mujoco.MjData, episode: RecordedEpisode) -> Iterator[None]:
    """Set the data to one recorded state after the other, with its kinematics computed."""
    for state in episode.states:
        mujoco.mj_setState(model, data, state, STATE_SPEC)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        mujoco.mj_camlight(model, data)
        yield
