"""The timing programs write what they measured, whole or not at all; what they measure is tested elsewhere."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from signimit.benchmark.studies.scaling import CODES, STEPS, Measurement
from signimit_envs import RenderingError
from signimit_envs.studio import load
from signimit_envs.timing import core, environments, throughput
from signimit_envs.timing.measuring import Timing

pytest.importorskip("tyro", reason="commands need signimit[scripts]")


def read_result(folder: Path, name: str, said: str) -> Any:
    """Return the JSON of a result whose page was printed too."""
    assert {file.name for file in folder.iterdir()} >= {f"{name}.json", f"{name}.md"}
    assert (folder / f"{name}.md").read_text() in said
    return json.loads((folder / f"{name}.json").read_text())


def test_the_core(run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(core, "time_core", lambda seed, turns: [Timing("Δ of 12 paths", 0.1, 2.0, 0.05, 0.05)])
    facts = read_result(tmp_path, "core", run("timing", "core", "--turns", 1, "--out", tmp_path))
    assert facts["command"].startswith("python -m signimit timing core --turns 1 --out ")
    assert facts["core"][0]["work"] == "Δ of 12 paths"


def test_the_environments_also_where_there_is_no_opengl(
    run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_frames() -> None:
        raise RenderingError("no OpenGL library was found", "Install one.")

    monkeypatch.setattr(environments, "time_frames", no_frames)
    monkeypatch.setattr(environments, "time_steps", lambda env_id, turns: Timing(env_id, 1.1, 1.0, 1.1, 1.5))
    monkeypatch.setattr(environments, "time_vector_envs", lambda count, turns: [Timing(f"{count} envs", 1.0)])
    said = run("timing", "env", "--envs", 3, "--out", tmp_path)
    facts = read_result(tmp_path, "env", said)
    assert "No frames: Cannot render: no OpenGL library was found. Install one." in said
    works = [row["work"] for row in facts["environments"]]
    assert works == ["signimit/Tabletop-v0", "signimit/TabletopHand-v0", "3 envs"]


def test_many_reproductions(run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        throughput,
        "measure_batches",
        lambda work, batches, threads, *_: [
            throughput.BatchSpeed(batch, number, 11.0, 10.5, 6.0) for batch in batches for number in threads
        ],
    )
    monkeypatch.setattr(throughput, "compose_work", lambda *_: throughput.Work([], [], []))
    monkeypatch.setattr(throughput, "compare_paths", lambda *_: throughput.Agreement("knn", 18, 1e-6, 18))
    monkeypatch.setattr(throughput, "measure_parts", lambda *_: [throughput.Part("everything", 1.0, None)])
    options = ["--batches", 9, 64, "--threads", 0, "--parts-of", 9, "--out", tmp_path / "out"]
    facts = read_result(tmp_path / "out", "throughput", run("timing", "throughput", *options))
    assert facts["plan"] == {"seconds": 4.0, "turns": 5, "parts_of": 9, "seed": 0}
    assert [(row["batch"], row["threads"]) for row in facts["batches"]] == [(9, 0), (64, 0)]
    assert facts["parts"] == [{"name": "everything", "alone": 1.0, "together": None}]


def test_growth(run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("matplotlib", reason="figures need signimit[scripts]")
    rows = [Measurement(3, step, code, 0.2, 0.1, 0.5) for step in STEPS for code in CODES]
    monkeypatch.setattr("signimit.benchmark.studies.scaling.measure_growth", lambda *_: iter(rows))
    facts = read_result(tmp_path, "scaling", run("timing", "growth", "--counts", 3, "--out", tmp_path))
    assert [tuple(row.values()) for row in facts["growth"]] == rows
    head, first, *_ = (tmp_path / "scaling.csv").read_text().splitlines()
    assert head == "demonstrations,step,code,seconds,processor_seconds,megabytes"
    assert first == "3,distances of drawings,numba,0.2,0.1,0.5"
    assert (tmp_path / "scaling.png").read_bytes().startswith(b"\x89PNG")


def test_the_studio(run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Process:
        def __init__(self, folder: Path) -> None:
            assert folder.is_dir()

        def __enter__(self) -> tuple[str, int]:
            return "http://127.0.0.1:1/", 2

        def __exit__(self, *_: object) -> None:
            pass

    speed = load.Speed(motion=[0.2, 0.4], update=[0.1], frames={1: [40.0], 2: [30.0, 31.0]}, real_time=1.0)
    monkeypatch.setattr(load, "studio_process", Process)
    monkeypatch.setattr(load, "measure_speed", lambda *_: speed)
    monkeypatch.setattr(load, "measure_growth", lambda *_: load.Growth(10.0, 99, 150.0, 151.0, 1.0))
    facts = read_result(tmp_path, "studio", run("timing", "studio", "--minutes", 10, "--out", tmp_path))
    found = {row["what"]: row["value"] for row in facts["studio"]}
    assert found["request to first motion, median of 2"] == pytest.approx(0.3)
    assert found["update after a demonstration, longest of 1"] == pytest.approx(0.1)
    assert [row["value"] for row in facts["studio"] if "2 watching" in row["what"]] == [30.0, 31.0, 1.0]
    assert (found["memory after 1 min under load"], found["memory after 10 min under load"]) == (150.0, 151.0)


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["core", "--turns", 0], "turns: expected at least 1, found 0."),
        (["env", "--envs", 0], "envs: expected at least 1, found 0."),
        (["throughput", "--batches", 9, 0], "batches: expected at least 1, found 9 0."),
        (["throughput", "--threads", -1], "threads: expected at least 0, found -1."),
        (["throughput", "--parts-of", 0], "parts_of: expected at least 1, found 0."),
        (["throughput", "--turns", 0], "turns: expected at least 1, found 0."),
        (["throughput", "--seconds", 0.5], "seconds: expected 1 to 10, found 0.5."),
        (["throughput", "--seconds", "nan"], "seconds: expected 1 to 10, found nan."),
        (["studio", "--answers", 0], "answers: expected at least 1, found 0."),
    ],
)
def test_bad_input_is_told_in_one_sentence_and_nothing_is_written(
    run: Any, tmp_path: Path, arguments: list[object], complaint: str
) -> None:
    assert run.refusal("timing", *arguments, "--out", tmp_path / "out") == f"timing: {complaint}\n"
    assert not list(tmp_path.iterdir())
