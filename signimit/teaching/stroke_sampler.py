"""Random strokes of a label, out of a library."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Mapping
from typing import Protocol

import numpy as np

from signimit.exceptions import UnknownNameError
from signimit.strokes import Stroke, StrokeLibrary


class StrokeSource(Protocol):
    """Makes strokes by label: a sampler of a library, or a synthetic `signimit.teaching.people.Person`."""

    def draw(self, label: str, rng: np.random.Generator) -> Stroke:
        """Make a stroke; ``rng`` decides which."""
        ...

    def draw_several(self, label: str, rng: np.random.Generator, count: int) -> tuple[Stroke, ...]:
        """Make so many strokes, all by one writer."""
        ...


class StrokeSampler:
    """Draws strokes of a library without replacement: none comes twice while an unused one is left.

    Share one sampler among all that happens in a session. The order is decided by the generators handed to `draw`,
    nothing else.
    """

    def __init__(self, library: StrokeLibrary) -> None:
        """Note which strokes there are of each label and writer."""
        self.library = library
        self._all: dict[str, dict[str, list[int]]] = defaultdict(lambda: defaultdict(list))
        for i, (label, writer) in enumerate(zip(library.labels, library.writers, strict=True)):
            self._all[label][writer].append(i)
        self._unused = {label: {w: list(numbers) for w, numbers in by.items()} for label, by in self._all.items()}

    def draw(self, label: str, rng: np.random.Generator) -> Stroke:
        """Draw a stroke of a label.

        Raises:
            UnknownNameError: If the library has no stroke with that label.
        """
        return self.draw_several(label, rng, 1)[0]

    def draw_several(self, label: str, rng: np.random.Generator, count: int) -> tuple[Stroke, ...]:
        """Draw strokes of a label, all by one writer.

        A writer with fewer than ``count`` unused strokes is taken only if all are so; then used strokes come again.

        Raises:
            UnknownNameError: If the library has no stroke with that label.
        """
        if label not in self._unused:
            raise UnknownNameError("label", label, sorted(self._all))
        unused = self._unused[label]
        left = np.array([len(numbers) if len(numbers) >= count else 0 for numbers in unused.values()], dtype=np.float64)
        if not left.any():
            left = np.array([max(len(numbers), 1e-9) for numbers in unused.values()])
        writer = list(unused)[rng.choice(len(left), p=left / left.sum())]
        drawn = []
        for _ in range(count):
            if not unused[writer]:
                unused[writer] += self._all[label][writer]
            drawn.append(self.library[unused[writer].pop(int(rng.integers(len(unused[writer]))))])
        return tuple(drawn)


class ReplacingSampler:
    """Draws strokes of a library with replacement.

    It remembers nothing, so that the generator alone decides a stroke, whatever was drawn before.
    """

    def __init__(self, library: StrokeLibrary) -> None:
        """Keep the strokes by label."""
        self._strokes: dict[str, list[Stroke]] = defaultdict(list)
        for label, stroke in zip(library.labels, library, strict=True):
            self._strokes[label].append(stroke)

    def draw(self, label: str, rng: np.random.Generator) -> Stroke:
        """Draw a stroke of a label.

        Raises:
            UnknownNameError: If the library has no stroke with that label.
        """
        if label not in self._strokes:
            raise UnknownNameError("label", label, sorted(self._strokes))
        return self._strokes[label][int(rng.integers(len(self._strokes[label])))]

    def draw_several(self, label: str, rng: np.random.Generator, count: int) -> tuple[Stroke, ...]:
        """Draw so many strokes of a label, by any writers."""
        return tuple(self.draw(label, rng) for _ in range(count))


class SynonymSource:
    """Draws some labels in two ways, in turn: what people do who have two signs for one thing."""

    def __init__(self, strokes: StrokeSource, synonyms: Mapping[str, str]) -> None:
        """Take strokes from a source; ``synonyms`` has the label of the second way by label."""
        self._strokes, self._synonyms, self._drawn = strokes, synonyms, Counter[str]()

    def draw(self, label: str, rng: np.random.Generator) -> Stroke:
        """Draw a stroke of a label, or of its synonym."""
        return self.draw_several(label, rng, 1)[0]

    def draw_several(self, label: str, rng: np.random.Generator, count: int) -> tuple[Stroke, ...]:
        """Draw strokes of a label, or of its synonym, all in one way and by one writer."""
        self._drawn[label] += 1
        second = self._synonyms.get(label, label) if self._drawn[label] % 2 == 0 else label
        return self._strokes.draw_several(second, rng, count)


def as_source(strokes: StrokeLibrary | StrokeSource) -> StrokeSource:
    """Return a `StrokeSampler` of a library, and any other source as it is."""
    return StrokeSampler(strokes) if isinstance(strokes, StrokeLibrary) else strokes
