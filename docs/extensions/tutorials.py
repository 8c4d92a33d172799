"""Sphinx-Gallery's view of our figures, and what each tutorial starts from."""

from __future__ import annotations

import os
import warnings
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from sphinx_gallery.scrapers import figure_rst

_WIDEST = 12.0  # inches; a page is narrower than a figure of twelve columns
_shown: list[Figure] = []  # of the tutorial that runs
_filters: list[list[Any]] = []  # of warnings, as they were before it


def reset(gallery_conf: dict[str, Any], fname: str, when: str) -> None:
    """Start a tutorial with matplotlib's defaults and with warnings as errors; put both back after it."""
    plt.close("all")
    plt.rcdefaults()
    _shown.clear()
    if when == "before":
        _filters.append(list(warnings.filters))
        warnings.simplefilter("error")
    else:
        warnings.filters[:] = _filters.pop()


def figures(block: Any, block_vars: dict[str, Any], gallery_conf: dict[str, Any]) -> str:
    """Save the figures that a block of a tutorial has made: those of pyplot and those of `signimit.plots`.

    The latter are no windows of pyplot's: they are found by the names that the tutorial gave them, and as the value of
    the block's last line.
    """
    made = [value for value in block_vars["example_globals"].values() if isinstance(value, Figure)]
    made += [plt.figure(number) for number in plt.get_fignums()]
    files = []
    for figure in dict.fromkeys(made):
        if any(figure is other for other in _shown):
            continue
        _shown.append(figure)
        path = Path(next(block_vars["image_path_iterator"]))
        figure.savefig(path, dpi=110 * min(1.0, _WIDEST / figure.get_figwidth()), metadata={"Software": None})
        files.append(os.fspath(path))
    plt.close("all")
    return figure_rst(files, gallery_conf["src_dir"])
