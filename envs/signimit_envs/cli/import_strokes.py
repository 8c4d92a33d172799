"""Read strokes that real people drew into one stroke library file, and print what was found."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Literal

from signimit.exceptions import UnknownNameError
from signimit.io.formats import import_strokes, inventory_table, write_inkml
from signimit.strokes import StrokeLibrary
from signimit.teaching.people.relabelling import renamed, selected, with_mirror_images

INCOMPLETE = 3  # exit code: the file is written, but drawings were left out
_WRITERS: dict[str, Callable[[Path, StrokeLibrary], None]] = {
    ".npz": lambda path, library: library.save(path),
    ".inkml": write_inkml,
}


def main(
    paths: tuple[Path, ...],
    /,
    out: Path,
    format: Literal["auto", "unipen", "dollar", "inkml", "library"] = "auto",
    writer: tuple[str, ...] = (),
    label: tuple[str, ...] = (),
    rename: tuple[tuple[str, str], ...] = (),
    mirror: tuple[tuple[str, str], ...] = (),
    strict: bool = False,
) -> None:
    """Read UNIPEN text, $1 recogniser XML, W3C InkML or our own libraries into one library file.

    Small flaws, as of clocks, are repaired. A drawing that cannot be read is left out; then the exit code is 3 instead
    of 0. A table says of how many files and drawings what became, lines below it what was repaired, assumed or left
    out, and why.

    Writers keep the names of their data set: "2" of one need not be "2" of another, so give each data set its own file.

    Args:
        paths: Files and folders to read.
        out: File to write: a library (.npz), or InkML (.inkml).
        format: What the files are, or auto to look into each.
        writer: Keep these writers only.
        label: Keep these labels only, as the files have them.
        rename: Pairs of a label and its new one, e.g. triangle "triangle up".
        mirror: Pairs of a (new) label and that of its upside-down images, which are added.
        strict: Write nothing if a drawing would be left out.
    """
    write = _WRITERS.get(out.suffix.lower())
    if write is None:
        raise UnknownNameError("suffix of --out", out.suffix, _WRITERS)
    library, report = import_strokes(paths, format, strict)
    library = selected(library, label, writer)
    library = with_mirror_images(renamed(library, dict(rename)), dict(mirror))
    write(out, library)
    print(inventory_table(library))
    print(report.table())
    print(f"{len(library)} strokes from {library.source} are in {out}.")
    if report.left_out:
        sys.exit(INCOMPLETE)
