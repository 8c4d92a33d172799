"""Stroke files of any known format, one or a folder of them: read into one library, and listed."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from types import MappingProxyType

from signimit.exceptions import FileFormatError, UnknownNameError
from signimit.io.archive import read_archive
from signimit.io.formats.dollar import read_dollar
from signimit.io.formats.inkml import read_inkml
from signimit.io.formats.unipen import read_unipen
from signimit.strokes import KIND, VERSION, StrokeLibrary

AUTO = "auto"
READERS: Mapping[str, Callable[[str | os.PathLike[str]], StrokeLibrary]] = MappingProxyType(
    {"unipen": read_unipen, "dollar": read_dollar, "inkml": read_inkml, "library": StrokeLibrary.load}
)
_MARKS = ((b"<Gesture", "dollar"), (b"<ink", "inkml"), (b":ink", "inkml"), (b".SEGMENT", "unipen"))
_HEAD = 4096  # bytes looked at to tell what a file is


def read_strokes(paths: Iterable[str | os.PathLike[str]], format: str = AUTO) -> StrokeLibrary:
    """Read files, and all files in folders, into one library.

    Args:
        paths: Files and folders. In folders, files of other kinds and hidden ones are passed over, and the order is
            alphabetical.
        format: ``"unipen"``, ``"dollar"``, ``"inkml"``, ``"library"`` (our own), or ``"auto"`` to look into each file.

    Raises:
        FileNotFoundError: If a path does not exist.
        FileFormatError: If a file is broken, a named file is of no known kind, or there are no strokes.
        UnknownNameError: If there is no such format.
    """
    if format not in (AUTO, *READERS):
        raise UnknownNameError("stroke format", format, (AUTO, *READERS))
    named = [Path(path) for path in paths]
    parts = [READERS[kind](file) for path in named for file, kind in _files(path, format)]
    if not any(parts):
        raise FileFormatError(", ".join(map(str, named)) or "no path", "files with strokes", "none")
    return StrokeLibrary(
        tuple(stroke for part in parts for stroke in part),
        tuple(label for part in parts for label in part.labels),
        tuple(writer for part in parts for writer in part.writers),
        " + ".join(dict.fromkeys(part.source for part in parts)),
    )


def detect_format(path: str | os.PathLike[str]) -> str | None:
    """Tell from a file's first bytes which reader understands it; none if none does."""
    with open(path, "rb") as file:
        head = file.read(_HEAD)
    if head.startswith(b"PK"):
        return "library" if is_library(path) else None
    places = [(head.find(mark), kind) for mark, kind in _MARKS if mark in head]
    return min(places)[1] if places else None


def is_library(path: str | os.PathLike[str]) -> bool:
    """Tell whether a file is one of our own stroke libraries."""
    try:
        read_archive(path, KIND, VERSION)
    except FileFormatError:
        return False
    return True


def inventory_table(library: StrokeLibrary) -> str:
    """Return how many strokes there are of each label (rows) by each writer (columns)."""
    counts = Counter(zip(library.labels, library.writers, strict=True))
    labels = sorted(set(library.labels))
    writers = sorted(set(library.writers), key=lambda writer: (len(writer), writer))  # "2" before "13"
    rows = [["label", *writers], *([label, *(str(counts[label, w]) for w in writers)] for label in labels)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(writers) + 1)]
    return "\n".join("  ".join(word.rjust(width) for word, width in zip(row, widths, strict=True)) for row in rows)


def _files(path: Path, format: str) -> list[tuple[Path, str]]:
    """Return the files of a path and the reader for each."""
    if path.is_dir():
        inside = (p for p in sorted(path.rglob("*")) if p.is_file() and not p.name.startswith("."))
        kinds = ((p, detect_format(p)) for p in inside)
        return [(p, kind) for p, kind in kinds if kind is not None and format in (AUTO, kind)]
    kind = detect_format(path) if format == AUTO else format
    if kind is None:
        raise FileFormatError(str(path), f"strokes as {', '.join(READERS)}", "something else")
    return [(path, kind)]
