"""What the README shows a newcomer runs as it stands, and does what it says."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from signimit_envs.exceptions import RenderingError
from signimit_envs.rendering import choose_backend

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


def test_the_core_of_the_readme_understands_made_up_recordings(capsys: pytest.CaptureFixture[str]) -> None:
    exec(BLOCKS[1], {})
    printed = capsys.readouterr().out
    assert "8 demonstrations show 2 movements." in printed
    assert "Movement 0: demonstrations 0 (about red), 2 (about green), 4 (about red), 6 (about green)." in printed
    assert printed.splitlines()[-1].startswith("0 1 ")


def test_every_program_of_the_readme_exists() -> None:
    for name in re.findall(r"sh scripts/run\.sh (\w+)", TEXT):
        assert name == "test" or (README.parent / "scripts" / f"{name}.py").is_file(), name


def test_every_picture_and_page_of_the_readme_exists() -> None:
    for target in re.findall(r"\]\((?!https?:)([^)#]+)\)", TEXT):
        assert (README.parent / target).is_file(), target
