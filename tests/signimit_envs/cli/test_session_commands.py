"""The commands that make demonstrations, learn and reproduce: they write what they say, and refuse in one sentence."""

from __future__ import annotations

import json
import shlex
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import signimit as si

pytest.importorskip("tyro", reason="commands need signimit[scripts]")
pytest.importorskip("tqdm", reason="commands need signimit[scripts]")
pytest.importorskip("matplotlib", reason="figures need signimit[scripts]")


def test_demonstrations_that_are_made_can_be_learned_from(run: Any, demonstrations: Path, tmp_path: Path) -> None:
    arguments = [demonstrations / "demonstrations.npz", "--prototypes", demonstrations / "prototypes.npz"]
    said = run("learn", *arguments, "--out", tmp_path / "m.npz")
    model = si.ImitationModel.load(tmp_path / "m.npz")
    assert model.summary() in said
    truth = json.loads((demonstrations / "truth.json").read_text())["demonstrations"]
    assert len(truth) == len(si.DemonstrationSet.load(demonstrations / "demonstrations.npz")) == 12


def test_the_next_command_that_is_recommended_is_that_of_the_readme_and_runs(
    run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    program, *words = shlex.split(run("make-demonstrations").splitlines()[-1])
    assert [program, *words[:2]] == ["python", "-m", "signimit"]
    run(*words[2:])
    assert {"model.npz", "why.png"} <= {file.name for file in tmp_path.iterdir()}
    readme = Path(__file__).parents[3] / "README.md"
    assert not readme.is_file() or shlex.join(words[2:]) in readme.read_text(encoding="utf-8")


@pytest.mark.slow
def test_reproduce_writes_results_and_figures_also_where_there_is_no_opengl(
    run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MUJOCO_GL", "off")
    out = tmp_path / "out"
    said = run("reproduce", "--out", out, "--attempts", 1, "--seconds", 1)
    assert "12 demonstrations show " in said
    assert "paper, knn                       joint, path-following" in said
    assert said.count("No videos. Cannot render: MUJOCO_GL=off turns OpenGL off. Without MUJOCO_GL") == 1
    pictures = [*(f"figure{n}.png" for n in (4, 5, 6)), "figure7-ours.png", "figure7.png", "memberships.png"]
    assert sorted(p.name for p in out.iterdir()) == [*pictures, "results.json", "why.png"]
    results = json.loads((out / "results.json").read_text())
    assert results["plan"]["seed"] == 0
    assert [len(said["reproductions"]) for said in results["imitators"].values()] == [9, 9]


@pytest.mark.slow
def test_render_says_what_was_understood_and_films_it(
    run: Any, demonstrations: Path, model: Path, tmp_path: Path
) -> None:
    video, signs = tmp_path / "answer.mp4", demonstrations / "signs.npz"
    scene = ["--objects", -0.2, 0.1, 0.1, 0.1, 0, -0.1, "--hand", 0.1, -0.15]
    try:
        said = run("render", model, "--signs", signs, "--words", 1, 6, *scene, "--seconds", 1, "--out", video)
    except SystemExit:
        pytest.skip("there is no OpenGL here")
    assert "Understood: movement " in said
    assert video.stat().st_size > 1000
    complaint = run.refusal("render", model, "--signs", signs, "--words", 1, "--out", tmp_path / "no.mp4")
    assert "signs: expected 2 as in the demonstrations, found 1" in complaint
    assert not (tmp_path / "no.mp4").exists()


def test_demonstrations_with_noise_are_other_ones(run: Any, demonstrations: Path, tmp_path: Path) -> None:
    run("make-demonstrations", "--noise", 0.18, "--out", tmp_path / "noisy")
    plain, noisy = (
        si.DemonstrationSet.load(folder / "demonstrations.npz") for folder in (demonstrations, tmp_path / "noisy")
    )
    assert not np.array_equal(plain[0].signs[0], noisy[0].signs[0])


def test_sessions_counts_over_several_sessions(run: Any, tmp_path: Path) -> None:
    said = run("sessions", "--sessions", 1, "--seconds", 1, "--out", tmp_path)
    assert "all inferences right" in said
    assert json.loads((tmp_path / "sessions.json").read_text())["shares"]["obeyed"]["total"] == 9


@pytest.mark.parametrize(
    ("name", "arguments", "complaint"),
    [
        ("learn", ["none.npz"], "none.npz: No such file"),
        ("learn", [__file__], "expected a signimit demonstration set file"),
        ("reproduce", ["--method", "guess"], "Unknown method 'guess'"),
        ("reproduce", ["--no-video", "--seed", -1], "seed: expected zero or more"),
        ("reproduce", ["--signs", "none.npz"], "none.npz: No such file"),
        ("reproduce", ["--signer", "me"], "a stroke library to find them in"),
        ("make-demonstrations", ["--movements", __file__], "expected a signimit stroke library file"),
        ("make-demonstrations", ["--noise", -1], "noise: expected zero or more, found -1.0"),
        ("make-demonstrations", ["--noise", "nan"], "noise: expected zero or more, found nan"),
        ("learn", ["none.npz", "--out", "m.txt"], "m.txt: expected a name that ends in .npz, found '.txt'"),
        ("learn", ["none.npz", "--why", "why"], "why: expected a name that ends in .png or"),
        ("sessions", ["--sessions", 0], "sessions: expected at least 1"),
        ("render", ["none.npz", "--signs", "none.npz", "--words", "1", "4"], "none.npz: No such file"),
    ],
)
def test_bad_input_gets_one_sentence_and_leaves_no_file(
    run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, arguments: list[object], complaint: str
) -> None:
    monkeypatch.chdir(tmp_path)
    assert complaint in run.refusal(name, *arguments)
    assert list(tmp_path.iterdir()) == []


def test_a_hand_that_never_moves_is_refused_by_name(run: Any, demonstrations: Path, tmp_path: Path) -> None:
    with np.load(demonstrations / "demonstrations.npz") as archive:
        arrays = dict(archive)
    cut = arrays["hand_offsets"]
    arrays["hand"][cut[3] : cut[4]] = 0.1
    np.savez(tmp_path / "resting.npz", **arrays)
    said = run.refusal("learn", tmp_path / "resting.npz")
    assert "resting.npz: demonstration 3: hand" in said
