"""Gymnasium wrapper that films episodes, one mp4 file each."""

from __future__ import annotations

import os
from contextlib import ExitStack
from pathlib import Path
from typing import Any, SupportsFloat

import gymnasium as gym
from gymnasium.utils import RecordConstructorArgs

from signimit import InvalidInputError
from signimit_envs.video.mp4 import VideoStream, open_video


class RecordMp4(gym.Wrapper[Any, Any, Any, Any], RecordConstructorArgs):
    """Films an environment whose render mode is ``rgb_array``; needs no moviepy, as Gymnasium's `RecordVideo` does.

    A frame is written at the reset and after every step. A file appears when its episode is over, cut off by the next
    reset, or the wrapper is closed::

        env = RecordMp4(gym.make("signimit/TabletopHand-v0", render_mode="rgb_array"), "videos")
        ...  # reset and step as ever
        env.close()
    """

    def __init__(
        self, env: gym.Env[Any, Any], folder: str | os.PathLike[str], *, every: int = 1, prefix: str = "episode"
    ) -> None:
        """Make the folder.

        Args:
            env: Environment to film.
            folder: Folder of the files ``episode-0000.mp4`` and so on; files of these names are replaced.
            every: Film one in so many episodes, beginning with the first.
            prefix: How the names begin.

        Raises:
            InvalidInputError: If the environment gives no frames, or ``every`` is less than 1.
            OSError: If the folder cannot be made.
        """
        RecordConstructorArgs.__init__(self, folder=os.fspath(folder), every=every, prefix=prefix)
        super().__init__(env)
        if env.render_mode != "rgb_array":
            raise InvalidInputError("render mode to film", "'rgb_array'", repr(env.render_mode))
        if every < 1:
            raise InvalidInputError("every", "at least 1", repr(every))
        self._folder, self._every, self._prefix = Path(folder), every, prefix
        self._folder.mkdir(parents=True, exist_ok=True)
        self._episodes = 0
        self._file = ExitStack()
        self._video: VideoStream | None = None

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Finish the file of the last episode and start an episode; arguments and results are the environment's."""
        self._finish()
        result = self.env.reset(seed=seed, options=options)
        if self._episodes % self._every == 0:
            frame: Any = self.env.render()  # before the file is opened: without OpenGL there is to be none
            path = self._folder / f"{self._prefix}-{self._episodes:04d}.mp4"
            self._video = self._file.enter_context(open_video(path, self.env.metadata["render_fps"]))
            self._video.add(frame)
        self._episodes += 1
        return result

    def step(self, action: Any) -> tuple[Any, SupportsFloat, bool, bool, dict[str, Any]]:
        """Do a control step; arguments and results are the environment's."""
        result = self.env.step(action)
        if self._video is not None:
            frame: Any = self.env.render()
            self._video.add(frame)
            if result[2] or result[3]:
                self._finish()
        return result

    def close(self) -> None:
        """Finish the file and close the environment; may be called again."""
        self._finish()
        super().close()

    def _finish(self) -> None:
        self._video = None
        self._file.close()
