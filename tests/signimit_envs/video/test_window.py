"""A window where a display opens one, one clear sentence where none does: never the end of the process."""

from __future__ import annotations

import copy
import gc
import os
import pickle
import subprocess
import sys
import threading
from collections.abc import Callable
from types import SimpleNamespace

import gymnasium as gym
import mujoco
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


class Viewer:
    """Stands in for MuJoCo's: it has a thread, and cannot be copied."""

    def __init__(self, model: object, data: object, **options: object) -> None:
        self.data, self.syncs, self.over = data, 0, threading.Event()
        threading.Thread(target=self.over.wait).start()

    def sync(self) -> None:
        self.syncs += 1

    def close(self) -> None:
        self.over.set()

    def __reduce__(self) -> str:
        raise TypeError("windows cannot be copied")


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[Viewer]:
    """Windows that were opened, on a display that opens them."""
    viewers: list[Viewer] = []

    def launch(*scene: object, **options: object) -> Viewer:
        viewers.append(Viewer(*scene, **options))
        return viewers[-1]

    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(window, "_opens", lambda *displays: True)
    module = SimpleNamespace(launch_passive=launch)
    monkeypatch.setitem(sys.modules, "mujoco.viewer", module)
    monkeypatch.setattr(mujoco, "viewer", module, raising=False)
    return viewers


@pytest.mark.parametrize("way", [copy.deepcopy, lambda view: pickle.loads(pickle.dumps(view))])
def test_a_copy_opens_a_window_of_its_own_once_the_other_is_closed(
    opened: list[Viewer], way: Callable[[WindowView], WindowView]
) -> None:
    """Two at once would end the process."""
    view, data, other = WindowView(compile_scene()), object(), object()
    view.show(data)
    twin = way(view)
    with pytest.raises(RenderingError, match="one window at a time, and another is open"):
        twin.show(other)
    view.show(data)
    view.close()
    view.close()
    twin.show(other)
    assert [(viewer.data, viewer.syncs) for viewer in opened] == [(data, 2), (other, 1)]
    twin.close()
    assert all(viewer.over.is_set() for viewer in opened)
    assert not any(thread.is_alive() for thread in WindowView._threads)


def test_a_window_that_nobody_closes_is_closed_with_its_environment(opened: list[Viewer]) -> None:
    env = gym.make("signimit/Tabletop-v0", render_mode="human")
    env.reset(seed=0)
    env.step(env.action_space.sample())
    assert opened[0].syncs == 2
    del env
    gc.collect()
    assert opened[0].over.is_set()
