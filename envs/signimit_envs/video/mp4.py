"""Video files (mp4, H.264), written frame by frame; a file appears under its name only when it is whole."""

from __future__ import annotations

import functools
import os
import subprocess
from collections.abc import Generator, Iterable, Iterator
from contextlib import closing, contextmanager
from pathlib import Path

import imageio_ffmpeg
import numpy as np
from numpy.typing import NDArray

from signimit import InvalidInputError
from signimit.exceptions import install_command
from signimit.io.safe_files import replaced_path
from signimit_envs.arm.scene import CONTROL_RATE
from signimit_envs.exceptions import RenderingError

_FFMPEG_VARIABLE = "IMAGEIO_FFMPEG_EXE"  # imageio-ffmpeg takes the program that it names, whatever that is


@functools.cache
def ffmpeg_version() -> str:
    """Return the version of the ffmpeg that encodes videos.

    Raises:
        RenderingError: If there is none, or it does not run.
    """
    try:
        version = str(imageio_ffmpeg.get_ffmpeg_version())
        if not version:
            raise RuntimeError("it does not say its version")
        return version
    except (OSError, RuntimeError, subprocess.SubprocessError, IndexError) as error:  # the last: it is another program
        chosen = os.environ.get(_FFMPEG_VARIABLE)
        if chosen:
            remedy = f"{_FFMPEG_VARIABLE}={chosen} is no ffmpeg: unset {_FFMPEG_VARIABLE}"
        else:
            remedy = f"Type: {install_command('imageio[ffmpeg]')}"
        raise RenderingError(f"ffmpeg does not run ({str(error).partition(chr(10))[0]})", remedy) from error


def write_video(path: str | os.PathLike[str], frames: Iterable[NDArray[np.uint8]], rate: float = CONTROL_RATE) -> int:
    """Write frames to an mp4 file (H.264) that appears under its name when the last one is in.

    Args:
        path: The file; an existing one is replaced.
        frames: Each of shape (height, width, 3), all alike, sides even.
        rate: Frames per second.

    Returns:
        The number of frames.

    Raises:
        InvalidInputError: If there are no frames, they are not alike, or the file is not to be an mp4; nothing is left
            behind then.
        RenderingError: If there is no ffmpeg.
    """
    with open_video(path, rate) as video:
        for frame in frames:
            video.add(frame)
    return video.count


@contextmanager
def open_video(path: str | os.PathLike[str], rate: float = CONTROL_RATE) -> Iterator[VideoStream]:
    """Open an mp4 file (H.264) for frames that come one by one; it appears under its name when the block is left.

    Args:
        path: The file; an existing one is replaced.
        rate: Frames per second.

    Yields:
        The stream that takes the frames.

    Raises:
        InvalidInputError: If no frame came, or the file is not to be an mp4; nothing is left behind then.
    """
    if Path(path).suffix.lower() != ".mp4":
        raise InvalidInputError("video", "a name that ends in .mp4", os.fspath(path))
    with replaced_path(path, ".mp4") as beside:
        with closing(VideoStream(beside, rate)) as stream:
            yield stream
        if not stream.count:
            raise InvalidInputError("video", "at least one frame", "none")


class VideoStream:
    """Encoder of a video file; frames are added one by one.

    Attributes:
        count: Number of frames so far.
    """

    def __init__(self, path: Path, rate: float) -> None:
        """Encode into a file, ``rate`` frames per second; the first frame decides the size."""
        self._path, self._rate, self.count = path, rate, 0
        self._shape: tuple[int, ...] = ()
        self._writer: Generator[None, NDArray[np.uint8] | None, None] | None = None

    def add(self, frame: NDArray[np.uint8]) -> None:
        """Encode the next frame, shape (height, width, 3), uint8.

        Raises:
            InvalidInputError: If it has another shape or type, odd sides, or another size than the first.
            RenderingError: If there is no ffmpeg.
        """
        even = frame.ndim == 3 and frame.shape[2] == 3 and frame.shape[0] % 2 == frame.shape[1] % 2 == 0
        if not even or frame.shape != (self._shape or frame.shape) or frame.dtype != np.uint8:
            expected = "frames (height, width, 3) of bytes, all alike, sides even"
            raise InvalidInputError("video", expected, f"{frame.dtype} of shape {frame.shape}")
        if self._writer is None:
            ffmpeg_version()  # or an error of the library's would come through
            self._shape, size = frame.shape, (frame.shape[1], frame.shape[0])
            self._writer = imageio_ffmpeg.write_frames(
                str(self._path), size, fps=self._rate, quality=7, macro_block_size=2, ffmpeg_log_level="error"
            )
            self._writer.send(None)  # starts ffmpeg
        self._writer.send(np.ascontiguousarray(frame))
        self.count += 1

    def close(self) -> None:
        """Finish the file; may be called again."""
        if self._writer is not None:
            self._writer.close()
            self._writer = None
