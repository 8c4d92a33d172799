"""Strokes: what a pen or a hand drew, and libraries of them (paper, section II-A)."""

from __future__ import annotations

import os
import reprlib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Self, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.exceptions import FileFormatError, InvalidInputError, UnknownNameError
from signimit.io.archive import read_archive, write_archive
from signimit.validation import float_array, increasing_times, moving_points, plain_text

KIND, VERSION = "stroke library", 1


@dataclass(frozen=True, eq=False)
class Stroke:
    """One continuous drawing.

    Attributes:
        points: Positions, shape (T, 2), any unit, y up; read-only.
        times: Seconds, shape (T,), strictly increasing; read-only.
    """

    points: NDArray[np.float64]
    times: NDArray[np.float64]

    def __init__(self, points: ArrayLike, times: ArrayLike) -> None:
        """Check and copy.

        Raises:
            InvalidInputError: If the stroke is not finite, too short, at rest or its times stand still.
        """
        object.__setattr__(self, "points", moving_points(points, "stroke points"))
        object.__setattr__(self, "times", increasing_times(times, "stroke times", len(self.points)))

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self.points)

    def __repr__(self) -> str:
        """Say how long it is, e.g. ``Stroke(250 points, 1.99 s)``."""
        return f"Stroke({len(self)} points, {self.times[-1] - self.times[0]:.2f} s)"


@dataclass(frozen=True, eq=False)
class StrokeLibrary(Sequence[Stroke]):
    """Labelled strokes of several writers. For composing sessions and for judging; never shown to a learner.

    Attributes:
        strokes: The strokes.
        labels: What each is, e.g. ``"4"`` or ``"circle"``.
        writers: Who drew each.
        source: Where they come from, in words (``"synthetic"`` if nobody drew them).
    """

    strokes: tuple[Stroke, ...]
    labels: tuple[str, ...]
    writers: tuple[str, ...]
    source: str = ""

    def __init__(
        self, strokes: Iterable[Stroke], labels: Iterable[str], writers: Iterable[str], source: str = ""
    ) -> None:
        """Check that there is one label and one writer, both text that can be printed, for each stroke.

        Raises:
            InvalidInputError: If there is not.
        """
        object.__setattr__(self, "source", plain_text(source, "stroke library: source"))
        given: tuple[tuple[str, Iterable[object], type], ...]
        given = ("strokes", strokes, Stroke), ("labels", labels, str), ("writers", writers, str)
        for name, values, kind in given:
            items = tuple(values)
            for i, item in enumerate(items):
                if not isinstance(item, kind):
                    raise InvalidInputError(f"stroke library: {name}", f"{kind.__name__}s", f"{item!r:.40} at {i}")
                if isinstance(item, str):
                    plain_text(item, f"stroke library: {name}: {i}")
            object.__setattr__(self, name, items)
        if not len(self.strokes) == len(self.labels) == len(self.writers):
            raise InvalidInputError(
                "stroke library",
                "as many labels and writers as strokes",
                f"{len(self.strokes)} strokes, {len(self.labels)} labels, {len(self.writers)} writers",
            )

    @overload
    def __getitem__(self, index: int) -> Stroke: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Stroke, ...]: ...
    def __getitem__(self, index: int | slice) -> Stroke | tuple[Stroke, ...]:
        """Return a stroke by number."""
        return self.strokes[index]

    def __iter__(self) -> Iterator[Stroke]:
        """Go through the strokes."""
        return iter(self.strokes)

    def __len__(self) -> int:
        """Return the number of strokes."""
        return len(self.strokes)

    def __repr__(self) -> str:
        """Say what is in it, e.g. ``StrokeLibrary(340 strokes, 17 labels, 1 writer, source='synthetic')``."""
        sizes = (len(self), "stroke"), (len(set(self.labels)), "label"), (len(set(self.writers)), "writer")
        counts = ", ".join(f"{size} {noun}{'s' * (size != 1)}" for size, noun in sizes)
        return f"StrokeLibrary({counts}, source={reprlib.repr(self.source)})"

    def select(self, label: str | None = None, writer: str | None = None) -> StrokeLibrary:
        """Return the part with one label, one writer, or both.

        Raises:
            UnknownNameError: If the library has no such label or writer at all.
        """
        if label is not None and label not in self.labels:
            raise UnknownNameError("label", label, sorted(set(self.labels)))
        if writer is not None and writer not in self.writers:
            raise UnknownNameError("writer", writer, sorted(set(self.writers)))
        keep = [
            i
            for i, (a, b) in enumerate(zip(self.labels, self.writers, strict=True))
            if label in (None, a) and writer in (None, b)
        ]
        return self._take(keep)

    def _take(self, keep: Iterable[int]) -> StrokeLibrary:
        keep = list(keep)
        return StrokeLibrary(
            tuple(self.strokes[i] for i in keep),
            tuple(self.labels[i] for i in keep),
            tuple(self.writers[i] for i in keep),
            self.source,
        )

    def __add__(self, other: StrokeLibrary) -> StrokeLibrary:
        """Return the strokes of both."""
        source = " + ".join(dict.fromkeys(s for s in (self.source, other.source) if s))
        return StrokeLibrary(
            self.strokes + other.strokes, self.labels + other.labels, self.writers + other.writers, source
        )

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a ``.npz`` file without pickles, whole or not at all."""
        points, times, offsets = flatten([(s.points, s.times) for s in self.strokes])
        arrays = {
            "points": points,
            "times": times,
            "offsets": offsets,
            "labels": np.array(self.labels, dtype=np.str_),
            "writers": np.array(self.writers, dtype=np.str_),
        }
        write_archive(path, KIND, VERSION, arrays, {"source": self.source})

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """Read what `save` wrote.

        Raises:
            FileFormatError: If the file is not a whole, sane stroke library.
        """
        arrays, meta = read_archive(path, KIND, VERSION)
        where = os.fspath(path)
        try:
            offsets = arrays["offsets"]
            points, times = (cut(arrays[name], name, offsets) for name in ("points", "times"))
            labels, writers = (np.atleast_1d(arrays[name]).tolist() for name in ("labels", "writers"))
            strokes = []
            for i, (p, t) in enumerate(zip(points, times, strict=True)):
                try:
                    strokes.append(Stroke(p, t))
                except InvalidInputError as error:
                    raise error.inside(f"stroke {i}") from None
            return cls(tuple(strokes), tuple(labels), tuple(writers), str(meta.get("source", "")))
        except KeyError as error:
            raise FileFormatError(where, f"an array {error}", "none") from None
        except InvalidInputError as error:
            raise FileFormatError(f"{where}: {error.where}", error.expected, error.found) from None


def flatten(
    parts: Sequence[tuple[NDArray[np.float64], NDArray[np.float64]]],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int64]]:
    """Join ragged (points, times) into flat arrays and the offsets that cut them apart again."""
    offsets = np.cumsum([0, *(len(p) for p, _ in parts)]).astype(np.int64)
    points = np.concatenate([p for p, _ in parts]) if parts else np.zeros((0, 2))
    times = np.concatenate([t for _, t in parts]) if parts else np.zeros(0)
    return points, times, offsets


def cut(flat: ArrayLike, where: str, offsets: ArrayLike) -> list[NDArray[np.float64]]:
    """Undo `flatten`: cut points, shape (T, 2), or times, shape (T,), at their offsets.

    Whether the numbers are finite is left to whoever knows what each part is.

    Raises:
        InvalidInputError: If they are not numbers, or the offsets do not cut them.
    """
    array = float_array(flat, where, (None,) if np.ndim(flat) == 1 else (None, 2))
    at = np.asarray(offsets)
    sane = at.ndim == 1 and at.dtype.kind in "iu" and len(at) > 0 and bool((at >= 0).all() and (at <= len(array)).all())
    at = at.astype(np.int64) if sane else at
    if not sane or at[0] != 0 or at[-1] != len(array) or (np.diff(at) < 0).any():
        found = f"{at.ravel()[:8].tolist()}"
        raise InvalidInputError(f"offsets of {where}", f"whole numbers rising from 0 to {len(array)}", found)
    return [array[a:b] for a, b in pairwise(at)]
