"""Deep copies and pickles of whatever holds an environment or MuJoCo's memory go on as the original does."""

from __future__ import annotations

import ast
import copy
import pickle
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import MethodType
from typing import Any, NamedTuple

import gymnasium as gym
import imageio_ffmpeg
import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray

import signimit_envs
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit_envs import RecordMp4, RenderingError, TabletopEnv, TabletopHandEnv
from signimit_envs.arm.arm import Arm
from signimit_envs.arm.batch.inverse_kinematics import ManyHandsController
from signimit_envs.arm.batch.physics import ManyArms, compile_arm
from signimit_envs.arm.inverse_kinematics import HandController
from signimit_envs.arm.scene import compile_scene
from signimit_envs.recording import EpisodeRecorder
from signimit_envs.recording.episodes import episode_arrays
from signimit_envs.tabletop.observations import CameraView, PixelObserver, StateObserver, StatePixelObserver
from signimit_envs.tabletop.reset_options import EpisodeStart
from signimit_envs.video.backend import choose_backend
from signimit_envs.video.films import film_shots
from signimit_envs.video.rendering import OffscreenView
from signimit_envs.video.scene_renderer import SceneRenderer
from signimit_envs.video.storyboard import Shot

PICTURE = (32, 32)  # pixels
START = {"movement": 0, "focus": 1, "objects": [[-0.15, 0.1], [0.02, -0.1], [0.18, 0.08]], "hand": [0.1, 0.0]}


class Case(NamedTuple):
    """Something that is copied.

    Attributes:
        make: Makes it; it has a life behind it already.
        live: Lets it live on, and returns all that can be seen of it.
    """

    make: Callable[[], Any]
    live: Callable[[Any], Any]


def live_in(env: Any, steps: int = 12) -> list[Any]:
    """Step an environment, into a second episode."""
    seen: list[Any] = [env.step(env.action_space.sample()) for _ in range(steps)]
    seen += [env.reset(), env.step(env.action_space.sample()), env.render() if env.render_mode else None]
    return seen


def environment(wrap: Callable[[Any], Any] = lambda env: env, **options: Any) -> Case:
    def make() -> Any:
        env = wrap(gym.make("signimit/Tabletop-v0", size=PICTURE, **options))
        env.action_space.seed(1)
        env.reset(seed=2)
        live_in(env)
        return env

    return Case(make, live_in)


def lived(arm: Arm) -> Arm:
    arm.place(np.array(START["objects"]), np.array([0.3, 1.0, 0.4]))
    move(arm)
    return arm


def move(arm: Arm) -> list[Any]:
    return [(arm.track(np.array([2.0, -1.0, 0.5]) * np.cos(k)), arm.measure(), arm.hand.copy()) for k in range(20)]


def simulate(arms: ManyArms) -> list[Any]:
    return [(*arms.simulate(np.cos(np.arange(12.0).reshape(3, 4) + k)), arms.joints) for k in range(20)]


def solve(controller: HandController) -> list[Any]:
    posture = controller.posture_at(np.array([0.1, 0.05]))
    return [posture, controller.solve(posture[0], np.array([0.01, -0.02]), 0.02)]


def solve_many(controller: ManyHandsController) -> list[Any]:
    postures = controller.postures_at(np.array([[0.1, 0.2], [0.0, 0.1]]))
    return [postures, controller.solve(postures[0], np.full((2, 2), 0.01), 0.02)]


def used(thing: Any, use: Callable[[Any], object]) -> Any:
    use(thing)
    return thing


def shot(number: int) -> Shot:
    return Shot(phase="D", caption="", objects=np.array(START["objects"]), joints=np.array([0.1 * number, 1.0, 0.5]))


def picture(view: OffscreenView) -> NDArray[np.uint8]:
    model = compile_scene()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return view.frame(data, "top")


def observe(observer: StateObserver | PixelObserver | StatePixelObserver) -> Any:
    return observer.observe()


def observing(kind: Callable[..., Any]) -> Callable[[], Any]:
    def make() -> Any:
        observer = kind(lived(Arm(compile_scene())), 2, CameraView("top", 48, 48))
        signs = np.random.default_rng(0).uniform(-1, 1, (2, 64, 2))
        observer.start(EpisodeStart(PAPER_LANGUAGE.requests[0], np.zeros((3, 2)), np.zeros(2), signs))
        return used(observer, observe)

    return make


def record(recorder: EpisodeRecorder) -> list[Any]:
    seen = live_in(recorder)
    return [*seen, [episode_arrays(episode) for episode in recorder.recording]]


BLIND = {
    "Arm": Case(lambda: lived(Arm(compile_scene())), move),
    "HandController": Case(lambda: used(HandController(compile_scene()), solve), solve),
    "ManyArms": Case(lambda: used(ManyArms(compile_arm(), np.full((3, 4), 0.5)), simulate), simulate),
    "ManyHandsController": Case(lambda: ManyHandsController(compile_arm()), solve_many),
    "StateObserver": Case(observing(StateObserver), observe),
    "TabletopEnv": environment(),
    "TabletopEnv, hand": environment(control="hand", reward="dense", objects=5),
    "Autoreset": environment(gym.wrappers.Autoreset, max_episode_steps=9),
    "RecordEpisodeStatistics": environment(gym.wrappers.RecordEpisodeStatistics),
    "NormalizeReward": environment(gym.wrappers.NormalizeReward),
    "EpisodeRecorder": environment(EpisodeRecorder)._replace(live=record),
    "EpisodeRecorder, Autoreset": environment(
        lambda env: EpisodeRecorder(gym.wrappers.Autoreset(env)), max_episode_steps=9
    )._replace(live=record),
}
DRAWN = {
    "OffscreenView": Case(lambda: used(OffscreenView(compile_scene(), *PICTURE), picture), picture),
    "SceneRenderer": Case(
        lambda: used(SceneRenderer(3, *PICTURE), lambda renderer: renderer.picture(shot(1))),
        lambda renderer: renderer.picture(shot(2)),
    ),
    "Film": Case(lambda: used(film_shots([shot(k) for k in range(4)], 3), lambda film: next(film.frames)),
                 lambda film: list(film.frames)),
    "PixelObserver": Case(observing(PixelObserver), observe),
    "StatePixelObserver": Case(observing(StatePixelObserver), observe),
    "rgb_array": environment(render_mode="rgb_array"),
    "state_pixels": environment(obs_type="state_pixels", render_mode="rgb_array", control="hand"),
    "FrameStackObservation": environment(
        lambda env: gym.wrappers.FrameStackObservation(env, 3), obs_type="pixels", max_episode_steps=9
    ),
    "EpisodeRecorder, pixels": environment(EpisodeRecorder, obs_type="pixels")._replace(live=record),
}  # fmt: skip
COPIES: dict[str, Callable[[Any], Any]] = {"deepcopy": copy.deepcopy, "pickle": lambda x: pickle.loads(pickle.dumps(x))}
UNCOPIED = {  # classes that hold an environment or MuJoCo's memory, and are not copied by themselves
    "LiveArm": "owns a thread, which Python does not copy",
    "Camera": "owns a thread, which Python does not copy",
    "_Owned": "a renderer; copies of the view that has it have none",
    "ExternalForce": "is given model and data",
    "TrainingPlan": "makes environments and keeps none",
    "RecordingOrigin": "compiles models and keeps none",
    "RecordMp4": "test_a_copy_of_a_film_recorder_films_from_its_next_episode_on",
    "WindowView": "in test_window.py",
    "TabletopHandEnv": "a TabletopEnv",
    "JointControl": "within TabletopEnv",
    "HandControl": "within TabletopEnv",
    "PlanarArm": "has arrays of its own",
    "_DrawnFrames": "within Film",
}  # fmt: skip


def needs_opengl() -> None:
    try:
        choose_backend()
    except RenderingError as error:
        pytest.skip(str(error))


@pytest.mark.parametrize("name", [*BLIND, *DRAWN])
def test_a_copy_goes_on_as_the_original_does_to_the_last_bit(name: str) -> None:
    if name in DRAWN:
        needs_opengl()
    case = (BLIND | DRAWN)[name]
    original = case.make()
    twin = copy.deepcopy(original)
    third = pickle.loads(pickle.dumps(twin))
    lives = fingerprint(case.live(twin))
    assert fingerprint(case.live(original)) == lives  # neither moves the other
    assert fingerprint(case.live(third)) == lives
    for thing in (original, twin, third):
        getattr(thing, "close", lambda: None)()


def test_a_copy_of_a_vector_environment_goes_on_as_the_original_does() -> None:
    many = gym.make_vec("signimit/TabletopHand-v0", 2, "sync", max_episode_steps=5)
    many.reset(seed=1)
    many.step(many.action_space.sample())
    twin = copy.deepcopy(many)  # Gymnasium's own functions in it cannot be pickled
    lives = [[fingerprint(env.step(env.action_space.sample())) for _ in range(9)] for env in (twin, many)]
    assert lives[0] == lives[1]
    for env in (many, twin):
        env.close()


def fingerprint(seen: Any) -> Any:
    """Return what was seen, arrays as bytes: equal where every bit is."""
    if isinstance(seen, np.ndarray) and seen.dtype == object:
        return fingerprint(seen.tolist())
    if isinstance(seen, np.ndarray | np.generic):
        return (str(seen.dtype), seen.shape, seen.tobytes())
    if isinstance(seen, Mapping):
        return {name: fingerprint(value) for name, value in seen.items() if name != "episode"}
    if isinstance(seen, list | tuple):
        return [fingerprint(value) for value in seen]
    return repr(seen)


@pytest.mark.parametrize("way", COPIES)
def test_a_copy_in_the_middle_of_an_episode_sees_the_request_fulfilled(way: str) -> None:
    """The path that was judged so far is the copy's own, and goes on with its own hand."""
    env = TabletopHandEnv(reward="dense")
    observation, _ = env.reset(seed=0, options=START)
    drawing = env.people.templates[0][0] + np.array(START["objects"])[1]
    track = np.tile(drawing[:: max(1, len(drawing) // 100)], (5, 1))
    half = len(track) // 8

    def follow(arm: TabletopEnv, hand: Any, places: NDArray[np.float64]) -> tuple[list[float], Any, bool]:
        rewards = []
        for place in places:
            observation, reward, _, _, info = arm.step((place - hand) * 50 / arm.max_hand_speed)
            hand = observation["hand"]
            rewards.append(reward)
        return rewards, hand, info["is_success"]

    _, hand, done = follow(env, observation["hand"], track[:half])
    assert not done
    twin = COPIES[way](env)
    ours, theirs = follow(env, hand, track[half:]), follow(twin, hand, track[half:])
    assert fingerprint(ours) == fingerprint(theirs)
    assert ours[2]


@pytest.mark.parametrize("way", COPIES)
def test_a_copy_of_a_film_recorder_films_from_its_next_episode_on(way: str, tmp_path: Path) -> None:
    """The file that is being written stays with the original."""
    needs_opengl()
    env = RecordMp4(gym.make("signimit/Tabletop-v0", render_mode="rgb_array", size=PICTURE), tmp_path)
    env.reset(seed=0)
    env.action_space.seed(0)
    env.step(env.action_space.sample())
    twin = COPIES[way](env)
    assert fingerprint(live_in(twin, 3)) == fingerprint(live_in(env, 3))
    twin.close()
    env.close()
    lengths = {file.name: imageio_ffmpeg.count_frames_and_secs(file)[0] for file in tmp_path.iterdir()}
    # the first episode with two frames before the copy, then the second of the copy, then the original's
    assert lengths == {"episode-0000.mp4": 5, "episode-0001.mp4": 2, "episode-0002.mp4": 2}


@pytest.mark.parametrize("way", COPIES)
@pytest.mark.parametrize("name", BLIND)
def test_what_shares_memory_does_so_in_a_copy(name: str, way: str) -> None:
    """A view that is an attribute follows the copy's memory, as it follows the original's."""
    original = BLIND[name].make()
    twin = COPIES[way](original)
    ours, theirs = dict(arrays_of(original)), dict(arrays_of(twin))
    assert ours.keys() == theirs.keys()
    assert shared_pairs(ours) == shared_pairs(theirs)
    for thing in (original, twin):
        getattr(thing, "close", lambda: None)()


def arrays_of(thing: Any, path: str = "", seen: set[int] | None = None) -> Iterator[tuple[str, NDArray[Any]]]:
    """Find all arrays that an object reaches, by the way to them."""
    seen = set() if seen is None else seen
    if isinstance(thing, np.ndarray):
        yield path, thing
        return
    if id(thing) in seen or isinstance(thing, type | np.random.Generator | str | bytes):
        return
    seen.add(id(thing))
    if isinstance(thing, mujoco.MjData | mujoco.MjModel):
        names = [n for n in dir(thing) if not n.startswith("_") and isinstance(getattr(thing, n), np.ndarray)]
        parts = [(n, getattr(thing, n)) for n in names]
        parts += [("warning", thing.warning.number)] if isinstance(thing, mujoco.MjData) else []
    elif isinstance(thing, Mapping):
        parts = [(str(key), value) for key, value in thing.items()]
    elif isinstance(thing, list | tuple):
        parts = [(str(number), value) for number, value in enumerate(thing)]
    elif isinstance(thing, MethodType):
        parts = [("self", thing.__self__)]
    else:
        parts = list(getattr(thing, "__dict__", {}).items())
    for name, part in parts:
        yield from arrays_of(part, f"{path}.{name}", seen)


def shared_pairs(arrays: Mapping[str, NDArray[Any]]) -> set[tuple[str, str]]:
    """Return the pairs of arrays that share memory, one of which can be written to."""
    ends = {path: np.lib.array_utils.byte_bounds(array) for path, array in arrays.items() if array.size}
    order = sorted(ends, key=lambda path: ends[path])
    pairs = set()
    for number, path in enumerate(order):
        for other in order[number + 1 :]:
            if ends[other][0] >= ends[path][1]:
                break
            if arrays[path].flags.writeable and np.may_share_memory(arrays[path], arrays[other]):
                pairs.add((min(path, other), max(path, other)))
    return pairs


def test_every_class_that_holds_an_environment_or_mujocos_memory_is_here() -> None:
    holds = re.compile(
        r"\b(Mj(Data|Model|vScene)|Renderer|Batch|Arm|gym\.(Env|Wrapper)|Tabletop(Hand)?Env|HandController|SceneRenderer)\b"
    )
    found = set()
    for file in Path(str(signimit_envs.__file__)).parent.rglob("*.py"):
        source = file.read_text(encoding="utf-8")
        classes = [node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.ClassDef)]
        found |= {node.name for node in classes if holds.search(ast.get_source_segment(source, node) or "")}
    tested = {name.partition(",")[0] for name in BLIND | DRAWN}
    assert found - tested - set(UNCOPIED) == set()
    assert set(UNCOPIED) - found == set()
