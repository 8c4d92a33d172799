"""Small valid files of every kind, written by the project itself: what mutated files are made from.

Each function writes into an empty folder and returns the paths that a loader is given.
"""

from __future__ import annotations

import io
import os
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from signimit import Demonstration, DemonstrationSet, Stroke, StrokeLibrary, learn, make_policy
from signimit.benchmark.entries import refer_to
from signimit.benchmark.results import ResultFile, write_summary
from signimit.benchmark.running import code_hash
from signimit.io.archive import write_archive
from signimit.io.formats import write_csv_demonstrations, write_inkml
from signimit.policies import POLICY_KINDS
from signimit_envs.recording import EpisodeRecorder, Recording, save_recording
from signimit_envs.recording.formats import write_data

ENTRY = "chance"  # of the benchmark, for results
MINARI_ROOT = "MINARI_DATASETS_PATH"
_UNIPEN = """.HIERARCHY DIGIT
.SEGMENT DIGIT 30 ? "6"
.COMMENT 6 13   38
.PEN_DOWN
 238  326
 239  328
.PEN_UP
.SEGMENT DIGIT 112-113 ? "7"
.COMMENT 7 13  187
.PEN_DOWN
 0  0
 10 0
.PEN_UP
.PEN_DOWN
 10 20
 20 20
.PEN_UP
"""
_DOLLAR = """<?xml version="1.0" encoding="utf-8" standalone="yes"?>
<Gesture Name="circle03" Subject="2" Speed="slow" Number="3" NumPts="3" Millseconds="15">
  <Point X="102" Y="162" T="10128229" />
  <Point X="98" Y="161" T="10128234" />
  <Point X="96" Y="160" T="10128244" />
</Gesture>
"""
_INKML = """<?xml version="1.0"?>
<ink xmlns="http://www.w3.org/2003/InkML">
  <definitions><context xml:id="c"><inkSource xml:id="s"><traceFormat>
    <channel name="X" type="decimal"/><channel name="Y" type="decimal" orientation="-ve"/>
    <channel name="T" type="integer" units="ms"/></traceFormat></inkSource></context></definitions>
  <traceGroup><annotation type="label">a</annotation><annotation type="writer">ann</annotation>
    <trace contextRef="#c" id="t1">0 0 0, 3 4 10, 6 4 20</trace>
    <trace contextRef="#c" id="t2">9 4 40, '1 '1 '10, "1 "1 "0, 12 9 80</trace></traceGroup>
  <trace contextRef="#c">1 1 100, 2 2 110</trace>
</ink>
"""


@lru_cache(maxsize=1)
def small_demonstrations() -> DemonstrationSet:
    """Return four demonstrations: a circle or a line about one of two objects, two signs each."""
    rng, made = np.random.default_rng(7), []
    phase = np.linspace(0, 2 * np.pi, 24)
    circle = 0.08 * np.column_stack([np.cos(phase), np.sin(phase)])
    line = np.column_stack([np.linspace(-0.1, 0.1, 24), np.zeros(24)])
    strokes = [np.array([[0.0, 0], [1, 2], [2, 0]]), np.array([[0.0, 0], [2, 0], [2, 2], [0, 2]])]
    for movement, focus in ((0, 0), (0, 1), (1, 0), (1, 1)):
        objects = np.array([[-0.2, 0.1], [0.2, -0.1]]) + rng.normal(0, 0.01, (2, 2))
        hand = objects[focus] + (circle, line)[movement] + rng.normal(0, 0.001, (24, 2))
        signs = tuple(strokes[word] + rng.normal(0, 0.05, strokes[word].shape) for word in (focus, movement))
        made.append(Demonstration(signs, objects, hand, np.linspace(0.0, 0.92, 24)))
    return DemonstrationSet(made)


def small_library() -> StrokeLibrary:
    """Return a library of four strokes by two writers."""
    strokes = [sign for one in small_demonstrations()[:2] for sign in one.signs]
    drawn = tuple(Stroke(points, np.linspace(0.0, 0.1, len(points))) for points in strokes)
    return StrokeLibrary(drawn, ("1", "6", "é", "6"), ("ann", "ann", "bo", "bo"), "synthetic")


@lru_cache(maxsize=1)
def small_recording() -> Recording:
    """Return two recorded episodes of a few control steps, with an image of one pixel as the table's wood."""
    with closing(EpisodeRecorder(gym.make("signimit_envs:signimit/TabletopHand-v0", objects=2))) as env:
        for seed, steps in ((5, 3), (None, 2)):
            env.reset(seed=seed)
            for _ in range(steps):
                env.step(np.array([0.2, -0.1], dtype=np.float32))
        origin, episodes = env.recording.origin, env.recording.episodes
    pixel = io.BytesIO()
    Image.new("RGB", (1, 1)).save(pixel, "PNG")
    return Recording(replace(origin, assets=dict.fromkeys(origin.assets, pixel.getvalue())), episodes)


def write_strokes(folder: Path) -> Iterator[Path]:
    """Write a stroke library."""
    small_library().save(folder / "strokes.npz")
    yield folder / "strokes.npz"


def write_demonstrations(folder: Path) -> Iterator[Path]:
    """Write a demonstration set."""
    small_demonstrations().save(folder / "demonstrations.npz")
    yield folder / "demonstrations.npz"


def write_policies(folder: Path) -> Iterator[Path]:
    """Write policies of all kinds, of a closed and an open movement, and one of version 1."""
    demos = small_demonstrations()
    for name, members in (("round", (0, 1)), ("line", (2, 3))):
        paths = [demos[t].hand - demos[t].objects[t % 2] for t in members]
        for kind in POLICY_KINDS:
            policy = make_policy(paths, [demos[t].times for t in members], kind=kind)
            policy.save(folder / f"{kind}-{name}.npz")
            yield folder / f"{kind}-{name}.npz"
    numbers = {"closed": 1.0, "scale": 0.06, "reach_speed": 0.3}
    arrays: dict[str, NDArray[np.float64]] = {"course": paths[0], **{k: np.array(v) for k, v in numbers.items()}}
    write_archive(folder / "version-1.npz", "policy", 1, arrays, {"policy": "path-following"})
    yield folder / "version-1.npz"


def write_models(folder: Path) -> Iterator[Path]:
    """Write a model of each learner."""
    demos, library = small_demonstrations(), small_library()
    for method, policy in (("joint", "path-following"), ("paper", "knn")):
        learn(demos, library.strokes[:3], method, policy).save(folder / f"{method}.npz")
        yield folder / f"{method}.npz"


def write_recording(folder: Path) -> Iterator[Path]:
    """Write a recording as one file."""
    save_recording(folder / "recording.npz", small_recording())
    yield folder / "recording.npz"


def write_csv_folder(folder: Path) -> Iterator[Path]:
    """Write demonstrations as tables."""
    write_csv_demonstrations(folder / "csv", small_demonstrations()[:2])
    yield folder / "csv"


def write_csv_recording_folder(folder: Path) -> Iterator[Path]:
    """Write a recording as tables."""
    write_data(folder / "csv", small_recording(), "csv")
    yield folder / "csv"


def write_lerobot_folder(folder: Path) -> Iterator[Path]:
    """Write demonstrations as a LeRobot data set."""
    write_data(folder / "lerobot", small_demonstrations()[:2], "lerobot")
    yield folder / "lerobot"


def write_lerobot_recording_folder(folder: Path) -> Iterator[Path]:
    """Write a recording as a LeRobot data set, without videos."""
    from signimit_envs.recording.formats.lerobot.recordings import write_lerobot_recording

    write_lerobot_recording(folder / "lerobot", small_recording(), cameras=())
    yield folder / "lerobot"


def write_minari_folder(folder: Path) -> Iterator[Path]:
    """Write demonstrations as a Minari data set."""
    with minari_root(folder):
        write_data("signimit/fuzzed-v0", small_demonstrations()[:2], "minari")
    yield folder / "signimit" / "fuzzed-v0"


def write_minari_recording_folder(folder: Path) -> Iterator[Path]:
    """Write a recording as a Minari data set."""
    with minari_root(folder):
        write_data("signimit/fuzzed-v0", small_recording(), "minari")
    yield folder / "signimit" / "fuzzed-v0"


@contextmanager
def minari_root(folder: Path) -> Iterator[None]:
    """Let Minari's folder be another one."""
    before = os.environ.get(MINARI_ROOT)
    os.environ[MINARI_ROOT] = str(folder)
    try:
        yield
    finally:
        os.environ.pop(MINARI_ROOT)
        if before is not None:
            os.environ[MINARI_ROOT] = before


def write_inkml_files(folder: Path) -> Iterator[Path]:
    """Write InkML as we write it, and as others do."""
    write_inkml(folder / "ours.inkml", small_library())
    (folder / "theirs.inkml").write_text(_INKML, encoding="utf-8")
    yield folder / "ours.inkml"
    yield folder / "theirs.inkml"


def write_unipen_file(folder: Path) -> Iterator[Path]:
    """Write UNIPEN text."""
    (folder / "digits.dat").write_text(_UNIPEN, encoding="utf-8")
    yield folder / "digits.dat"


def write_dollar_file(folder: Path) -> Iterator[Path]:
    """Write a log of the $1 recogniser."""
    (folder / "circle03.xml").write_text(_DOLLAR, encoding="utf-8")
    yield folder / "circle03.xml"


def write_stroke_files(folder: Path) -> Iterator[Path]:
    """Write strokes in all formats, and a folder of them."""
    for write in (write_inkml_files, write_unipen_file, write_dollar_file, write_strokes):
        yield from write(folder)
    (folder / "all").mkdir()
    for write in (write_unipen_file, write_dollar_file, write_strokes):
        list(write(folder / "all"))
    yield folder / "all"


def write_results(folder: Path) -> Iterator[Path]:
    """Write results of the benchmark: records and a summary."""
    file = ResultFile(folder / "results", refer_to(ENTRY))
    for record in (file.header, *(result_record(split, seed) for split in ("paper", "noisy") for seed in (0, 1))):
        file.append(record)
    write_summary(file)
    yield folder / "results"


def result_record(split: str, seed: int) -> dict[str, object]:
    """Return the record of a session as a benchmark's entry makes it."""
    stages = {"groups": 1.0, "focus": 0.5, "order": 1.0, "read": [2, 1], "obeyed": [1, 0], "misfit": [0.1, 3.0]}
    facts = {"split": split, "seed": seed, "session": "0" * 64, "code": code_hash(), "demonstrations": 12}
    return {**facts, **stages, "families": [0, 0], "seconds": {"compose": 0.1, "observe": 0.2, "act": 0.3}}
