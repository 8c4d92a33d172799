"""The study of how far built-in people are from each other, beside real people who are strangers."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from tqdm import tqdm

from signimit.benchmark.results import installed_versions
from signimit.benchmark.studies.clumsiness import (
    MEASURES,
    SHAPES,
    built_in_strangers,
    clumsiness_table,
    distance_to,
    nearest_spread,
    real_strangers,
)
from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import whole_files
from signimit.strokes import StrokeLibrary
from signimit.teaching.people.choosing import CLUMSY
from signimit_envs.cli.command_line import check_output_folder, command_text

SPREADS = (1.0, 1.5, 1.75, 2.0, 2.25, 2.5, 3.0)


def study_clumsiness(
    library: Path,
    /,
    *,
    shapes: tuple[str, ...] = SHAPES,
    spreads: tuple[float, ...] = SPREADS,
    people: int = 100,
    seed: int = 0,
    out: Path = Path("out/clumsiness"),
) -> None:
    """Compare how unlike two built-in people draw one thing with how unlike two real people do.

    Args:
        library: Stroke library of people who are strangers to each other, e.g. players of Quick, Draw!; the first
            drawing by each of each shape counts.
        shapes: Labels that are compared.
        spreads: How far built-in people are from each other, times the usual; one of them must be 1.
        people: How many built-in people draw, for each spread.
        seed: Of everything drawn at random.
        out: Folder for clumsiness.md, clumsiness.json and clumsiness.png.
    """
    from signimit.plots.clumsiness import draw_clumsiness

    if not spreads or any(not np.isfinite(s) or s < 0 for s in spreads) or 1.0 not in spreads:
        raise InvalidInputError("--spreads", "numbers of zero or more, 1 among them", f"{spreads}")
    check_output_folder(out)
    strokes = StrokeLibrary.load(library)
    real = real_strangers(strokes, shapes)
    built_in = {s: built_in_strangers(s, people, seed, shapes) for s in tqdm(sorted(set(spreads)), unit="spread")}
    nearest, table = nearest_spread(real, built_in), clumsiness_table(real, list(built_in.values()))
    with whole_files(out) as folder:
        (folder / "clumsiness.md").write_text(table + "\n", encoding="utf-8")
        facts = {
            "command": command_text(),
            "versions": installed_versions("signimit", "numpy", "scipy"),
            "people": strokes.source,
            "drawings": {label: len(drawn) for label, drawn in real.drawings.items()},
            "Kolmogorov's distance to real people": {
                f"{spread:g}": {name: round(far, 3) for name, far in distance_to(real, one).items()}
                for spread, one in built_in.items()
            },
            "nearest spread": nearest,
            "the package's": CLUMSY,
        }
        (folder / "clumsiness.json").write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")
        draw_clumsiness(real, built_in[1.0], built_in[nearest]).savefig(folder / "clumsiness.png", dpi=100)
    print(table)
    print(f"Nearest by the sum of both distances ({', '.join(MEASURES)}): {nearest:g}; the package has {CLUMSY:g}.")
    print(f"Written to {out}.")
