"""The tables of README and docs say what the files of results say, and one program alone writes these."""

from __future__ import annotations

import inspect
import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from signimit.benchmark.judge import CRITERION, judge_hash
from signimit.exceptions import FileFormatError, InvalidInputError
from signimit_envs.cli import COMMANDS, results
from signimit_envs.cli.result_tables import REGION, TABLES, with_tables
from signimit_envs.cli.results import MEASUREMENTS, people_of, results_page

ROOT = Path(__file__).parents[3]
RESULTS = ROOT / "results"
if not (ROOT / "README.md").is_file() or not RESULTS.is_dir():
    pytest.skip("README and results are not beside these tests", allow_module_level=True)
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page_has_every_table_as_the_results_have_it(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    assert with_tables(text, RESULTS) == text


def test_every_table_stands_on_a_page_and_the_long_ones_not_in_the_readme() -> None:
    shown = {page.name: [name for _, name, _ in REGION.findall(page.read_text(encoding="utf-8"))] for page in PAGES}
    assert {name for names in shown.values() for name in names} == set(TABLES)
    assert set(shown["README.md"]) == {"headline", "criterion"}


def test_every_page_that_says_obeyed_in_a_table_says_what_it_means() -> None:
    for page in [*PAGES, RESULTS / "benchmark" / "README.md", RESULTS / "real-people" / "people.md"]:
        text = page.read_text(encoding="utf-8")
        names = {name for _, name, _ in REGION.findall(text)}
        if names & {"headline", "sessions", "real_people", "each_person", "benchmark"} or page.is_relative_to(RESULTS):
            assert CRITERION in " ".join(text.split()), page


def test_only_what_stands_between_the_marks_is_replaced() -> None:
    text = "before\n<!-- table: checker -->\nold\n<!-- end -->\nafter | old\n"
    lines = with_tables(text, RESULTS).splitlines()
    assert (lines[0], lines[-1]) == ("before", "after | old")
    assert "old" not in lines[2:-2]
    assert lines[2].startswith("|")


def test_an_unknown_table_is_refused() -> None:
    with pytest.raises(InvalidInputError, match="table of results: expected checker"):
        with_tables("<!-- table: nonsense -->\n<!-- end -->", RESULTS)


@pytest.mark.parametrize("table", ["sessions", "real_people", "headline"])
def test_what_another_judge_said_is_not_published(table: str, tmp_path: Path) -> None:
    for folder in ("sessions", "real-people", "benchmark"):
        shutil.copytree(RESULTS / folder, tmp_path / folder)
    for file in (tmp_path / "sessions" / "joint" / "sessions.json", tmp_path / "real-people" / "people.json"):
        file.write_text(json.dumps(json.loads(file.read_text()) | {"judge": "abc"}))
    with pytest.raises(FileFormatError, match=rf"of judge {judge_hash()} \(`results make .*found judge abc"):
        TABLES[table](tmp_path)


def test_the_command_replaces_what_was_typed_by_hand(run: Any, tmp_path: Path) -> None:
    pytest.importorskip("tyro", reason="commands need tyro")
    shutil.copytree(RESULTS / "checker", tmp_path / "results" / "checker")
    (tmp_path / "docs").mkdir()
    pages = tmp_path / "README.md", tmp_path / "docs" / "results.md"
    for page in pages:
        page.write_text("<!-- table: checker -->\nold\n<!-- end -->\n")
    assert run("results", "readme", "--readme", pages[0]).count("1 tables, changed.") == 2
    assert run("results", "readme", "--readme", pages[0]).count("1 tables, as they were.") == 2
    assert all("old" not in page.read_text() for page in pages)


def test_the_folder_says_who_writes_it() -> None:
    assert (RESULTS / "README.md").read_text(encoding="utf-8") == results_page()
    for commands in MEASUREMENTS.values():
        assert {command.split()[0] for command in commands} <= set(COMMANDS)
        assert all("--out {out}" in command for command in commands)


def test_nothing_but_this_program_writes_results_unless_told_to() -> None:
    from signimit_envs.cli import benchmark, sessions, study, study_policies, timing

    commands: list[Callable[..., None]] = [sessions.main, study_policies.compare_policies]
    for module in (benchmark, study, timing):
        commands += module.SUBCOMMANDS.values()
    for command in commands:
        parameters = inspect.signature(command).parameters
        out = parameters["out"].default if "out" in parameters else parameters["plan"].default.out
        assert out.parts[0] == "out", command


def test_a_measurement_is_published_when_it_is_complete(
    run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("tyro", reason="commands need tyro")
    monkeypatch.chdir(tmp_path)
    few = "--sessions 1 --splits few --workers 1"
    steps = f"benchmark run --entry chance {few} --out {{out}}/board", "benchmark table --out {out}/board"
    monkeypatch.setitem(results.MEASUREMENTS, "benchmark", steps)
    monkeypatch.setitem(results.MEASUREMENTS, "cost", (steps[0], "benchmark table --out {out}/nothing"))
    run("results", "make", "benchmark")
    assert {f.name for f in (tmp_path / "results" / "board").iterdir()} == {"chance.json", "chance.jsonl", "README.md"}
    assert not (tmp_path / "out" / "results" / "benchmark").exists()
    before = (tmp_path / "results" / "board" / "chance.json").stat()
    with pytest.raises(SystemExit, match="2"):
        run("results", "make", "cost")
    assert (tmp_path / "results" / "board" / "chance.json").stat() == before
    assert (tmp_path / "out" / "results" / "cost" / "board" / "chance.jsonl").is_file()  # to go on from


def test_rows_of_learners_that_are_gone_stay_when_the_others_are_made_again(
    run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("tyro", reason="commands need tyro")
    monkeypatch.chdir(tmp_path)
    kept = tmp_path / "results" / "benchmark" / "earlier"
    shutil.copytree(RESULTS / "benchmark" / "earlier", kept)
    monkeypatch.setitem(results.MEASUREMENTS, "benchmark", ("benchmark table --out {out}/benchmark",))
    run("results", "make", "benchmark")
    assert "| joint_0_1_0:Joint | **" in (kept.parent / "README.md").read_text()
    assert {file.suffix for file in kept.iterdir()} == {".json", ".jsonl"}


def test_what_cannot_be_made_is_told_before_anything_is_run(
    run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("tyro", reason="commands need tyro")
    monkeypatch.chdir(tmp_path)
    assert "Unknown measurement 'nonsense'" in run.refusal("results", "make", "sessions", "nonsense")
    assert people_of("real-people") == {"signs", "movements"}
    assert people_of("sessions") == set()
    assert "clumsiness: expected strokes of real people, --strangers, found none." in run.refusal(
        "results", "make", "clumsiness"
    )
    sentence = "real-people: expected strokes of real people, --signs and --movements, found none."
    assert sentence in run.refusal("results", "make", "sessions", "real-people")
    assert not list(tmp_path.iterdir())


def test_strokes_are_imported_with_both_triangles_and_both_circles(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import numpy as np

    from signimit.strokes import StrokeLibrary
    from signimit.teaching.people import synthetic_library

    monkeypatch.chdir(tmp_path)
    synthetic_library(("triangle up", "circle"), samples=2, rng=np.random.default_rng(0)).save("shapes.npz")
    places = results._prepare_strokes((Path("shapes.npz"),), (Path("shapes.npz"),))
    labels = set(StrokeLibrary.load(places["movements"]).labels)
    assert labels == {"triangle up", "triangle down", "circle", "circle, other way"}
