"""The benchmark's program: run, table, plot, and a sentence for what cannot be."""

import json
import runpy
import sys
from pathlib import Path

import pytest

pytest.importorskip("tyro")
pytest.importorskip("tqdm")

SCRIPT = Path(__file__).parents[2] / "scripts" / "benchmark.py"
STILL = """
class Still:
    def observe(self, demonstrations): pass
    def begin(self, signs, objects): pass
    def act(self, observation): return 0.0, 0.0
"""


def run(*arguments: object, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", [str(SCRIPT), *map(str, arguments)])
    runpy.run_path(str(SCRIPT), run_name="__main__")


def test_an_entry_of_ones_own_runs_and_gets_a_line_and_a_panel(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "still.py").write_text(STILL)
    out = tmp_path / "out"
    entry = f"{tmp_path / 'still.py'}:Still"
    options = ("--entry", entry, "--splits", "few", "--workers", 1, "--out", out)
    run("run", *options, "--sessions", 2, monkeypatch=monkeypatch)
    said = capsys.readouterr().out
    assert "| still.py:Still | **0** | 0 |" in said
    assert "s of a processor; 10000 take " in said
    run("table", "--out", out, monkeypatch=monkeypatch)
    assert "| still.py:Still | 2 | 0.00 [0.00, 0.18] | 1.00 [1.00, 1.00] |" in (out / "README.md").read_text()
    pytest.importorskip("matplotlib")
    run("plot", "--out", out, monkeypatch=monkeypatch)
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
        (("table",), "expected results; `benchmark.py run` makes them, found none."),
        (("plot",), "expected results; `benchmark.py run` makes them, found none."),
    ],
)
def test_bad_input_gets_one_sentence(
    arguments: tuple[str, ...],
    sentence: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as stop:
        run(*arguments, monkeypatch=monkeypatch)
    said = capsys.readouterr().err
    assert stop.value.code == 2
    assert sentence in said
    assert said.count("\n") == 1
    assert not list(tmp_path.iterdir())
