"""Sessions from tasks to records, one alone and a few at a time on this machine's processors."""

import json
import os
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from signimit.benchmark import entries
from signimit.benchmark.entries import EntrantReference, get_entrant
from signimit.benchmark.protocol import Entrant, Kit, Observation, Oracle, Truth
from signimit.benchmark.results import records_digest
from signimit.benchmark.running import FASTEST, SessionTask, batches_of, local_engine, obey, run_task
from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import InvalidInputError
from signimit.inference import WordOrder
from signimit.learners.base import Understanding
from signimit.teaching.languages import Request
from signimit.teaching.sessions import Command

COMMAND = Command(Request(0, 0), (np.eye(2), np.ones((2, 2))), np.zeros((3, 2)), np.array([0.1, -0.1]), 0)
DEADLY = """
import os, signal
class Deadly:
    def __init__(self): os.kill(os.getpid(), signal.SIGKILL)
    def observe(self, demonstrations): pass
    def begin(self, signs, objects): pass
    def act(self, observation): return 0, 0
"""

HANDED: list[tuple[Any, ...]] = []


class Listener:
    """Keeps what it is handed, to the last item."""

    def __init__(self, *handed: Any) -> None:
        HANDED.append(handed)
        self.drawn = float(handed[0].rng.random())

    def observe(self, demonstrations: DemonstrationSet) -> None:
        HANDED.append((demonstrations,))

    def begin(self, signs: Any, objects: Any) -> None:
        HANDED.append((signs, objects))

    def act(self, observation: Observation) -> Any:
        return 0.1 * self.drawn, 0.0


class Teller(Listener):
    """Says what it was told, and draws nothing."""

    def __init__(self, kit: Kit, truth: Truth) -> None:
        super().__init__(kit, truth)
        language = truth.shown.language
        order = WordOrder(language.focus_word, language.movement_word)
        self.understanding = Understanding(truth.shown.movement, truth.shown.focus, order)


@pytest.fixture(autouse=True)
def registered(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    added = {
        "listener": Entrant(name="listener", title="", make=Listener),
        "hungry": Entrant(name="hungry", title="", make=Listener, demonstrations=30),
        "teller": Oracle(name="teller", title="", make=Teller),
    }
    monkeypatch.setattr(entries, "ENTRANTS", added)
    HANDED.clear()
    yield
    get_entrant.cache_clear()


def ran(name: str, split: str = "few", seed: int = 0) -> dict[str, Any]:
    return run_task(SessionTask(EntrantReference(name), split, seed))


def test_an_ordinary_entry_is_handed_prototypes_a_generator_and_what_can_be_seen() -> None:
    ran("listener")
    made, observed, *begun = HANDED
    assert [type(item) for item in made] == [Kit]
    assert Kit._fields == ("prototypes", "rng")
    assert [type(item) for item in observed] == [DemonstrationSet]
    assert len(begun) == 9
    assert all(len(signs) == 2 and objects.shape == (3, 2) for signs, objects in begun)


def test_an_oracle_is_told_what_was_shown_and_what_will_be_asked() -> None:
    record = ran("teller")
    _, truth = HANDED[0]
    assert len(truth.shown.requests) == 6
    assert len(truth.asked) == 9
    assert (record["groups"], record["focus"], record["order"]) == (1.0, 1.0, 1.0)


def test_stages_that_an_entry_does_not_tell_are_not_scored() -> None:
    assert not {"groups", "focus", "order", "read"} & set(ran("listener"))
    assert "read" not in ran("teller")


def test_a_record_depends_on_its_task_alone() -> None:
    first, again, other = ran("listener"), ran("listener"), ran("listener", seed=1)
    for record in (first, again, other):
        assert set(record.pop("seconds")) == {"compose", "observe", "act"}
    assert json.loads(json.dumps(first)) == again
    assert first["session"] != other["session"]
    assert first["misfit"] != other["misfit"]


def test_who_needs_more_demonstrations_gets_more_and_the_record_says_so() -> None:
    assert ran("hungry")["demonstrations"] == len(HANDED[1][0]) == 30
    assert ran("listener")["demonstrations"] == 6


def test_families_are_told_where_there_are_any() -> None:
    assert sorted(ran("listener", "counterfactual")["families"]) == sorted([0, 1, 2] * 4)
    assert "families" not in ran("listener")


def test_a_mistake_names_the_entry_the_split_and_the_session(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Listener, "act", lambda self, observation: (float("nan"), 0.0))
    with pytest.raises(InvalidInputError, match="entry listener, split few, session 3: act at step 0: expected a fini"):
        ran("listener", seed=3)


def test_a_bug_of_an_entry_keeps_its_traceback_and_says_in_which_session(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(self: Listener, demonstrations: DemonstrationSet) -> None:
        raise KeyError("mine")

    monkeypatch.setattr(Listener, "observe", fail)
    with pytest.raises(KeyError, match="mine") as caught:
        ran("listener", seed=3)
    assert caught.value.__notes__ == ["entry listener, split few, session 3"]


def test_batches_hold_all_tasks_in_order(still: EntrantReference) -> None:
    tasks = [SessionTask(still, "few", seed) for seed in range(5)]
    assert list(batches_of(tasks, 2)) == [tasks[:2], tasks[2:4], tasks[4:]]


def test_processes_give_what_this_process_gives_and_take_no_more_tasks_than_they_need(still: EntrantReference) -> None:
    taken: list[int] = []

    def tasks() -> Iterator[SessionTask]:
        for seed in range(6):
            taken.append(seed)
            yield SessionTask(still, "few", seed)

    found = local_engine(workers=1)(tasks())
    records = [next(found)]
    assert len(taken) <= 3
    threads = [os.environ.get(name) for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")]
    assert threads == ["1", "1"]
    records += found
    expected = [run_task(SessionTask(still, "few", seed)) for seed in range(6)]
    assert records_digest(sorted(records, key=lambda r: int(r["seed"]))) == records_digest(expected)


def test_the_number_of_threads_is_put_back(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    monkeypatch.delenv("MKL_NUM_THREADS", raising=False)
    assert list(local_engine(1)(())) == []
    assert os.environ["OMP_NUM_THREADS"] == "3"
    assert "MKL_NUM_THREADS" not in os.environ


def test_a_killed_process_ends_the_run_with_a_sentence() -> None:
    tasks = [SessionTask(EntrantReference("deadly.py:Deadly", DEADLY), "few", 0)]
    with pytest.raises(InvalidInputError, match="one that was killed; what was done is kept, run again to go on"):
        list(local_engine(workers=1)(tasks))


def test_at_least_one_worker_and_one_session_a_batch() -> None:
    with pytest.raises(InvalidInputError, match="workers: expected at least 1, found 0"):
        local_engine(0)
    with pytest.raises(InvalidInputError, match="batch: expected at least 1, found 0"):
        local_engine(1, batch=0)


class Recorder:
    """Commands what it is made with, and remembers what it saw."""

    def __init__(self, velocity: Any) -> None:
        self.velocity, self.seen = velocity, list[Observation]()

    def observe(self, demonstrations: object) -> None: ...

    def begin(self, signs: tuple[Any, ...], objects: Any) -> None:
        self.begun = (signs, objects)

    def act(self, observation: Observation) -> Any:
        self.seen.append(observation)
        return self.velocity


def test_the_hand_starts_where_the_command_says_and_moves_as_told() -> None:
    entry = Recorder([0.1, 0.05])
    path = obey(entry, COMMAND)
    assert path.shape == (501, 2)
    np.testing.assert_allclose(path[0], [0.1, -0.1])
    np.testing.assert_allclose(path[-1], [1.1, 0.4])
    assert entry.begun == (COMMAND.signs, COMMAND.objects)


def test_what_is_observed_is_the_hand_its_last_velocity_and_the_time() -> None:
    entry = Recorder([0.1, 0.05])
    path = obey(entry, COMMAND, seconds=1.0)
    np.testing.assert_array_equal([o.hand for o in entry.seen], path[:-1])
    np.testing.assert_allclose([o.seconds for o in entry.seen], np.arange(50) * 0.02)
    np.testing.assert_array_equal(entry.seen[0].velocity, [0, 0])
    np.testing.assert_array_equal(entry.seen[1].velocity, [0.1, 0.05])


def test_what_is_too_fast_is_slowed_down_as_a_whole() -> None:
    path = obey(Recorder([24.0, -6.0]), COMMAND, seconds=0.1)
    np.testing.assert_allclose(np.diff(path, axis=0) / 0.02, [[FASTEST, -FASTEST / 4]] * 5)


def test_an_entry_cannot_move_the_hand_by_writing_to_what_it_sees() -> None:
    class Vandal(Recorder):
        def act(self, observation: Observation) -> Any:
            observation.hand[:] = 7.0
            observation.velocity[:] = 7.0
            return [0.0, 0.0]

    np.testing.assert_array_equal(obey(Vandal(None), COMMAND, seconds=0.1), [[0.1, -0.1]] * 6)
    np.testing.assert_array_equal(COMMAND.hand, [0.1, -0.1])


def test_a_velocity_that_is_used_again_is_not_written_to() -> None:
    velocity = np.array([24.0, -6.0])
    obey(Recorder(velocity), COMMAND, seconds=0.1)
    np.testing.assert_array_equal(velocity, [24.0, -6.0])


@pytest.mark.parametrize("given", [np.nan, None, [0.1], [0.1, np.inf], [[0.1, 0.2]], "fast", [0.1, None]])
def test_what_is_not_a_velocity_is_refused(given: Any) -> None:
    with pytest.raises(
        InvalidInputError, match=r"act at step 0: expected a finite velocity of shape \(2,\), m/s, found"
    ):
        obey(Recorder(given), COMMAND)


def test_what_is_inferred_of_hands_that_err_is_not_scored(monkeypatch: pytest.MonkeyPatch) -> None:
    class Doubtful:
        """Understands all but the demonstrations that do something else."""

        def __init__(self, kit: Kit, truth: Truth) -> None:
            shown, order = truth.shown, WordOrder(0, 1)
            labels, focus = np.where(shown.sound, shown.movement, -1), np.where(shown.sound, shown.focus, -1)
            self.understanding = Understanding(labels, focus, order)

        def observe(self, demonstrations: DemonstrationSet) -> None: ...

        def begin(self, signs: Any, objects: Any) -> None: ...

        def act(self, observation: Observation) -> tuple[float, float]:
            return 0.0, 0.0

    monkeypatch.setitem(entries.ENTRANTS, "doubtful", Oracle(name="doubtful", title="", make=Doubtful))
    get_entrant.cache_clear()
    record = run_task(SessionTask(EntrantReference("doubtful"), "wrong-2", 0))
    assert (record["groups"], record["focus"], record["order"]) == (1.0, 1.0, 1.0)
