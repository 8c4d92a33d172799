"""What is in a stroke library, for people to read."""

from __future__ import annotations

from collections import Counter

from signimit.strokes import StrokeLibrary


def inventory_table(library: StrokeLibrary) -> str:
    """Return how many strokes there are of each label (rows) by each writer (columns)."""
    counts = Counter(zip(library.labels, library.writers, strict=True))
    labels = sorted(set(library.labels))
    writers = sorted(set(library.writers), key=lambda writer: (len(writer), writer))  # "2" before "13"
    rows = [["label", *writers], *([label, *(str(counts[label, w]) for w in writers)] for label in labels)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(writers) + 1)]
    return "\n".join("  ".join(word.rjust(width) for word, width in zip(row, widths, strict=True)) for row in rows)
