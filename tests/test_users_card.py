"""What the user asked for, on the physics. No change to the project may weaken this file.

A MuJoCo tabletop scene (MJCF) with three coloured objects and a planar arm, wrapped as a Gymnasium environment; the
learning core supplies a k-NN hand-direction policy after observing 12 demonstrations; mink differential IK turns it
into joint commands; the hand circles the right object; a frame of a film is drawn offscreen.
"""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from importlib import resources
from pathlib import Path
from typing import Any

import gymnasium as gym
import imageio_ffmpeg
import mink
import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray

import signimit as si
import signimit_assets
import signimit_envs
from signimit.teaching.stroke_sampler import StrokeSampler

PEOPLE = np.random.SeedSequence(20110)  # who signs and who moves, chosen by nobody
SECONDS = 12.0  # a whole episode
CIRCLE = si.PAPER_LANGUAGE.movements.index("circle")


@pytest.fixture(scope="module")
def people() -> tuple[StrokeSampler, StrokeSampler]:
    """One person's signs and another's movements, all synthetic; no stroke comes twice while there are unused ones."""
    language = si.PAPER_LANGUAGE
    words = (*language.focus_signs, *language.movement_signs)
    signer, mover = (np.random.default_rng(s) for s in PEOPLE.spawn(2))
    signs = si.synthetic_library(words, samples=16, rng=signer)
    movements = si.synthetic_library(language.movements, samples=16, rng=mover)
    return StrokeSampler(signs), StrokeSampler(movements)


@pytest.fixture(scope="module")
def lesson(people: tuple[StrokeSampler, StrokeSampler]) -> tuple[si.DemonstrationSet, si.GroundTruth]:
    return si.compose_demonstrations(si.PAPER_LANGUAGE, *people, np.random.default_rng(0))


@pytest.fixture(scope="module")
def model(lesson: tuple[si.DemonstrationSet, si.GroundTruth]) -> si.ImitationModel:
    """An imitator that saw the demonstrations and nothing else."""
    return si.learn(lesson[0], policy="knn")


@pytest.fixture
def env() -> Iterator[gym.Env[dict[str, NDArray[np.float64]], NDArray[np.float32]]]:
    made = gym.make("signimit_envs:signimit/TabletopHand-v0")
    yield made
    made.close()


def revolutions(path: NDArray[np.float64], place: NDArray[np.float64]) -> float:
    """Signed revolutions of a path, shape (T, 2), about a place, counter-clockwise positive."""
    x, y = (path - place).T
    return float(np.diff(np.unwrap(np.arctan2(y, x))).sum() / (2 * np.pi))


def test_the_scene_is_an_mjcf_file_with_three_coloured_objects_and_a_planar_arm() -> None:
    with resources.as_file(resources.files(signimit_assets)) as folder:
        model = mujoco.MjModel.from_xml_path(str(folder / "tabletop.xml"))
    colours = {name: model.material(name).rgba[:3] for name in ("red", "green", "blue")}
    assert [int(np.argmax(colours[name])) for name in ("red", "green", "blue")] == [0, 1, 2]
    for number, name in enumerate(("red", "green", "blue")):
        body = model.body(f"object_{number}")
        materials = {
            model.material(int(model.geom_matid[g])).name
            for g in range(body.geomadr[0], body.geomadr[0] + body.geomnum[0])
        }
        assert name in materials
    assert model.njnt == 3
    np.testing.assert_array_equal(model.jnt_axis, [[0, 0, 1]] * 3)
    assert set(model.jnt_type.tolist()) == {int(mujoco.mjtJoint.mjJNT_HINGE)}


@pytest.mark.parametrize("env_id", ["signimit/Tabletop-v0", "signimit/TabletopHand-v0"])
def test_gymnasium_makes_and_steps_the_environment(env_id: str) -> None:
    made = gym.make(f"signimit_envs:{env_id}")
    observation, _ = made.reset(seed=1)
    assert made.observation_space.contains(observation)
    for _ in range(5):
        observation, reward, terminated, truncated, info = made.step(made.action_space.sample())
    assert made.observation_space.contains(observation)
    assert {"hand", "objects", "signs", "joints"} <= set(observation)
    assert np.isfinite(float(reward))
    assert not terminated
    assert not truncated
    assert "is_success" in info
    made.close()


def test_from_twelve_unlabelled_demonstrations_the_imitator_finds_everything(
    lesson: tuple[si.DemonstrationSet, si.GroundTruth], model: si.ImitationModel
) -> None:
    demonstrations, truth = lesson
    assert len(demonstrations) == 12
    assert len(model.movements) == 3
    for movement in model.movements:  # who shows the same is together
        assert len({int(truth.movement[t]) for t in movement.members}) == 1
    np.testing.assert_array_equal(model.focus, truth.focus)
    assert model.word_order == si.WordOrder(focus=0, movement=1)


@pytest.mark.parametrize("focus", [0, 1, 2])
def test_the_hand_circles_the_right_object_by_the_50_nearest_points_through_mink(
    focus: int,
    people: tuple[StrokeSampler, StrokeSampler],
    lesson: tuple[si.DemonstrationSet, si.GroundTruth],
    model: si.ImitationModel,
    env: gym.Env[dict[str, NDArray[np.float64]], NDArray[np.float32]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Asked with signs it never saw, the arm's hand winds around that object and no other, in the shown sense."""
    solved: list[int] = []
    solve_ik = mink.solve_ik

    def counted(*arguments: Any, **named: Any) -> Any:
        solved.append(1)
        return solve_ik(*arguments, **named)

    monkeypatch.setattr(mink, "solve_ik", counted)
    rng = np.random.default_rng(focus)
    language = si.PAPER_LANGUAGE
    labels = language.focus_signs[focus], language.movement_signs[CIRCLE]
    utterance = [people[0].draw(label, rng).points for label in labels]
    objects = np.array([[-0.22, 0.05], [0.02, 0.16], [0.21, -0.08]])[rng.permutation(3)]
    observation, _ = env.reset(seed=focus, options={"objects": objects, "hand": [0.0, -0.15]})
    response = model.respond(utterance, observation["objects"])
    assert response.focus == focus

    before = len(solved)
    path, speed = [observation["hand"]], env.unwrapped.max_hand_speed  # type: ignore[attr-defined]
    for _ in range(round(SECONDS * signimit_envs.CONTROL_RATE)):
        velocity = response.policy(observation["hand"])
        observation, *_ = env.step((velocity / speed).astype(np.float32))
        path.append(observation["hand"])
    assert len(solved) - before == len(path) - 1, "every step is solved by mink"

    drawn = np.array(path[len(path) // 2 :])  # from afar 50 neighbours disagree: the way there takes its time
    shown = np.mean([revolutions(loop, np.zeros(2)) for loop in lesson[1].templates[CIRCLE]])
    turns = np.array([revolutions(drawn, place) for place in objects])
    assert abs(revolutions(np.array(path), objects[focus])) >= 2.0
    assert np.sign(turns[focus]) == np.sign(shown)
    assert np.abs(np.delete(turns, focus)).max() < 0.75
    away = np.hypot(*(drawn - objects[focus]).T)
    assert 0.06 < away.min() < away.max() < 0.16, "a circle of about the size that was shown, m"


def test_a_film_of_the_scene_is_drawn_without_a_display(tmp_path: Path) -> None:
    """Through EGL or OSMesa; skipped where there is neither."""
    made = gym.make("signimit_envs:signimit/TabletopHand-v0", render_mode="rgb_array")
    try:
        made.reset(seed=0)
        made.render()
    except signimit_envs.RenderingError as reason:
        made.close()
        pytest.skip(str(reason))
    film = signimit_envs.RecordMp4(made, tmp_path)
    film.reset(seed=0)
    for _ in range(10):
        film.step(np.array([0.3, 0.1], np.float32))
    film.close()
    (file,) = tmp_path.glob("*.mp4")
    decode = [imageio_ffmpeg.get_ffmpeg_exe(), "-i", str(file), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    frames = np.frombuffer(subprocess.run(decode, capture_output=True, check=True).stdout, np.uint8)
    frames = frames.reshape(-1, 480, 480, 3)
    assert len(frames) == 11
    frame = frames[-1].astype(int)
    for channel in range(3):  # something red, something green, something blue
        others = np.delete(frame, channel, axis=2).max(axis=2)
        assert (frame[..., channel] - others > 40).sum() > 20
