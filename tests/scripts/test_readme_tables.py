"""The tables of the README say what the files of results say."""

import runpy
from pathlib import Path

import pytest

pytest.importorskip("tyro", reason="programs need tyro")

from signimit import InvalidInputError

ROOT = Path(__file__).parents[2]
if not (ROOT / "README.md").is_file() or not (ROOT / "results").is_dir():
    pytest.skip("README and results are not beside these tests", allow_module_level=True)
PROGRAM = runpy.run_path(str(ROOT / "scripts" / "readme.py"), run_name="readme")


def test_the_readme_has_every_table_as_the_results_have_it() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert {name for _, name, _ in PROGRAM["REGION"].findall(text)} == set(PROGRAM["TABLES"])
    assert PROGRAM["with_tables"](text) == text


def test_only_what_stands_between_the_marks_is_replaced() -> None:
    text = "before\n<!-- table: benchmark -->\nold\n<!-- end -->\nafter | old\n"
    lines = PROGRAM["with_tables"](text).splitlines()
    assert (lines[0], lines[-1]) == ("before", "after | old")
    assert "old" not in lines[2:-2]
    assert lines[2].startswith("|")


def test_an_unknown_table_is_refused() -> None:
    with pytest.raises(InvalidInputError, match="README: table: expected checker"):
        PROGRAM["with_tables"]("<!-- table: nonsense -->\n<!-- end -->")
