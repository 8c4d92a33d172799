"""Gymnasium wrapper that films episodes, one mp4 file each."""

from __future__ import annotations

import multiprocessing
import os
import re
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any, ClassVar, SupportsFloat

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

    No two films of a run have the same name: where several wrappers film into a folder, numbers go on, and in worker
    processes names have the process's number too, ``episode-4711-0000.mp4``. The films of an earlier run are replaced,
    after a warning, as by `RecordVideo`. Episodes that `gymnasium.wrappers.Autoreset` begins are filmed as others are.
    A file that is being written stays with the original: a copy of the wrapper films from its next episode on.
    """

    _next_numbers: ClassVar[dict[Path, int]] = {}  # by folder and prefix, for all wrappers of this process

    def __init__(
        self, env: gym.Env[Any, Any], folder: str | os.PathLike[str], *, every: int = 1, prefix: str = "episode"
    ) -> None:
        """Make the folder.

        Args:
            env: Environment to film.
            folder: Folder of the files ``episode-0000.mp4`` and so on.
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
        self._start, self._every = Path(folder).resolve() / prefix, every
        self._start.parent.mkdir(parents=True, exist_ok=True)
        name = re.compile(re.escape(prefix) + r"-\d{4,}\.mp4")
        first = self._start not in self._next_numbers and not multiprocessing.parent_process()
        if first and any(name.fullmatch(file.name) for file in self._start.parent.iterdir()):
            keep = "name another folder or prefix to keep them"
            gym.logger.warn(f"The films {self._start}-*.mp4 of an earlier run will be replaced; {keep}.")
        self._next_numbers.setdefault(self._start, 0)
        self._episodes, self._over = 0, False
        self._file = ExitStack()
        self._video: VideoStream | None = None

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Finish the file of the last episode and start an episode; arguments and results are the environment's."""
        self._finish()
        result = self.env.reset(seed=seed, options=options)
        self._begin()
        return result

    def step(self, action: Any) -> tuple[Any, SupportsFloat, bool, bool, dict[str, Any]]:
        """Do a control step; arguments and results are the environment's."""
        begins = self._over and any(isinstance(part, gym.wrappers.Autoreset) for part in _wrappers(self.env))
        result = self.env.step(action)
        if begins:
            self._begin()
        elif self._video is not None:
            frame: Any = self.env.render()
            self._video.add(frame)
        if result[2] or result[3]:
            self._finish()
            self._over = True
        return result

    def close(self) -> None:
        """Finish the file and close the environment; may be called again."""
        self._finish()
        super().close()

    def __getstate__(self) -> dict[str, Any]:
        """Return what a copy needs: not the file that is being written."""
        return {**self.__dict__, "_file": ExitStack(), "_video": None}

    def _begin(self) -> None:
        """Begin the film of an episode, if it is to have one."""
        self._over = False
        if self._episodes % self._every == 0:
            frame: Any = self.env.render()  # before the file is opened: without OpenGL there is to be none
            path = self._new_path()
            self._video = self._file.enter_context(open_video(path, self.env.metadata["render_fps"]))
            self._video.add(frame)
        self._episodes += 1

    def _new_path(self) -> Path:
        """Return a name that no film of this run has: that of the episode, or of the next number that is free."""
        number = max(self._episodes, self._next_numbers.get(self._start, 0))
        self._next_numbers[self._start] = number + 1
        worker = f"-{os.getpid()}" if multiprocessing.parent_process() else ""
        return self._start.with_name(f"{self._start.name}{worker}-{number:04d}.mp4")

    def _finish(self) -> None:
        self._video = None
        self._file.close()


def _wrappers(env: gym.Env[Any, Any]) -> Iterator[gym.Env[Any, Any]]:
    """Go from an environment inwards, through all wrappers."""
    yield env
    while isinstance(env, gym.Wrapper):
        env = env.env
        yield env
