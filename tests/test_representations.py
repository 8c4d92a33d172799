"""What anything prints as in a notebook or a debugger: one line, however much it holds."""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import gymnasium as gym
import numpy as np
import pytest
from numpy.typing import NDArray

import signimit as si
import signimit_envs
from signimit.display import LINE, one_line
from signimit.teaching.people.choosing import choose_people
from signimit_envs.recording import record_reproductions
from signimit_envs.sessions.session import SessionPlan, run_session

LEFT = ("signimit.learners.joint", "signimit.evaluation.Template")  # the first is rewritten, the second is the judge's
PUBLIC = {
    found
    for package in (si, signimit_envs)
    for name in package.__all__
    if inspect.isclass(found := getattr(package, name)) and not issubclass(found, Exception)
}


def class_name(value: object) -> str:
    return f"{type(value).__module__}.{type(value).__qualname__}"


def everything_in(value: Any, seen: dict[int, Any]) -> Iterator[Any]:
    """All objects of the project that can be reached from a value, those behind properties too."""
    if id(value) in seen:
        return
    seen[id(value)] = value  # and kept, so that no other gets its id
    inner = list(value.values()) if isinstance(value, Mapping) else []
    if isinstance(value, (list, tuple, set, frozenset)):
        inner = list(value)
    if class_name(value).startswith("signimit"):
        yield value
        inner += vars(value).values() if hasattr(value, "__dict__") else []
        for name, member in inspect.getmembers_static(type(value)):
            if not name.startswith("_") and type(member).__name__ in ("property", "cached_property"):
                try:
                    inner.append(getattr(value, name))
                except (AttributeError, RuntimeError, si.SignimitError):
                    continue  # it has none
    for item in inner:
        yield from everything_in(item, seen)


@pytest.fixture(scope="module")
def objects(tmp_path_factory: pytest.TempPathFactory) -> list[Any]:
    """Everything that a session comes to, on the arm."""
    plan = SessionPlan(seconds=1.0)
    people = choose_people(plan.language, np.random.default_rng(0))
    session = plan.compose(people)
    shown = session.demonstrations
    ours, theirs = (run_session(p, session, lambda commands: commands) for p in (plan, plan.as_in_paper()))
    model, scene = ours.model, shown[0].objects
    policy = model.respond(shown[0].signs, scene).policy
    env = signimit_envs.TabletopHandEnv()
    env.reset(seed=0)
    filmed = gym.make(signimit_envs.ENV_IDS[0], render_mode="rgb_array")
    recorder = signimit_envs.RecordMp4(filmed, tmp_path_factory.mktemp("films"))
    roots = [
        ours, theirs, people, env, signimit_envs.TabletopEnv(), recorder,
        si.Ambiguity(3, tuple(range(1000)), (0.5,) * 1000, 0.25),
        si.Suspicion(3, 0.25, (0, 1), None, tuple(range(1000))),
        model.respond(shown[0].signs, scene), model.explain(), model.most_informative([scene]),
        si.group_movements(np.eye(4), rng=0), si.performed(shown[0].hand, scene, session.truth.templates),
        record_reproductions(model, session.commands[:1], 1.0, plan.language),
        signimit_envs.run_episode(signimit_envs.TabletopHandEnv(), model, seed=0),
        signimit_envs.reproduce(env, policy, scene, [0, 0], 1.0), signimit_envs.reproduce_many([policy], [[0, 0]], 1.0),
        [si.make_policy(shown.paths[:2], shown.times[:2], kind) for kind in si.POLICY_KINDS],
    ]  # fmt: skip
    seen: dict[int, Any] = {}
    return [found for root in roots for found in everything_in(root, seen)]


class Planned(NamedTuple):
    """What `one_line` makes of fields that are long in other ways than those of the project."""

    note: str = "n" * 1000
    numbers: NDArray[np.float64] = np.zeros((7, 2))


PLANNED = one_line(Planned)()


def test_every_public_class_fits_on_a_line_and_all_that_it_holds(objects: list[Any]) -> None:
    assert {cls for found in objects for cls in type(found).__mro__} >= PUBLIC
    long = {
        class_name(found): text
        for found in objects
        if not class_name(found).startswith(LEFT) and (len(text := repr(found)) > LINE or "\n" in text)
    }
    assert long == {}


def test_a_model_and_people_say_what_they_are(objects: list[Any]) -> None:
    said = {type(found).__name__: repr(found) for found in objects}
    model = "ImitationModel(12 demonstrations, 3 movements, method='paper', policy_kind='knn')"
    assert model in {repr(found) for found in objects if isinstance(found, si.ImitationModel)}
    assert said["People"] == "People(signer='a synthetic person', mover='a synthetic person')"
    assert said["TabletopPeople"] == "TabletopPeople(signer='a synthetic person', mover='a synthetic person')"


def test_arrays_are_shown_by_shape_numbers_shortly_and_what_does_not_fit_not() -> None:
    @one_line
    @dataclass
    class Many:
        place: NDArray[np.float64]
        path: NDArray[np.float64]
        paths: tuple[NDArray[np.float64], ...]
        error: float
        name: str
        nothing: None = None

    path = np.zeros((7, 2))
    many = Many(np.array([0.123456, 2]), path, (path,) * 9, 1 / 3, "x" * 99)
    assert repr(many) == "Many(place=[0.1235, 2], path=<7x2>, paths=(<7x2>, <7x2>, <7x2>, ...), error=0.3333, ...)"
    assert repr(PLANNED) == "Planned(note='nnnnnnnnnnnnnnnnn...nnnnnnnnnnnnnnnnnn', numbers=<7x2>)"
