"""What the README shows a newcomer runs as it stands, and does what it says."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

README = Path(__file__).parent.parent / "README.md"
if not README.is_file():
    pytest.skip("the README is not beside these tests", allow_module_level=True)
TEXT = README.read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)


@pytest.mark.slow
def test_the_program_of_the_readme_learns_and_obeys(capsys: pytest.CaptureFixture[str]) -> None:
    """Its blocks are one program, in order; nothing of it needs OpenGL."""
    names: dict[str, Any] = {}
    environment, arrays, questions = BLOCKS
    exec(environment, names)
    said = capsys.readouterr().out
    assert "12 demonstrations show 3 movements." in said
    assert [line[: line.rindex(" ")] for line in said.splitlines()[-3:]] == [
        f"Request(movement={number}, focus={number}) True" for number in range(3)
    ]
    exec(arrays, names)
    assert capsys.readouterr().out.startswith("0 1 ")
    assert names["model"].labels.tolist() == [0, 1, 0, 1, 0, 1, 0, 1]
    assert names["model"].focus.tolist() == [0, 0, 1, 1, 0, 0, 1, 1]
    exec(questions, names)
    assert "No demonstration is in doubt" in capsys.readouterr().out
    assert names["sure"][:2] == (1, 0)
    assert len(names["model"].labels) == 9


@pytest.mark.slow
def test_the_code_of_readme_and_docs_is_typed_as_mypy_strict_wants_it(
    tmp_path: Path, pytestconfig: pytest.Config
) -> None:
    """Each page is a program, its blocks in order."""
    pytest.importorskip("mypy", reason="types are checked with signimit[dev]")
    programs = []
    for page in (README, *sorted((README.parent / "docs").glob("*.md"))):
        blocks = re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
        if blocks:
            programs.append(tmp_path / f"{page.stem.lower()}_program.py")
            programs[-1].write_text("\n".join(blocks), encoding="utf-8")
    assert len(programs) >= 2
    cache = pytestconfig.cache.mkdir("mypy") if pytestconfig.cache else tmp_path / "cache"
    config = ["--config-file", str(README.parent / "pyproject.toml"), "--cache-dir", str(cache)]
    command = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", *config, *map(str, programs)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_every_program_of_the_readme_exists() -> None:
    for name in re.findall(r"sh scripts/run\.sh (\w+)", TEXT):
        assert name in {"test", "docs"} or (README.parent / "scripts" / f"{name}.py").is_file(), name


def test_every_picture_and_page_of_the_readme_exists() -> None:
    for target in re.findall(r"\]\((?!https?:)([^)#]+)\)", TEXT):
        assert (README.parent / target).is_file(), target
