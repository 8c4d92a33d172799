"""The study of the weights of the features of drawings, which the default learner compares drawings by."""

from __future__ import annotations

import json
from collections.abc import Collection, Sequence
from pathlib import Path

import numpy as np

from signimit.benchmark.results import installed_versions
from signimit.benchmark.studies.drawing_weights import (
    DrawingPairs,
    area_under_curve,
    compare_people,
    fit_drawing_weights,
)
from signimit.benchmark.tables import markdown_table
from signimit.exceptions import InvalidInputError, UnknownNameError
from signimit.io.safe_files import whole_files
from signimit.learners.joint.drawing_dissimilarity import DRAWINGS, FEATURES
from signimit.strokes import StrokeLibrary
from signimit_envs.cli.command_line import check_output_folder, command_text


def study_drawing_weights(
    libraries: tuple[Path, ...],
    /,
    *,
    without: tuple[str, ...] = (),
    seed: int = 0,
    out: Path = Path("out/drawing-weights"),
) -> None:
    """Fit the weights that the default learner compares drawings by, and measure how well they tell drawings apart.

    Args:
        libraries: Stroke libraries. Where writers drew several things several times, each is compared with herself;
            where everybody drew one thing, strangers are compared with each other.
        without: Labels that are left out of libraries of strangers, to test on.
        seed: Chooses among many drawings of one thing by a writer.
        out: Folder for drawing_weights.json and areas.md.
    """
    if not libraries:
        raise InvalidInputError("drawing-weights", "at least 1 stroke library", "none")
    check_output_folder(out)
    people = compare_libraries(libraries, without, seed)
    fitted = fit_drawing_weights(people)
    named = dict(zip(FEATURES, fitted.weights.round(3).tolist(), strict=True)) | {"offset": round(fitted.offset, 3)}
    shipped = (*DRAWINGS.weights, DRAWINGS.offset)
    weights = markdown_table(
        ("feature", "fitted", "the package's"),
        [(name, value, theirs) for (name, value), theirs in zip(named.items(), shipped, strict=True)],
    )
    lines = []
    for number, one in enumerate(people):
        others = people[:number] + people[number + 1 :]
        models = (fitted, *([fit_drawing_weights(others)] if others else []), DRAWINGS)
        lines.append((one.source, len(one.equal), *(f"{area_under_curve(one, model):.4f}" for model in models)))
    columns = ("fitted", *(["without these people"] if len(people) > 1 else []), "the package's")
    areas = markdown_table(("area under the curve", "pairs", *columns), lines)
    with whole_files(out) as folder:
        (folder / "areas.md").write_text(areas + "\n", encoding="utf-8")
        facts = {
            "command": command_text(),
            "versions": installed_versions("signimit", "numpy", "scipy"),
            "weights, nats a unit": named,
        }
        (folder / "drawing_weights.json").write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")
    print(f"{weights}\n\n{areas}")


def compare_libraries(paths: Sequence[Path], without: Collection[str], seed: int = 0) -> list[DrawingPairs]:
    """Compare the drawings of everybody in stroke libraries, as `compare_people` does.

    Raises:
        UnknownNameError: If no library has one of the labels that are left out.
    """
    libraries, rng = [StrokeLibrary.load(path) for path in paths], np.random.default_rng(seed)
    known = sorted({label for library in libraries for label in library.labels})
    for label in without:
        if label not in known:
            raise UnknownNameError("label", label, known)
    return [pairs for library in libraries for pairs in compare_people(library, rng, without)]
