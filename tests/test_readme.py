"""What the README shows a newcomer runs as it stands, and does what it says."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from signimit_envs.exceptions import RenderingError
from signimit_envs.video.backend import choose_backend

README = Path(__file__).parent.parent / "README.md"
if not README.is_file():
    pytest.skip("the README is not beside these tests", allow_module_level=True)
TEXT = README.read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)


def test_the_environment_of_the_readme_obeys(capsys: pytest.CaptureFixture[str]) -> None:
    try:
        choose_backend()
    except RenderingError as error:
        pytest.skip(str(error))
    exec(BLOCKS[0], {})
    assert capsys.readouterr().out.startswith("Request(movement=2, focus=0) True Performance(movement=2, focus=0")


def test_the_environment_of_the_readme_takes_a_language_and_shows_pictures(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    try:
        choose_backend()
    except RenderingError as error:
        pytest.skip(str(error))
    monkeypatch.chdir(tmp_path)
    exec(BLOCKS[1], {})
    assert capsys.readouterr().out == "(96, 96, 3) (3, 64, 2) False\n"
    assert [file.suffix for file in (tmp_path / "films").iterdir()] == [".mp4"]


@pytest.mark.slow
def test_the_core_of_the_readme_understands_made_up_recordings(capsys: pytest.CaptureFixture[str]) -> None:
    names: dict[str, Any] = {}
    exec(BLOCKS[2], names)
    printed = capsys.readouterr().out
    assert "8 demonstrations show 2 movements." in printed
    assert "Movement 1: demonstrations 1 (about red), 3 (about green), 5 (about red), 7 (about green)." in printed
    assert printed.splitlines()[-1].startswith("0 1 ")
    exec(BLOCKS[3], names)
    assert "No demonstration is in doubt" in capsys.readouterr().out
    assert names["sure"][:2] == (1, 0)
    assert len(names["model"].labels) == 9
    exec(BLOCKS[4], names)
    assert capsys.readouterr().out == "(100, 401, 2)\n"
    last = names["tracks"].paths[:, -100:] - names["scenes"][:, None, 0]
    assert (np.hypot(*last.T).max(axis=0) < 0.2).all()  # a triangle with corners 0.1 to 0.15 m from the object


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
        assert name == "test" or (README.parent / "scripts" / f"{name}.py").is_file(), name


def test_every_picture_and_page_of_the_readme_exists() -> None:
    for target in re.findall(r"\]\((?!https?:)([^)#]+)\)", TEXT):
        assert (README.parent / target).is_file(), target
