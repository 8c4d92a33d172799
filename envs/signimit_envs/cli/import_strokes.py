"""Read strokes that real people drew into one stroke library file, and print what was found."""

from __future__ import annotations

from pathlib import Path

from signimit.io.formats import inventory_table, read_strokes, write_inkml
from signimit.teaching.people.relabelling import renamed, selected, with_mirror_images


def main(
    paths: tuple[Path, ...],
    /,
    out: Path,
    format: str = "auto",
    writer: tuple[str, ...] = (),
    label: tuple[str, ...] = (),
    rename: tuple[tuple[str, str], ...] = (),
    mirror: tuple[tuple[str, str], ...] = (),
) -> None:
    """Read UNIPEN text, $1 recogniser XML, W3C InkML or our own libraries into one library file.

    Writers keep the names of their data set: "2" of one need not be "2" of another, so give each data set its own file.

    Args:
        paths: Files and folders to read.
        out: File to write: a library (.npz), or InkML if it ends in .inkml.
        format: unipen, dollar, inkml, library, or auto to look into each file.
        writer: Keep these writers only.
        label: Keep these labels only, as the files have them.
        rename: Pairs of a label and its new one, e.g. triangle "triangle up".
        mirror: Pairs of a (new) label and that of its upside-down images, which are added.
    """
    library = selected(read_strokes(paths, format), label, writer)
    library = with_mirror_images(renamed(library, dict(rename)), dict(mirror))
    if out.suffix == ".inkml":
        write_inkml(out, library)
    else:
        library.save(out)
    print(inventory_table(library))
    print(f"{len(library)} strokes from {library.source} are in {out}.")
