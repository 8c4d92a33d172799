"""The doctor: what works on this machine, what is missing, and the line that mends it."""

from __future__ import annotations

import importlib.metadata
import os
import platform
import sys
from typing import NamedTuple

import gymnasium as gym

from signimit_envs.exceptions import RenderingError
from signimit_envs.tabletop_hand import TabletopHandEnv
from signimit_envs.timing.environments import time_frames
from signimit_envs.video.rendering import choose_backend, has_display, renderer_name

_NEEDED = ("signimit", "mujoco", "mink", "gymnasium", "numpy", "scipy", "imageio", "imageio-ffmpeg")
_OPTIONAL = {"scripts": ("matplotlib", "tqdm", "tyro"), "strokes": ("defusedxml",), "fast": ("numba",)}


def main() -> None:
    """Say what works on this machine, what is missing, and the line that mends it. Ends with code 1 if something is."""
    findings = diagnose()
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


def diagnose() -> list[Finding]:
    """Look at versions, optional packages, the physics, OpenGL and video."""
    return [_python(), _packages(), *_extras(), _physics(), *_pictures(), _video(), _window()]


def _version(package: str) -> str | None:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return None


def _python() -> Finding:
    cores = os.cpu_count() or 1
    return Finding(
        "python", True, f"{platform.python_version()} on {platform.system()} {platform.machine()}, {cores} cores"
    )


def _packages() -> Finding:
    versions = {package: _version(package) for package in _NEEDED}
    missing = [package for package, version in versions.items() if version is None]
    found = ", ".join(f"{package} {version}" for package, version in versions.items() if version is not None)
    return Finding("packages", not missing, found, "pip install signimit" if missing else "")


def _extras() -> list[Finding]:
    findings = []
    for extra, packages in _OPTIONAL.items():
        missing = [package for package in packages if _version(package) is None]
        detail = f"without {', '.join(missing)} (optional)" if missing else ", ".join(packages)
        findings.append(Finding(extra, True, detail, f"pip install 'signimit[{extra}]'" if missing else ""))
    return findings


def _physics() -> Finding:
    env = gym.make("signimit/TabletopHand-v0")
    env.reset(seed=0, options={"hand": [0.0, 0.0]})
    for _ in range(10):
        observation, _, terminated, _, _ = env.step([0.5, 0.0])
    env.close()
    expected = 10 * 0.5 * TabletopHandEnv.max_hand_speed / 50
    off = abs(float(observation["hand"][0]) - expected)
    return Finding(
        "physics", not terminated and off < 0.005, f"the hand moved {expected:.2f} m, within {off * 1e3:.1f} mm"
    )


def _pictures() -> list[Finding]:
    try:
        backend = choose_backend() or "the system's"
        frames = time_frames(turns=10)
        chosen = "MUJOCO_GL asks for it" if os.environ.get("MUJOCO_GL") else "chosen"
        detail = ", ".join(f"{frame.work} {frame.seconds * 1e3:.1f} ms" for frame in frames)
        return [
            Finding("opengl", True, f"{backend} ({chosen}), drawn by {renderer_name()}"),
            Finding("frames", True, f"480x480: {detail}"),
        ]
    except RenderingError as error:
        return [Finding("opengl", False, error.reason, error.remedy)]


def _video() -> Finding:
    import imageio_ffmpeg

    try:
        version = imageio_ffmpeg.get_ffmpeg_version()
    except RuntimeError as error:
        return Finding("video", False, str(error).splitlines()[0], "pip install 'imageio[ffmpeg]'")
    return Finding("video", True, f"ffmpeg {version}")


def _window() -> Finding:
    if has_display():
        return Finding("window", True, "render_mode='human' opens one")
    return Finding("window", True, "no display: only render_mode='rgb_array' (optional)")
