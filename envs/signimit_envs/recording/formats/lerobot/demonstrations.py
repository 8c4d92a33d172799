"""Demonstrations as LeRobot data sets, one frame a sample of the hand."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import KIND, VERSION, Demonstration, DemonstrationSet
from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.safe_files import whole_folder
from signimit.signs import SAMPLES, normalised_sign
from signimit_envs.recording.formats.lerobot.frames import lerobot_errors, read_layout, write_layout
from signimit_envs.recording.formats.lerobot.layout import INFO, EpisodeFrames, Feature, Layout, import_pyarrow
from signimit_envs.recording.formats.lerobot.recordings import ORIGIN, TASK
from signimit_envs.recording.origin import HEADER
from signimit_envs.tabletop_hand import TabletopHandEnv

_ROBOT = "human_hand"
_SIGN = "signimit/sign_"  # columns of the table of episodes
_TIME_TOLERANCE = 1e-4  # s, of a frame; LeRobot's tolerance_s


def write_lerobot_demonstrations(
    folder: str | os.PathLike[str], demonstrations: DemonstrationSet, overwrite: bool = False
) -> None:
    """Write a LeRobot data set, whole or not at all.

    ``observation.state`` is the hand, m, ``observation.environment_state`` the objects, m, and the signs, resampled and
    scaled as in the environment; ``action`` the hand's mean velocity until the next sample, in units of
    `TabletopHandEnv.max_hand_speed`; ``time`` the exact time, s. The signs as they were drawn are in the table of
    episodes.

    Raises:
        InvalidInputError: If the name is taken, or the samples were not taken at a constant whole rate.
        MissingDependencyError: If pyarrow is not installed.
    """
    import_pyarrow()
    first = demonstrations[0]
    objects = [f"object_{k}_{axis}_m" for k in range(len(first.objects)) for axis in "xy"]
    signs = [f"sign_{k}_{i}_{axis}" for k in range(len(first.signs)) for i in range(SAMPLES) for axis in "xy"]
    names = {
        "observation.state": ["hand_x_m", "hand_y_m"],
        "observation.environment_state": [*objects, *signs],
        "action": ["hand_velocity_x", "hand_velocity_y"],
        "time": ["time_s"],
    }
    layout = Layout(
        fps=_frame_rate(demonstrations),
        robot=_ROBOT,
        task=TASK,
        features={name: Feature("float64", (len(parts),), parts) for name, parts in names.items()},
        episodes=[_frames(one) for one in demonstrations],
    )
    with whole_folder(folder, INFO, overwrite) as draft:
        (draft / ORIGIN).mkdir(parents=True)
        header = {"kind": KIND, "version": VERSION, "objects": len(first.objects)}
        (draft / ORIGIN / HEADER).write_text(json.dumps(header) + "\n", encoding="utf-8")
        write_layout(draft, layout)


def read_lerobot_demonstrations(folder: str | os.PathLike[str]) -> DemonstrationSet:
    """Read a data set of `write_lerobot_demonstrations`.

    Raises:
        FileFormatError: If it is half written or not a demonstration set of signimit.
        MissingDependencyError: If pyarrow is not installed.
    """
    place = Path(folder)
    with lerobot_errors(place):
        header = json.loads((place / ORIGIN / HEADER).read_bytes())
        kind, number = header["kind"], int(header["version"])
        if kind != KIND or number > VERSION:
            raise FileFormatError(str(place), f"a {KIND} of version <= {VERSION}", f"{kind} version {number}")
        count = int(header["objects"])
    episodes = read_layout(place, _SIGN)
    with lerobot_errors(place):
        demonstrations = []
        for frames in episodes:
            signs = tuple(frames.extras[f"{_SIGN}{number}"].reshape(-1, 2) for number in range(len(frames.extras)))
            objects = frames.columns["observation.environment_state"][0, : 2 * count].reshape(count, 2)
            hand, times = frames.columns["observation.state"], frames.columns["time"][:, 0]
            demonstrations.append(Demonstration(signs, objects, hand, times))
        return DemonstrationSet(demonstrations)


def _frame_rate(demonstrations: DemonstrationSet) -> int:
    """Return the rate at which all samples were taken, Hz."""
    rate = max(1, round(1 / float(np.median(np.diff(demonstrations[0].times)))))
    for number, times in enumerate(demonstrations.times):
        off = np.abs(times - times[0] - np.arange(len(times)) / rate)
        if off.max() > _TIME_TOLERANCE:
            expected = f"samples every 1/{rate} s, as LeRobot's frames are"
            found = f"one {off.max():.3g} s off at index {int(off.argmax())}"
            raise InvalidInputError(f"demonstration {number}: times", expected, found)
    return rate


def _frames(one: Demonstration) -> EpisodeFrames:
    """Return a demonstration as frames."""
    samples = len(one.hand)
    scene = np.concatenate([one.objects.ravel(), *(normalised_sign(sign).ravel() for sign in one.signs)])
    velocities = np.diff(one.hand, axis=0) / np.diff(one.times)[:, None]
    columns: dict[str, NDArray[Any]] = {
        "observation.state": one.hand,
        "observation.environment_state": np.tile(scene, (samples, 1)),
        "action": np.concatenate([velocities, np.zeros((1, 2))]) / TabletopHandEnv.max_hand_speed,
        "time": one.times[:, None],
    }
    return EpisodeFrames(columns, {f"{_SIGN}{number}": sign.ravel() for number, sign in enumerate(one.signs)})
