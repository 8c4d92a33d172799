"""Recorded episodes: observations, actions, rewards, and the physics state at every control step."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.exceptions import InvalidInputError
from signimit.validation import LARGEST, item_list
from signimit_envs.recording.origin import RecordingOrigin

BOX = "observation"
"""Name of an observation that is one array; those of a `Dict` space keep their own names."""

_STEP_FIELDS = {"actions": None, "rewards": np.float64, "terminations": np.bool_, "truncations": np.bool_}


@dataclass(frozen=True, kw_only=True, eq=False)
class RecordedEpisode:
    """Recorded episode of T control steps; all arrays are read-only.

    Attributes:
        observations: By name, each of shape (T + 1, ...): at the start and after every step.
        actions: Actions as the environment was given them, shape (T, ...).
        rewards: Rewards of the steps, shape (T,).
        terminations: Whether the step ended the episode because the physics blew up, shape (T,).
        truncations: Whether the step ended the episode because its time was over, shape (T,).
        infos: The entries of `info` that are numbers at every step, each of shape (T + 1, ...).
        states: Physics states, `mujoco.mj_getState` with `STATE_SPEC`, shape (T + 1, S).
        controls: Commands of the joints' drives in each step, shape (T, nu), rad/s.
        seed: Seed of the environment's reset; None if it had none.
    """

    observations: dict[str, NDArray[Any]]
    actions: NDArray[Any]
    rewards: NDArray[np.float64]
    terminations: NDArray[np.bool_]
    truncations: NDArray[np.bool_]
    infos: dict[str, NDArray[Any]]
    states: NDArray[np.float64]
    controls: NDArray[np.float64]
    seed: int | None = None

    def __post_init__(self) -> None:
        """Copy and check the arrays, and make them read-only.

        Raises:
            InvalidInputError: If a field has another type or length, or, unless an info, non-finite numbers.
        """
        steps = len(np.atleast_1d(self.rewards))
        if not steps:
            raise InvalidInputError("episode", "at least one step", "none")
        if self.seed is not None and (not isinstance(self.seed, int) or self.seed < 0):
            raise InvalidInputError("seed", "a whole number, 0 or more, or none", f"{self.seed!r:.40}")
        for name, dtype in _STEP_FIELDS.items():
            rows_of_step = _rows(getattr(self, name), name, steps, dtype)
            if dtype is not None and rows_of_step.ndim != 1:
                raise InvalidInputError(name, f"shape ({steps},)", f"shape {rows_of_step.shape}")
            object.__setattr__(self, name, rows_of_step)
        for name, rows in (("states", steps + 1), ("controls", steps)):
            numbers = _rows(getattr(self, name), name, rows, np.float64)
            if numbers.ndim != 2:
                raise InvalidInputError(name, f"shape ({rows}, n)", f"shape {numbers.shape}")
            object.__setattr__(self, name, numbers)
        for group in ("observations", "infos"):
            arrays = getattr(self, group)
            rows_of = {name: _rows(arrays[name], f"{group}: {name}", steps + 1) for name in sorted(arrays)}
            object.__setattr__(self, group, rows_of)

    def __len__(self) -> int:
        """Return the number of control steps T."""
        return len(self.rewards)

    def __repr__(self) -> str:
        """Return its size as text, e.g. ``RecordedEpisode(600 steps, reward 1)``."""
        return f"RecordedEpisode({len(self)} steps, reward {self.rewards.sum():g})"


@dataclass(frozen=True, eq=False)
class Recording(Sequence[RecordedEpisode]):
    """Sequence of recorded episodes of one environment.

    Attributes:
        origin: Description of the environment and its model.
        episodes: The episodes, in order.
    """

    origin: RecordingOrigin
    episodes: tuple[RecordedEpisode, ...]

    def __init__(self, origin: RecordingOrigin, episodes: Iterable[RecordedEpisode]) -> None:
        """Check that all episodes have the same fields, types and shapes of rows.

        Raises:
            InvalidInputError: If there are no episodes, or one has other fields or shapes than the first.
        """
        object.__setattr__(self, "origin", origin)
        object.__setattr__(self, "episodes", tuple(item_list(episodes, "recording")))
        first = row_shapes(self.episodes[0])
        for number, episode in enumerate(self.episodes):
            shapes = row_shapes(episode)
            for name in sorted(first.keys() | shapes.keys()):
                want, have = first.get(name), shapes.get(name)
                if want != have:
                    raise InvalidInputError(
                        f"episode {number}: {name}", f"{_row_text(want)} as in episode 0", _row_text(have)
                    )

    @overload
    def __getitem__(self, index: int) -> RecordedEpisode: ...
    @overload
    def __getitem__(self, index: slice) -> Recording: ...
    def __getitem__(self, index: int | slice) -> RecordedEpisode | Recording:
        """Return one episode, or a shorter recording."""
        if isinstance(index, slice):
            return Recording(self.origin, self.episodes[index])
        return self.episodes[index]

    def __iter__(self) -> Iterator[RecordedEpisode]:
        """Go through the episodes."""
        return iter(self.episodes)

    def __len__(self) -> int:
        """Return the number of episodes."""
        return len(self.episodes)

    def __repr__(self) -> str:
        """Return its sizes as text, e.g. ``Recording(9 episodes, 4500 steps)``."""
        return f"Recording({len(self)} episode{'s' * (len(self) != 1)}, {sum(map(len, self))} steps)"


def episode_arrays(episode: RecordedEpisode) -> dict[str, NDArray[Any]]:
    """Return the arrays of an episode by flat names, ``observations.hand``, ``actions`` and so on."""
    return {
        **{f"observations.{name}": array for name, array in episode.observations.items()},
        **{f"infos.{name}": array for name, array in episode.infos.items()},
        **{name: getattr(episode, name) for name in (*_STEP_FIELDS, "states", "controls")},
    }


def episode_from_arrays(arrays: Mapping[str, NDArray[Any]], seed: int | None) -> RecordedEpisode:
    """Make an episode from its arrays, by the names of `episode_arrays`.

    Raises:
        InvalidInputError: If a field is missing or unknown, or has another length than the rest.
    """
    groups: dict[str, dict[str, NDArray[Any]]] = {"observations": {}, "infos": {}}
    single = {}
    for name, array in arrays.items():
        group, dot, rest = name.partition(".")
        if dot and group in groups:
            groups[group][rest] = array
        elif name in (*_STEP_FIELDS, "states", "controls"):
            single[name] = array
        else:
            raise InvalidInputError("episode", "the fields of an episode", f"{name!r}")
    for name in (*_STEP_FIELDS, "states", "controls"):
        if name not in single:
            raise InvalidInputError("episode", f"an array {name!r}", "none")
    return RecordedEpisode(observations=groups["observations"], infos=groups["infos"], seed=seed, **single)


def row_shapes(episode: RecordedEpisode) -> dict[str, tuple[str, tuple[int, ...]]]:
    """Return the type and the shape of a row of each of an episode's arrays, by `episode_arrays`' names."""
    return {name: (array.dtype.str, array.shape[1:]) for name, array in episode_arrays(episode).items()}


def _row_text(row: tuple[str, tuple[int, ...]] | None) -> str:
    """Return a row's type and shape as text."""
    return "none" if row is None else f"rows of {np.dtype(row[0]).name} of shape {row[1]}"


def _rows(value: ArrayLike, where: str, rows: int, dtype: type[np.generic] | None = None) -> NDArray[Any]:
    """Copy numbers with one row a step into a read-only array."""
    raw = np.asarray(value)
    if raw.dtype.kind not in "biuf" or raw.ndim < 1 or len(raw) != rows:
        raise InvalidInputError(where, f"numbers for {rows} steps", f"{raw.dtype} of shape {raw.shape}")
    with np.errstate(over="ignore", invalid="ignore"):  # longer floats than the field's become infinite
        array = np.array(raw, dtype=dtype, order="C")
    if not where.startswith("infos") and array.dtype.kind == "f":
        bad = np.argwhere(
            ~(np.abs(array) <= min(LARGEST, float(np.finfo(array.dtype).max)))
        )  # comparisons with NaN are false
        if len(bad):
            raise InvalidInputError(where, "finite numbers", f"others at step {bad[0][0]}")
    array.setflags(write=False)
    return array
