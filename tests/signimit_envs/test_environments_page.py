"""The page about copies, processes and threads does what it says."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from signimit_envs import RenderingError
from signimit_envs.video.backend import choose_backend

PAGE = Path(__file__).parents[2] / "docs" / "environments.md"


@pytest.mark.slow
@pytest.mark.skipif(not PAGE.is_file(), reason="the page is not beside these tests")
def test_the_code_of_the_page_runs(tmp_path: Path) -> None:
    try:
        choose_backend()
    except RenderingError as error:
        pytest.skip(str(error))
    program = tmp_path / "page.py"
    program.write_text("\n".join(re.findall(r"```python\n(.*?)```", PAGE.read_text("utf-8"), re.DOTALL)), "utf-8")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    done = subprocess.run([sys.executable, program], env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "(2, 64, 64, 3)\n"), done.stderr
