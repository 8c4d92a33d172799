#!/usr/bin/env python3
"""Read strokes that real people drew into one stroke library file, and print what was found."""

from __future__ import annotations

import sys
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from signimit import SignimitError, StrokeLibrary
from signimit.formats import read_strokes, write_inkml
from signimit.relabelling import renamed, with_mirror_images


@dataclass(frozen=True)
class Arguments:
    """Read UNIPEN text, $1 recogniser XML, W3C InkML or our own libraries into one library file.

    The labels `reproduce.py --movements` wants come out of the $1 logs by
    `--rename triangle "triangle up" --mirror "triangle up" "triangle down"`.
    """

    paths: Annotated[tuple[Path, ...], tyro.conf.Positional]
    """Files and folders to read."""
    out: Path
    """File to write: a library (.npz), or InkML if it ends in .inkml."""
    format: str = "auto"
    """unipen, dollar, inkml, library, or auto to look into each file."""
    writer: tuple[str, ...] = ()
    """Keep these writers only."""
    label: tuple[str, ...] = ()
    """Keep these labels only (the old ones, before --rename)."""
    rename: dict[str, str] = field(default_factory=dict)
    """Pairs of an old label and its new one."""
    mirror: dict[str, str] = field(default_factory=dict)
    """Pairs of a label and the label of its upside-down images, which are added."""


def main(arguments: Arguments) -> int:
    """Import, write, print the table; return the exit status."""
    try:
        library = read_strokes(arguments.paths, arguments.format)
        library = kept(library, arguments)
        library = with_mirror_images(renamed(library, arguments.rename), arguments.mirror)
        if arguments.out.suffix == ".inkml":
            write_inkml(arguments.out, library)
        else:
            library.save(arguments.out)
    except (SignimitError, OSError) as error:
        print(f"import_strokes: {error}", file=sys.stderr)
        return 1
    print(table(library))
    print(f"{len(library)} strokes from {library.source} written to {arguments.out}")
    return 0


def kept(library: StrokeLibrary, arguments: Arguments) -> StrokeLibrary:
    """Return the writers and labels that were asked for."""
    if arguments.writer:
        library = joined([library.select(writer=writer) for writer in arguments.writer])
    if arguments.label:
        library = joined([library.select(label=label) for label in arguments.label])
    return library


def joined(parts: list[StrokeLibrary]) -> StrokeLibrary:
    """Return all parts as one library."""
    whole = parts[0]
    for part in parts[1:]:
        whole = whole + part
    return whole


def table(library: StrokeLibrary) -> str:
    """Return how many strokes there are of each label (rows) by each writer (columns)."""
    counts = Counter(zip(library.labels, library.writers, strict=True))
    labels, writers = sorted(set(library.labels)), sorted(set(library.writers), key=lambda w: (len(w), w))
    rows = [["label", *writers], *([label, *(str(counts[label, w]) for w in writers)] for label in labels)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return "\n".join("  ".join(word.rjust(width) for word, width in zip(row, widths, strict=True)) for row in rows)


if __name__ == "__main__":
    sys.exit(main(tyro.cli(Arguments)))
