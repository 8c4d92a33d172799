"""A video is whole or not there."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from pathlib import Path

import imageio_ffmpeg
import numpy as np
import pytest
from numpy.typing import NDArray

import signimit
from signimit_envs.video.mp4 import write_video


def frames(count: int) -> Iterator[NDArray[np.uint8]]:
    for k in range(count):
        yield np.full((48, 64, 3), 10 * k, np.uint8)


def test_a_video_has_its_frames_its_rate_and_its_colours(tmp_path: Path) -> None:
    path = tmp_path / "a.mp4"
    assert write_video(path, frames(20), rate=25) == 20
    decode = [imageio_ffmpeg.get_ffmpeg_exe(), "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    done = subprocess.run(decode, capture_output=True, check=True)
    assert b"64x48" in done.stderr
    assert b"25 fps" in done.stderr
    images = np.frombuffer(done.stdout, np.uint8).reshape(20, 48, 64, 3)
    assert np.abs(images[12].astype(int) - 120).max() < 8


def test_a_video_that_fails_leaves_the_old_one_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "a.mp4"
    write_video(path, frames(3))
    before = path.read_bytes()

    def failing() -> Iterator[NDArray[np.uint8]]:
        yield from frames(2)
        raise RuntimeError("the pen broke")

    with pytest.raises(RuntimeError, match="the pen broke"):
        write_video(path, failing())
    assert path.read_bytes() == before
    assert os.listdir(tmp_path) == ["a.mp4"]


@pytest.mark.parametrize(
    ("images", "message"),
    [
        ([], "video: expected at least one frame, found none"),
        ([np.zeros((4, 4, 3), np.uint8), np.zeros((6, 4, 3), np.uint8)], r"found uint8 of shape \(6, 4, 3\)"),
        ([np.zeros((4, 4, 3))], "found float64 of shape"),
        ([np.zeros((5, 4, 3), np.uint8)], "sides even, found"),
    ],
)
def test_frames_that_make_no_video_are_refused(images: list[NDArray[np.uint8]], message: str, tmp_path: Path) -> None:
    with pytest.raises(signimit.InvalidInputError, match=message):
        write_video(tmp_path / "a.mp4", images)
    assert os.listdir(tmp_path) == []


def test_a_video_is_an_mp4(tmp_path: Path) -> None:
    with pytest.raises(signimit.InvalidInputError, match=r"expected a name that ends in \.mp4, found"):
        write_video(tmp_path / "a.txt", frames(1))
    assert os.listdir(tmp_path) == []
