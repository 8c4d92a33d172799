"""Statistics as LeRobot keeps them for each feature, to normalise by."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

_QUANTILES = {"q01": 0.01, "q10": 0.10, "q50": 0.50, "q90": 0.90, "q99": 0.99}
_THIN = 4  # one pixel in so many, each way, is enough for statistics
_LEVELS = 256

Statistics = dict[str, list[Any]]


def column_statistics(values: NDArray[Any]) -> Statistics:
    """Describe a feature, shape (T, w), by numbers of shape (w,)."""
    numbers = values.astype(np.float64)
    described = {
        "min": numbers.min(axis=0),
        "max": numbers.max(axis=0),
        "mean": numbers.mean(axis=0),
        "std": numbers.std(axis=0),
        **{name: np.quantile(numbers, share, axis=0) for name, share in _QUANTILES.items()},
    }
    return {**{name: value.tolist() for name, value in described.items()}, "count": [len(values)]}


def image_statistics(images: NDArray[np.uint8]) -> Statistics:
    """Describe images, shape (T, height, width, 3), by numbers of shape (3, 1, 1), levels from 0 to 1."""
    counter = PixelCounter()
    for _ in counter.watch(images):
        pass
    return counter.statistics()


class PixelCounter:
    """Counts how often each level occurs in each channel of the frames that pass by.

    Attributes:
        frames: How many there were.
    """

    def __init__(self) -> None:
        """Start with none."""
        self._counts = np.zeros((3, _LEVELS), dtype=np.int64)
        self.frames = 0

    def watch(self, frames: Iterable[NDArray[np.uint8]]) -> Iterator[NDArray[np.uint8]]:
        """Pass frames on, shape (height, width, 3), and count."""
        for frame in frames:
            self.frames += 1
            for channel, counts in enumerate(self._counts):
                counts += np.bincount(frame[::_THIN, ::_THIN, channel].ravel(), minlength=_LEVELS)
            yield frame

    def __add__(self, other: PixelCounter) -> PixelCounter:
        """Return the counts of both."""
        both = PixelCounter()
        both._counts, both.frames = self._counts + other._counts, self.frames + other.frames
        return both

    def statistics(self) -> Statistics:
        """Describe each channel by numbers of shape (3, 1, 1), levels from 0 to 1."""
        levels = np.arange(_LEVELS) / (_LEVELS - 1)
        shares = self._counts / self._counts.sum(axis=1, keepdims=True)
        mean = shares @ levels
        described = {
            "min": levels[(self._counts > 0).argmax(axis=1)],
            "max": levels[_LEVELS - 1 - (self._counts[:, ::-1] > 0).argmax(axis=1)],
            "mean": mean,
            "std": np.sqrt(np.maximum(shares @ levels**2 - mean**2, 0.0)),
            **{name: levels[(shares.cumsum(axis=1) >= share).argmax(axis=1)] for name, share in _QUANTILES.items()},
        }
        return {
            **{name: value.reshape(3, 1, 1).tolist() for name, value in described.items()},
            "count": [self.frames],
        }
