"""Decks: strokes dealt like shuffled cards, so that none comes twice while an unused one is left."""

from __future__ import annotations

from collections import defaultdict

import numpy as np

from signimit.exceptions import UnknownNameError
from signimit.strokes import Stroke, StrokeLibrary


class StrokeSampler:
    """Deals the strokes of a library. Share one deck among all that happens in a session.

    The order is decided by the generators handed to `deal`, nothing else.
    """

    def __init__(self, library: StrokeLibrary) -> None:
        """Put the library's strokes in piles, one for each label and writer."""
        self.library = library
        self._piles: dict[str, dict[str, list[int]]] = defaultdict(lambda: defaultdict(list))
        for i, (label, writer) in enumerate(zip(library.labels, library.writers, strict=True)):
            self._piles[label][writer].append(i)
        self._unused = {label: {w: list(p) for w, p in piles.items()} for label, piles in self._piles.items()}

    def draw(self, label: str, rng: np.random.Generator, count: int = 1) -> tuple[Stroke, ...]:
        """Deal strokes of one label, all by one writer.

        A writer with fewer than ``count`` unused strokes is taken only if all are so; then used strokes come again.

        Raises:
            UnknownNameError: If the library has no stroke with that label.
        """
        if label not in self._unused:
            raise UnknownNameError("label", label, sorted(self._piles))
        unused = self._unused[label]
        left = np.array([len(pile) if len(pile) >= count else 0 for pile in unused.values()], dtype=np.float64)
        if not left.any():
            left = np.array([max(len(pile), 1e-9) for pile in unused.values()])
        writer = list(unused)[rng.choice(len(left), p=left / left.sum())]
        return tuple(self.library[self._take(label, writer, rng)] for _ in range(count))

    def _take(self, label: str, writer: str, rng: np.random.Generator) -> int:
        pile = self._unused[label][writer]
        if not pile:
            pile += self._piles[label][writer]
        return pile.pop(int(rng.integers(len(pile))))


def as_sampler(strokes: StrokeLibrary | StrokeSampler) -> StrokeSampler:
    """Return a deck as it is, and a fresh one for a library."""
    return strokes if isinstance(strokes, StrokeSampler) else StrokeSampler(strokes)
