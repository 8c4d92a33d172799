"""A window where a display opens one, one clear sentence where none does: never the end of the process."""

from __future__ import annotations

import os
import subprocess
import sys

import gymnasium as gym
import pytest
from gymnasium.utils.env_checker import check_env

from signimit_envs import RenderingError, TabletopEnv
from signimit_envs.arm.scene import compile_scene
from signimit_envs.video import window
from signimit_envs.video.window import WindowView, has_display, opens_windows

DEAD = ":4711"


@pytest.fixture
def no_display(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "linux")
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)


@pytest.mark.usefixtures("no_display")
def test_a_window_without_a_display_is_refused_before_it_ends_the_process() -> None:
    assert not has_display()
    with pytest.raises(RenderingError, match="there is no display for render_mode='human'"):
        WindowView(compile_scene())


@pytest.mark.usefixtures("no_display")
def test_gymnasium_does_not_take_human_for_a_matter_of_pygame() -> None:
    with pytest.raises(RenderingError, match="there is no display for render_mode='human'"):
        gym.make("signimit/Tabletop-v0", render_mode="human")


@pytest.mark.skipif(sys.platform != "linux", reason="displays have names on Linux")
@pytest.mark.parametrize("name", ["DISPLAY", "WAYLAND_DISPLAY"])
def test_a_dead_display_is_told_and_ends_nothing(name: str) -> None:
    program = (
        "import gymnasium as gym, signimit_envs\n"
        "try:\n"
        "    gym.make('signimit/TabletopHand-v0', render_mode='human').reset(seed=0)\n"
        "except signimit_envs.RenderingError as error:\n"
        "    print(error)\n"
    )
    environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    environment |= {name: DEAD, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=False)
    sentence = f"Cannot render: {name}='{DEAD}' opens no window for render_mode='human'. Use render_mode='rgb_array'.\n"
    assert (done.returncode, done.stdout) == (0, sentence), done.stderr


@pytest.mark.usefixtures("no_display")
def test_gymnasium_approves_where_a_display_is_dead(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DISPLAY", DEAD)
    asked = []

    def opens(*displays: str | None) -> bool:
        asked.append(displays)
        return False

    monkeypatch.setattr(window, "_opens", opens)
    env = gym.make("signimit/Tabletop-v0").unwrapped
    assert env.metadata["render_modes"] == ["rgb_array"]
    assert TabletopEnv.metadata["render_modes"] == ["rgb_array", "human"]
    assert asked == [(DEAD, None)]
    check_env(env, skip_render_check=True)


@pytest.mark.usefixtures("no_display")
def test_a_copy_on_a_machine_without_a_display_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(window, "_opens", lambda *displays: True)
    assert opens_windows()
    view = WindowView(compile_scene())
    monkeypatch.delenv("DISPLAY")
    with pytest.raises(RenderingError, match="there is no display"):
        view.show(None)
    view.close()
