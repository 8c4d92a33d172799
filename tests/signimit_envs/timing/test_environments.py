"""Environments are stepped as often as the bare simulator, with the same actions; their times are not looked at."""

from __future__ import annotations

import mujoco
import pytest

from signimit_envs import ENV_IDS, RenderingError
from signimit_envs.arm.scene import SUBSTEPS
from signimit_envs.timing.environments import STEP_LIMITS, time_frames, time_steps, time_vector_envs


@pytest.mark.parametrize("env_id", ENV_IDS)
def test_a_step_is_compared_with_the_bare_simulator(env_id: str, monkeypatch: pytest.MonkeyPatch) -> None:
    counts: dict[int, int] = {}
    simulate = mujoco.mj_step

    def counted(model: object, data: object, nstep: int = 1) -> None:
        counts[id(data)] = counts.get(id(data), 0) + nstep
        simulate(model, data, nstep)

    monkeypatch.setattr(mujoco, "mj_step", counted)
    timing = time_steps(env_id, turns=2, steps=5)
    assert timing.work == f"a step of {env_id}"
    assert timing.limit == STEP_LIMITS[env_id]
    assert timing.plain is not None
    assert timing.ratio is not None
    assert min(timing.seconds, timing.plain, timing.ratio) > 0
    assert set(counts.values()) == {2 * 5 * SUBSTEPS}


def test_all_ways_to_step_environments_are_compared_with_the_loop() -> None:
    first, *others = time_vector_envs(1, turns=1, steps=5)
    assert (first.work, first.ratio) == ("a step of 1, a loop over gym.make", 1.0)
    ways = ["a loop over TabletopHandEnv", "SyncVectorEnv", "AsyncVectorEnv"]
    assert [other.work for other in others] == [f"a step of 1, {way}" for way in ways]
    assert all(other.plain == first.seconds and other.seconds > 0 for other in others)


def test_a_frame_of_each_camera_is_timed() -> None:
    try:
        frames = time_frames(turns=2, size=32)
    except RenderingError as error:
        pytest.skip(str(error))
    assert [frame.work for frame in frames] == ["a frame, perspective", "a frame, top"]
    assert all(frame.seconds > 0 and frame.limit == 0.012 for frame in frames)
