"""Changes to stroke libraries: choosing, renaming and mirroring strokes, adding noise to them."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np

from signimit.exceptions import UnknownNameError
from signimit.strokes import Stroke, StrokeLibrary


def selected(library: StrokeLibrary, labels: Collection[str] = (), writers: Collection[str] = ()) -> StrokeLibrary:
    """Return the strokes with one of these labels by one of these writers, in the library's order; empty means all.

    Raises:
        UnknownNameError: If the library lacks one of them.
    """
    for name, wanted, known in (("label", labels, library.labels), ("writer", writers, library.writers)):
        _check_names(name, wanted, known)
    rows = zip(library.strokes, library.labels, library.writers, strict=True)
    kept = [row for row in rows if (not labels or row[1] in labels) and (not writers or row[2] in writers)]
    return StrokeLibrary(
        tuple(stroke for stroke, _, _ in kept),
        tuple(label for _, label, _ in kept),
        tuple(writer for _, _, writer in kept),
        library.source,
    )


def renamed(library: StrokeLibrary, names: Mapping[str, str]) -> StrokeLibrary:
    """Return the library with some labels replaced.

    Raises:
        UnknownNameError: If the library lacks a label.
    """
    _check_names("label", names, library.labels)
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
    _check_names("label", names, library.labels)
    chosen = [i for i, label in enumerate(library.labels) if label in names]
    flip = np.array([1.0, -1.0])
    images = StrokeLibrary(
        tuple(Stroke(library[i].points * flip, library[i].times) for i in chosen),
        tuple(names[library.labels[i]] for i in chosen),
        tuple(library.writers[i] for i in chosen),
        library.source,
    )
    return library + images


def with_both_triangles(library: StrokeLibrary) -> StrokeLibrary:
    """Call apex-up "triangle" "triangle up", and mirror it where there is no "triangle down"."""
    if "triangle" in library.labels and "triangle up" not in library.labels:
        library = renamed(library, {"triangle": "triangle up"})
    if "triangle up" in library.labels and "triangle down" not in library.labels:
        library = with_mirror_images(library, {"triangle up": "triangle down"})
    return library


def with_waver(library: StrokeLibrary, rng: np.random.Generator, noise: float) -> StrokeLibrary:
    """Add a slow random waver to every stroke, another one each time: three waves in each direction.

    Args:
        library: The strokes.
        rng: Decides the waves.
        noise: Root mean square of the waver, in half sizes of a stroke.
    """
    strokes = []
    for stroke in library.strokes:
        half = np.ptp(stroke.points, axis=0).max() / 2
        share = np.linspace(0, 1, len(stroke.points))[:, None, None]
        waves = np.sin(2 * np.pi * (rng.uniform(0.5, 4, (3, 2)) * share + rng.random((3, 2)))).sum(axis=1)
        strokes.append(Stroke(stroke.points + noise * half * waves * np.sqrt(2 / 3), stroke.times))
    return StrokeLibrary(tuple(strokes), library.labels, library.writers, library.source)


def _check_names(what: str, names: Collection[str], known: Collection[str]) -> None:
    for name in names:
        if name not in known:
            raise UnknownNameError(what, name, sorted(set(known)))
