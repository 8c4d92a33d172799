"""The folder ``results``, which this program alone writes, and the tables of README and docs that are made from it."""

from __future__ import annotations

import shlex
import shutil
from pathlib import Path

from signimit.benchmark.results import EARLIER
from signimit.benchmark.tables import markdown_table
from signimit.exceptions import InvalidInputError, UnknownNameError
from signimit.io.safe_files import replaced_file
from signimit.strokes import StrokeLibrary
from signimit.teaching.people.relabelling import with_both_triangles, with_mirror_images
from signimit_envs.cli.result_tables import REGION, with_tables

DRAFTS = Path("out/results")  # what is measured stands here until a measurement is complete
_STROKES = DRAFTS / "strokes"  # of real people, as the commands take them
PEOPLE = ("signs", "movements", "strangers")  # real ones, whose strokes are not part of this project
_PEOPLE = "--signs {signs} --movements {movements}"
_SHAPES = "--labels circle 'triangle up' 'triangle down' rectangle star --kinds path-following knn gmr dmp"

MEASUREMENTS: dict[str, tuple[str, ...]] = {
    "sessions": (
        "sessions --sessions 20 --method joint --policy path-following --out {out}/sessions/joint",
        "sessions --sessions 20 --method paper --policy knn --out {out}/sessions/paper",
    ),
    "real-people": (f"study real-people --sessions 180 {_PEOPLE} --out {{out}}/real-people",),
    "benchmark": (
        "benchmark run --entry joint paper chance --out {out}/benchmark",
        "benchmark table --out {out}/benchmark",
        "benchmark plot --out {out}/benchmark",
    ),
    "policies": (
        "study policies --sessions 2 --starts 6 --out {out}/policies/synthetic",
        f"study policies --movers {{movements}} {_SHAPES} --sessions 12 --starts 6 --out {{out}}/policies/real",
    ),
    "judge": ("study judge {movements} --built-in 12 --sessions 12 --out {out}/judge",),
    "paper-conditions": ("study paper --movers {movements} --sessions 12 --out {out}/paper-conditions",),
    "cells": (
        f"study cells --sessions 15 {_PEOPLE} --out {{out}}/study",
        "study calibration --out {out}/study",
    ),
    "asking": (f"study asking --sessions 10 {_PEOPLE} --out {{out}}/study",),
    "people": (f"study people --sessions 6 {_PEOPLE} --out {{out}}/study",),
    "signs": ("study signs --signs {signs} --sessions 300 --out {out}/study",),
    "growth": ("timing growth --out {out}/study",),
    "throughput": ("timing throughput --batches 9 36 256 --seconds 2 --turns 3 --out {out}/throughput",),
    "clumsiness": ("study clumsiness {strangers} --out {out}/clumsiness",),
    "cost": ("benchmark run --first-seed 20 --sessions 2 --out {out}/benchmark/cost",),
}
"""What is published: each measurement's commands with their settings."""


def make_results(
    names: tuple[str, ...] = (),
    /,
    signs: tuple[Path, ...] = (),
    movements: tuple[Path, ...] = (),
    strangers: Path | None = None,
    out: Path = Path("results"),
) -> None:
    """Measure what is published, with the published settings, and write it into the folder of results.

    A measurement is made in out/results and moved when it is complete. One that was killed goes on where it stopped,
    if its commands can.

    Args:
        names: Which measurements, of sessions, real-people, benchmark, policies, judge, paper-conditions, cells,
            asking, people, signs, growth, throughput, clumsiness, cost; left out, all that can be made of what is
            given.
        signs: Digits of real people: pendigits-orig.tra and .tes of UCI, or libraries made of them.
        movements: Shapes of real people: the folder xml_logs of the $1 recogniser, or a library made of it.
        strangers: Library of people who are strangers to each other, one drawing each, e.g. of Quick, Draw!
        out: Folder of results.
    """
    places = _prepare_strokes(signs, movements) if signs and movements else {}
    if strangers is not None:
        places["strangers"] = str(_STROKES / "strangers.npz")
        _STROKES.mkdir(parents=True, exist_ok=True)
        StrokeLibrary.load(strangers).save(places["strangers"])
    for name in names:
        if name not in MEASUREMENTS:
            raise UnknownNameError("measurement", name, MEASUREMENTS)
        if missing := people_of(name) - set(places):
            options = " and ".join(f"--{option}" for option in sorted(missing, reverse=True))
            raise InvalidInputError(name, f"strokes of real people, {options}", "none")
    for name in names or [name for name in MEASUREMENTS if people_of(name) <= set(places)]:
        draft, kept = DRAFTS / name, out / name / EARLIER
        if kept.is_dir():  # rows that stand in this measurement's tables and are not made again
            shutil.copytree(kept, draft / name / EARLIER, dirs_exist_ok=True)
        for command in MEASUREMENTS[name]:
            words = [word.format(out=draft, **places) for word in shlex.split(command)]
            print(f"results make {name}: {shlex.join(words)}", flush=True)
            _run(words)
        for file in sorted(path for path in draft.rglob("*") if path.is_file()):
            target = out / file.relative_to(draft)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.move(file, target)
        shutil.rmtree(draft)
    out.mkdir(parents=True, exist_ok=True)
    (out / "README.md").write_text(results_page(), encoding="utf-8")
    print(f"Written to {out}; `results readme` writes the tables of README and docs.")


def people_of(name: str) -> set[str]:
    """Return whose strokes a measurement needs, of signs, movements and strangers."""
    return {who for who in PEOPLE if any(f"{{{who}}}" in command for command in MEASUREMENTS[name])}


def _prepare_strokes(signs: tuple[Path, ...], movements: tuple[Path, ...]) -> dict[str, str]:
    """Import strokes into two libraries, with triangles both ways up and circles both ways round."""
    from signimit.benchmark.studies.real_people import read_people

    _STROKES.mkdir(parents=True, exist_ok=True)
    read_people(signs).save(_STROKES / "signs.npz")
    shapes = with_both_triangles(read_people(movements))
    if "circle, other way" not in shapes.labels:
        shapes = with_mirror_images(shapes, {"circle": "circle, other way"})
    shapes.save(_STROKES / "movements.npz")
    return {"signs": str(_STROKES / "signs.npz"), "movements": str(_STROKES / "movements.npz")}


def _run(words: list[str]) -> None:
    from signimit_envs.cli import run_command

    run_command(words[0], words[1:])


def results_page() -> str:
    """Return the page that says what the folder is, in Markdown."""
    rows = [
        (f"`{name}`", "<br>".join(f"`{command.partition(' --out')[0]}`" for command in commands))
        for name, commands in MEASUREMENTS.items()
    ]
    return f"""# Results

`sh scripts/run.sh results make NAME...` alone writes this folder; every other program writes to `out/`. The tables of
README and docs are made from it by `sh scripts/run.sh results readme`, and show nothing that another judge said.
`{{signs}}` are UCI's pendigits-orig, `{{movements}}` the $1 recogniser's xml_logs, `{{strangers}}` single drawings by
players of Quick, Draw!; none is in this repository. `benchmark/earlier` has rows of learners that are gone. The folder
`checker` has what a program that is not part of this project, and shares no code with it, found.

{markdown_table(("name", "commands"), rows)}
"""


def write_tables(*, readme: Path = Path("README.md")) -> None:
    """Write the tables of README and docs anew, from the folder ``results`` beside them.

    Args:
        readme: The README; in it and in the pages of the folder ``docs`` beside it, whatever stands between
            ``<!-- table: NAME -->`` and ``<!-- end -->`` is replaced.
    """
    pages = [readme, *sorted((readme.parent / "docs").glob("*.md"))]
    old = {page: page.read_text(encoding="utf-8") for page in pages}
    new = {page: with_tables(text, readme.parent / "results") for page, text in old.items()}
    for page, text in new.items():
        count = len(REGION.findall(text))
        if text != old[page]:
            with replaced_file(page) as file:
                file.write(text.encode())
        if count:
            print(f"{page}: {count} tables, {'changed' if text != old[page] else 'as they were'}.")


SUBCOMMANDS = {"make": make_results, "readme": write_tables}
