"""Silence ends when the last one leaves, whoever entered first."""

import mujoco
import pytest

from signimit_envs.arm.batch.physics import QuietLog


def logs() -> bool:
    return bool(mujoco.MjLogConfig.get().logto_file)


def test_mujoco_logs_again_afterwards_also_after_an_error() -> None:
    assert logs()
    with QuietLog():
        assert not logs()
    assert logs()
    with pytest.raises(mujoco.FatalError), QuietLog():
        raise mujoco.FatalError
    assert logs()


def test_who_was_made_or_entered_in_somebody_elses_silence_does_not_keep_it() -> None:
    first = QuietLog()
    first.__enter__()
    second = QuietLog()
    second.__enter__()
    first.__exit__(None, None, None)
    assert not logs()
    second.__exit__(None, None, None)
    assert logs()
