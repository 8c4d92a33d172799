"""Video files, written as the frames come, and there only when whole."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

import imageio_ffmpeg
import numpy as np
from numpy.typing import NDArray

from signimit import InvalidInputError
from signimit.atomic import replaced_path
from signimit_envs.scene import CONTROL_RATE


def write_video(path: str | os.PathLike[str], frames: Iterable[NDArray[np.uint8]], rate: float = CONTROL_RATE) -> int:
    """Write frames to an mp4 file (H.264) that appears under its name when the last one is in.

    Args:
        path: The file; one that is there is replaced.
        frames: Each of shape (height, width, 3), all alike, sides even.
        rate: Frames per second.

    Returns:
        The number of frames.

    Raises:
        InvalidInputError: If there are no frames, they are not alike, or the file is not to be an mp4; nothing is left
            behind then.
    """
    if Path(path).suffix.lower() != ".mp4":
        raise InvalidInputError("video", "a name that ends in .mp4", os.fspath(path))
    with replaced_path(path, ".mp4") as beside:
        return _stream(beside, frames, rate)


def _stream(path: Path, frames: Iterable[NDArray[np.uint8]], rate: float) -> int:
    remaining = iter(frames)
    first = next(remaining, None)
    if first is None:
        raise InvalidInputError("video", "at least one frame", "none")
    shape = _checked(first, first.shape).shape
    writer = imageio_ffmpeg.write_frames(
        str(path), (shape[1], shape[0]), fps=rate, quality=7, macro_block_size=2, ffmpeg_log_level="error"
    )
    writer.send(None)
    count = 1
    try:
        writer.send(np.ascontiguousarray(first))
        for frame in remaining:
            writer.send(np.ascontiguousarray(_checked(frame, shape)))
            count += 1
    finally:
        writer.close()
    return count


def _checked(frame: NDArray[np.uint8], shape: tuple[int, ...]) -> NDArray[np.uint8]:
    even = frame.ndim == 3 and frame.shape[2] == 3 and frame.shape[0] % 2 == frame.shape[1] % 2 == 0
    if not even or frame.shape != shape or frame.dtype != np.uint8:
        expected = "frames (height, width, 3) of bytes, all alike, sides even"
        raise InvalidInputError("video", expected, f"{frame.dtype} of shape {frame.shape}")
    return frame
