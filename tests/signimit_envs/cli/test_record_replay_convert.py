"""record, replay and convert: they write what they say, and refuse in one sentence."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import signimit as si
from signimit_envs.cli import main
from signimit_envs.recording import load_recording, save_recording
from signimit_envs.recording.episodes import Recording

pytest.importorskip("tyro", reason="commands need signimit[scripts]")


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a recording of nine requests, made by the command itself."""
    path = tmp_path_factory.mktemp("recorded") / "r.npz"
    main(["record", "--seconds", "1", "--out", str(path)])
    return path


def test_what_is_recorded_replays_bit_for_bit_and_is_not_replaced(run: Any, recorded: Path) -> None:
    assert len(load_recording(recorded)) == 9
    assert "9 episodes, 450 control steps: every state is as recorded, bit for bit." in run("replay", recorded)
    assert "overwrite" in run.refusal("record", "--seconds", 1, "--out", recorded)


def test_a_recording_that_was_tampered_with_names_the_first_step(run: Any, recorded: Path, tmp_path: Path) -> None:
    with np.load(recorded) as archive:
        arrays = dict(archive)
    arrays["controls"][2 * 50 + 17, 0] += 1e-6
    np.savez(tmp_path / "t.npz", **arrays)
    said = run.refusal("replay", tmp_path / "t.npz")
    assert "episode 2, step 17: expected the recorded state, bit for bit, found a difference of" in said


def test_the_state_is_observed_from_the_recording_alone(run: Any, recorded: Path, tmp_path: Path) -> None:
    out = tmp_path / "state.npz"
    assert "Episode 3, 50 steps, is in" in run("replay", recorded, "--episode", 3, "--out", out)
    with np.load(out) as state:
        np.testing.assert_array_equal(state["hand"], load_recording(recorded)[3].observations["hand"])
    assert "overwrite" in run.refusal("replay", recorded, "--out", out)
    run("replay", recorded, "--out", out, "--overwrite")


def test_pixels_of_any_camera_and_size_are_written(run: Any, recorded: Path, tmp_path: Path) -> None:
    short = tmp_path / "short.npz"
    save_recording(short, load_recording(recorded)[:1])
    seen = {}
    for camera in ("top", "perspective"):
        out = tmp_path / f"{camera}.npz"
        options = ["--observe", "pixels", "--camera", camera, "--size", 48, 32, "--out", out]
        try:
            run("replay", short, *options)
        except SystemExit:
            pytest.skip("there is no OpenGL here")
        with np.load(out) as file:
            seen[camera] = file["pixels"]
    assert seen["top"].shape == seen["perspective"].shape == (51, 32, 48, 3)
    assert (seen["top"] != seen["perspective"]).mean() > 0.2
    run("replay", short, "--observe", "pixels", "--size", 48, 32, "--out", tmp_path / "a.mp4")
    assert (tmp_path / "a.mp4").stat().st_size > 500


def test_a_recording_of_another_mujoco_gets_a_note_and_still_plays(run: Any, recorded: Path, tmp_path: Path) -> None:
    recording = load_recording(recorded)[:1]
    old = type(recording.origin)(**{**vars(recording.origin), "mujoco_version": "3.2.1"})
    save_recording(tmp_path / "old.npz", Recording(old, recording.episodes))
    said = run("replay", tmp_path / "old.npz", "--out", tmp_path / "state.npz")
    assert "note: Recorded with MuJoCo 3.2.1, this is" in said
    assert (tmp_path / "state.npz").exists()


def test_data_go_to_csv_and_back_to_the_same_bytes(
    run: Any, demonstrations: Path, recorded: Path, tmp_path: Path
) -> None:
    for source in (demonstrations / "demonstrations.npz", recorded):
        tables, again = tmp_path / f"{source.stem}-tables", tmp_path / f"again-{source.name}"
        assert "(csv)" in run("convert", source, tables, "--to", "csv")
        run("convert", tables, again)
        assert again.read_bytes() == source.read_bytes()
    assert "every state is as recorded" in run("replay", tmp_path / "r-tables")


def test_for_lerobot_nothing_is_filmed_that_was_not_asked_for(
    run: Any, recorded: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("pyarrow", reason="LeRobot needs signimit[lerobot]")

    def film(*_: object) -> None:
        raise AssertionError("nobody asked for a film")

    monkeypatch.setattr("signimit_envs.recording.formats.lerobot.recordings.film_states", film)
    assert run("convert", recorded, tmp_path / "plain", "--to", "lerobot").count("\n") == 1
    assert not list(tmp_path.rglob("*.mp4"))


def test_cameras_are_for_lerobot_only(run: Any, recorded: Path, tmp_path: Path) -> None:
    said = run.refusal("convert", recorded, tmp_path / "tables", "--to", "csv", "--cameras", "top")
    assert "--cameras: expected recorded episodes, and --to lerobot, found Recording(" in said
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("name", "arguments", "complaint"),
    [
        ("replay", ["none.npz"], "none.npz: No such file"),
        ("replay", [__file__], "expected a signimit recording file"),
        ("replay", ["d.npz"], "expected recorded episodes, found demonstrations, which hold no physics"),
        ("convert", ["d.npz", "tables"], "tables: expected a name that says its format, or --to, found neither"),
        ("convert", ["d.npz", "d.npz"], "d.npz: expected nothing of that name yet"),
        ("convert", ["none", "e.npz"], "none: No such file"),
        (
            "convert",
            ["d.npz", "e.npz", "--to", "csv"],
            "e.npz: expected a name that does not end in .npz for",
        ),
        ("convert", ["d.npz", "e", "--to", "npz"], "e: expected a name that ends in .npz for the format npz"),
        ("record", ["--seconds", 0], "seconds: expected 1 to 600"),
        ("record", ["--out", "r.csv"], "r.csv: expected a name that ends in .npz, found '.csv'"),
        ("replay", ["none.npz", "--out", "s.csv"], "s.csv: expected a name that ends in .npz, found '.csv'"),
    ],
)
def test_bad_input_gets_one_sentence_and_leaves_no_file(
    run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, arguments: list[object], complaint: str
) -> None:
    monkeypatch.chdir(tmp_path)
    times = np.arange(3.0)
    path = np.column_stack([times, times])
    si.DemonstrationSet([si.Demonstration((path,), path[:1], path, times)]).save("d.npz")
    assert complaint in run.refusal(name, *arguments)
    assert [file.name for file in tmp_path.iterdir()] == ["d.npz"]
