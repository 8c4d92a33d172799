"""Making the labels of a public data set those of a language, and mirror images of its drawings."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from signimit.exceptions import UnknownNameError
from signimit.strokes import Stroke, StrokeLibrary


def renamed(library: StrokeLibrary, names: Mapping[str, str]) -> StrokeLibrary:
    """Return the library with some labels replaced.

    Raises:
        UnknownNameError: If the library lacks a label.
    """
    _check_labels(library, names)
    labels = tuple(names.get(label, label) for label in library.labels)
    return StrokeLibrary(library.strokes, labels, library.writers, library.source)


def with_mirror_images(library: StrokeLibrary, names: Mapping[str, str]) -> StrokeLibrary:
    """Return the library and, for each label named, its strokes upside down under the new label.

    Args:
        library: Strokes.
        names: New label of the mirror images by label, e.g. ``{"triangle up": "triangle down"}``.

    Raises:
        UnknownNameError: If the library lacks a label.
    """
    _check_labels(library, names)
    chosen = [i for i, label in enumerate(library.labels) if label in names]
    flip = np.array([1.0, -1.0])
    images = StrokeLibrary(
        tuple(Stroke(library[i].points * flip, library[i].times) for i in chosen),
        tuple(names[library.labels[i]] for i in chosen),
        tuple(library.writers[i] for i in chosen),
        library.source,
    )
    return library + images


def _check_labels(library: StrokeLibrary, names: Mapping[str, str]) -> None:
    for label in names:
        if label not in library.labels:
            raise UnknownNameError("label", label, sorted(set(library.labels)))
