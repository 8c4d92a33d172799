"""The benchmark's program: run, table, plot, and a sentence for what cannot be."""

import json
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("tyro", reason="commands need signimit[scripts]")
pytest.importorskip("tqdm", reason="commands need signimit[scripts]")

STILL = """
class Still:
    def observe(self, demonstrations): pass
    def begin(self, signs, objects): pass
    def act(self, observation): return 0.0, 0.0
"""


def test_an_entry_of_ones_own_runs_and_gets_a_line_and_a_panel(run: Any, tmp_path: Path) -> None:
    (tmp_path / "still.py").write_text(STILL)
    out = tmp_path / "out"
    entry = f"{tmp_path / 'still.py'}:Still"
    options = ("--entry", entry, "--splits", "few", "--workers", 1, "--out", out)
    said = run("benchmark", "run", *options, "--sessions", 2)
    assert "| still.py:Still | **0 [0, 18]** | 0 [0, 18] |" in said
    assert "s of a processor; 10000 take " in said
    run("benchmark", "table", "--out", out)
    assert "| still.py:Still | 2 | 18 | 0.00 [0.00, 0.18] | 3.00 [3.00, 3.00] |" in (out / "README.md").read_text()
    pytest.importorskip("matplotlib", reason="figures need signimit[scripts]")
    run("benchmark", "plot", "--out", out)
    assert (out / "obeyed.png").read_bytes().startswith(b"\x89PNG")
    summary = json.loads((out / "still.py-Still.json").read_text())
    assert summary["splits"]["few"]["seeds"] == [[0, 1]]


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (("run", "--splits", "hard"), "Unknown split 'hard'; known are paper, unseen-pair,"),
        (("run", "--entry", "nobody"), "Unknown entry 'nobody'; known are joint,"),
        (("run", "--entry", "nowhere.py:Class"), "nowhere.py: No such file or directory."),
        (("run", "--engine", "dask"), "--scheduler: expected the address of a dask scheduler"),
        (("run", "--sessions", "0"), "sessions: expected at least 1, from seed 0 on, found 0 from seed 0."),
        (("run", "--workers", "-1"), "workers: expected at least 1, found -1."),
        (("table",), "expected results; `benchmark run` makes them, found none."),
        (("plot",), "expected results; `benchmark run` makes them, found none."),
    ],
)
def test_bad_input_gets_one_sentence(
    run: Any, arguments: tuple[str, ...], sentence: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert sentence in run.refusal("benchmark", *arguments)
    assert not list(tmp_path.iterdir())
