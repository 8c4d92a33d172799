"""The tables of the README say what the files of results say."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from signimit.exceptions import InvalidInputError
from signimit_envs.cli.results import REGION, TABLES, with_tables

ROOT = Path(__file__).parents[3]
RESULTS = ROOT / "results"
if not (ROOT / "README.md").is_file() or not RESULTS.is_dir():
    pytest.skip("README and results are not beside these tests", allow_module_level=True)


def test_the_readme_has_every_table_as_the_results_have_it() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert {name for _, name, _ in REGION.findall(text)} == set(TABLES)
    assert with_tables(text, RESULTS) == text


def test_only_what_stands_between_the_marks_is_replaced() -> None:
    text = "before\n<!-- table: benchmark -->\nold\n<!-- end -->\nafter | old\n"
    lines = with_tables(text, RESULTS).splitlines()
    assert (lines[0], lines[-1]) == ("before", "after | old")
    assert "old" not in lines[2:-2]
    assert lines[2].startswith("|")


def test_an_unknown_table_is_refused() -> None:
    with pytest.raises(InvalidInputError, match="README: table: expected checker"):
        with_tables("<!-- table: nonsense -->\n<!-- end -->", RESULTS)


def test_the_command_replaces_what_was_typed_by_hand(run: Any, tmp_path: Path) -> None:
    pytest.importorskip("tyro", reason="commands need tyro")
    shutil.copytree(RESULTS / "checker", tmp_path / "results" / "checker")
    readme = tmp_path / "README.md"
    readme.write_text("<!-- table: checker -->\nold\n<!-- end -->\n")
    assert "1 tables, changed." in run("results", "readme", "--readme", readme)
    assert "1 tables, as they were." in run("results", "readme", "--readme", readme)
    assert "old" not in readme.read_text()
