"""Stroke files of any known format, one or a folder of them: read into one library, reported on, and listed."""

from __future__ import annotations

import errno
import os
import warnings
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

from signimit.exceptions import FileFormatError, UnknownNameError
from signimit.io.formats.detection import detect_format
from signimit.io.formats.dollar import parse_dollar, read_dollar
from signimit.io.formats.import_report import NOT_A_DRAWING, FileReport, ImportReport, StrokeImportWarning
from signimit.io.formats.inkml import parse_inkml, read_inkml
from signimit.io.formats.pen_recording import import_pen_file
from signimit.io.formats.textfile import read_any_text
from signimit.io.formats.unipen import parse_unipen, read_unipen
from signimit.io.formats.xmlfile import read_xml
from signimit.strokes import StrokeLibrary

AUTO = "auto"
READERS: Mapping[str, Callable[[str | os.PathLike[str]], StrokeLibrary]] = MappingProxyType(
    {"unipen": read_unipen, "dollar": read_dollar, "inkml": read_inkml, "library": StrokeLibrary.load}
)
StrokePaths = str | os.PathLike[str] | Iterable[str | os.PathLike[str]]
_MOST_SOURCES = 5  # that a library names


class StrokeImport(NamedTuple):
    """Strokes that were read, and what became of each file."""

    library: StrokeLibrary
    report: ImportReport


def read_strokes(paths: StrokePaths, format: str = AUTO, strict: bool = False) -> StrokeLibrary:
    """Read files, and all files in folders, into one library.

    A drawing that cannot be read is left out. If one was, or was repaired, there is one `StrokeImportWarning`;
    `import_strokes` says which.

    Args:
        paths: A file or folder, or several. In folders, files of other kinds and hidden ones are passed over, and the
            order is alphabetical.
        format: ``"unipen"``, ``"dollar"``, ``"inkml"``, ``"library"`` (our own), or ``"auto"`` to look into each file.
        strict: Raise the error of the first drawing that would be left out.

    Raises:
        FileNotFoundError: If a path does not exist.
        FileFormatError: If there are no strokes; with ``strict``, also if a drawing or file would be left out.
        UnknownNameError: If there is no such format.
    """
    library, report = import_strokes(paths, format, strict)
    if not report.flawless:
        warnings.warn(report.summary(), StrokeImportWarning, stacklevel=2)
    return library


def import_strokes(paths: StrokePaths, format: str = AUTO, strict: bool = False) -> StrokeImport:
    """Read files, and all files in folders, as `read_strokes` does, and report what became of each file.

    Raises:
        FileNotFoundError: If a path does not exist.
        FileFormatError: If there are no strokes; with ``strict``, also if a drawing or file would be left out.
        UnknownNameError: If there is no such format.
    """
    if format not in (AUTO, *READERS):
        raise UnknownNameError("stroke format", format, (AUTO, *READERS))
    named = [Path(path) for path in ([paths] if isinstance(paths, (str, os.PathLike)) else paths)]
    for path in named:
        if not path.exists():
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(path))
    parts = _without_included([part for path in named for part in _import_path(path, format)])
    report = ImportReport(tuple(part.report for part in parts))
    libraries = [part.library for part in parts if len(part.library)]
    if report.left_out and (strict or (not libraries and len(report.left_out) == 1)):
        raise report.left_out[0]
    if not libraries:
        found = f"none ({report.summary().removesuffix('.')})" if report.left_out else "none"
        raise FileFormatError(", ".join(map(str, named)) or "no path", "files with strokes", found)
    sources = list(dict.fromkeys(library.source for library in libraries))
    if len(sources) > _MOST_SOURCES:
        sources[_MOST_SOURCES:] = [f"{len(sources) - _MOST_SOURCES} more"]
    library = StrokeLibrary(
        tuple(stroke for library in libraries for stroke in library),
        tuple(label for library in libraries for label in library.labels),
        tuple(writer for library in libraries for writer in library.writers),
        " + ".join(sources),
    )
    return StrokeImport(library, report)


def inventory_table(library: StrokeLibrary) -> str:
    """Return how many strokes there are of each label (rows) by each writer (columns)."""
    counts = Counter(zip(library.labels, library.writers, strict=True))
    labels = sorted(set(library.labels))
    writers = sorted(set(library.writers), key=lambda writer: (len(writer), writer))  # "2" before "13"
    rows = [["label", *writers], *([label, *(str(counts[label, w]) for w in writers)] for label in labels)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(writers) + 1)]
    return "\n".join("  ".join(word.rjust(width) for word, width in zip(row, widths, strict=True)) for row in rows)


class _Part(NamedTuple):
    """What one file gives."""

    library: StrokeLibrary
    report: FileReport


def _passed_over(path: Path, why: str) -> _Part:
    return _Part(StrokeLibrary((), (), ()), FileReport(path, None, passed_over=why))


def _left_out(path: Path, format: str | None, error: FileFormatError) -> _Part:
    return _Part(StrokeLibrary((), (), ()), FileReport(path, format, left_out=(error,)))


def _import_path(path: Path, format: str) -> Iterator[_Part]:
    """Read a file, or all files of a folder."""
    if not path.is_dir():
        kind = detect_format(path) if format == AUTO else format
        known = f"strokes as {', '.join(READERS)}"
        yield (
            _import_file(path, kind)
            if kind
            else _left_out(path, None, FileFormatError(str(path), known, "something else"))
        )
        return
    for file in sorted(p for p in path.rglob("*") if not p.is_dir()):
        if any(part.startswith(".") for part in file.relative_to(path).parts):
            yield _passed_over(file, "hidden")
        elif file.exists() and not file.is_file():  # a device, a pipe
            yield _passed_over(file, NOT_A_DRAWING)
        else:
            yield _import_member(file, format)


def _import_member(path: Path, format: str) -> _Part:
    """Read a file of a folder, if it is of a format that is asked for."""
    try:
        kind = detect_format(path)
        if kind is None:
            return _passed_over(path, NOT_A_DRAWING if path.stat().st_size else "empty")
        return _import_file(path, kind) if format in (AUTO, kind) else _passed_over(path, f"{kind}, not asked for")
    except OSError as error:
        reason = FileFormatError(str(path), "a file that can be read", error.strerror or str(error))
        return _left_out(path, None, reason)
    except FileFormatError as error:
        return _left_out(path, None, error)


def _import_file(path: Path, kind: str) -> _Part:
    """Read a file of a known format; if nothing in it can be read, that is what is reported."""
    try:
        if kind == "library":
            library = StrokeLibrary.load(path)
            return _Part(library, FileReport(path, kind, len(library)))
        if kind == "unipen":
            text, findings = read_any_text(path)
            pen_file, left_out = parse_unipen(text, path), tuple[FileFormatError, ...]()
        else:
            root, findings, left_out = read_xml(path)
            pen_file = parse_dollar(root, path) if kind == "dollar" else parse_inkml(root, path)
        return _Part(*import_pen_file(path, kind, pen_file, findings, left_out))
    except FileFormatError as error:
        return _left_out(path, kind, error)


def _without_included(parts: Sequence[_Part]) -> list[_Part]:
    """Pass over the files that were read for another one."""
    owners = {other.resolve(): part.report.path for part in parts for other in part.report.includes}
    owned = [owners.get(part.report.path.resolve()) for part in parts]
    return [
        part if owner in (None, part.report.path) else _passed_over(part.report.path, "read with another")
        for part, owner in zip(parts, owned, strict=True)
    ]
