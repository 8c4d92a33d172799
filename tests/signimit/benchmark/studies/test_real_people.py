"""Everybody has a turn, and what two people do is scored by the project's own judge."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from signimit.benchmark.studies import real_people
from signimit.benchmark.studies.conditions import Recordings
from signimit.benchmark.studies.real_people import (
    METHODS,
    people_table,
    people_who_drew,
    read_people,
    real_conditions,
    run_real_session,
    tabulate_people,
)
from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import Record
from signimit.strokes import StrokeLibrary
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit.teaching.people import synthetic_library


@pytest.fixture(scope="module")
def recordings() -> Recordings:
    """Four who sign and two who move, with triangles as the $1 recogniser's people have them."""
    rng = np.random.default_rng(0)
    drawn = synthetic_library(("triangle up", "circle"), writers=2, samples=10, rng=rng)
    labels = tuple(label.removesuffix(" up") for label in drawn.labels)
    movements = StrokeLibrary(drawn.strokes, labels, drawn.writers, drawn.source)
    return Recordings(synthetic_library(PAPER_LANGUAGE.signs, writers=4, samples=8, rng=rng), movements)


def pairs_of(conditions: object) -> list[tuple[str, ...]]:
    assert isinstance(conditions, list)
    return [tuple(condition.name.split(" signer ")[1].split(" mover ")) for condition in conditions]


def test_everybody_has_a_turn_and_meets_everybody_in_the_end(recordings: Recordings) -> None:
    once, many = pairs_of(real_conditions(recordings)), pairs_of(real_conditions(recordings, 8))
    assert [len({pair[i] for pair in once}) for i in (0, 1)] == [4, 2]
    assert len(once) == 4
    assert len(set(many)) == 8
    assert set(Counter(signer for signer, _ in many).values()) == {2}


def test_other_strokes_and_other_code_make_other_sessions(
    recordings: Recordings, monkeypatch: pytest.MonkeyPatch
) -> None:
    names = {condition.name for condition in real_conditions(recordings)}
    assert names == {condition.name for condition in real_conditions(recordings)}
    swapped = Recordings(recordings.signs, StrokeLibrary(
        recordings.movements.strokes[::-1], recordings.movements.labels[::-1], recordings.movements.writers[::-1], ""
    ))  # fmt: skip
    assert names.isdisjoint(condition.name for condition in real_conditions(swapped))
    monkeypatch.setattr(real_people, "code_hash", lambda: "other")
    assert names.isdisjoint(condition.name for condition in real_conditions(recordings))


def test_who_drew_too_little_is_left_out(recordings: Recordings) -> None:
    assert len(people_who_drew(recordings.signs, PAPER_LANGUAGE.signs, 8)) == 4
    assert people_who_drew(recordings.signs, PAPER_LANGUAGE.signs, 9) == []
    few = Recordings(recordings.signs, recordings.movements.select(label="circle"))
    with pytest.raises(InvalidInputError, match=r"real people: movers: expected 4 strokes each of triangle up, "):
        real_conditions(few)


def test_people_of_two_files_are_not_mixed_up(recordings: Recordings, tmp_path: Path) -> None:
    for name in ("training.npz", "testing.npz"):
        recordings.movements.save(tmp_path / name)
    both = read_people([tmp_path / "training.npz", tmp_path / "testing.npz"])
    assert len(both) == 2 * len(recordings.movements)
    assert len(set(both.writers)) == 4
    assert sum(writer.endswith(" of testing.npz") for writer in set(both.writers)) == 2


def test_a_session_is_scored_for_both_methods_and_the_same_seed_is_the_same(recordings: Recordings) -> None:
    condition = real_conditions(recordings)[1]
    record = run_real_session(condition, 0)
    assert set(record["methods"]) == set(METHODS)
    assert record["methods"]["joint"]["verdicts"] == [1, 1, 1]
    assert sum(record["methods"]["joint"]["obeyed"]) >= 8
    assert run_real_session(condition, 0) == record
    assert run_real_session(condition, 1)["methods"] != record["methods"]


def test_what_a_session_comes_to_does_not_depend_on_the_codes_hash(
    recordings: Recordings, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The paper's method draws M_1 at random: from people and seed, so that an unrelated edit changes no result."""
    found = []
    for code in ("one", "other"):
        monkeypatch.setattr(real_people, "code_hash", lambda code=code: code)
        found.append([run_real_session(c, 0)["methods"] for c in real_conditions(recordings)])
    assert found[0] == found[1]


def test_rows_count_all_and_every_person() -> None:
    def record(signer: str, mover: str, obeyed: int) -> Record:
        ours = {"verdicts": [1, 1, 1], "obeyed": [1] * 9}
        theirs = {"verdicts": [1, 0, 1], "obeyed": [1] * obeyed + [0] * (9 - obeyed)}
        return {"signer": signer, "mover": mover, "methods": {"joint": ours, "paper": theirs}}

    rows = tabulate_people([record("2", "a", 3), record("13", "a", 6)])
    assert [row.who for row in rows[::2]] == ["all", "signer 2", "signer 13", "mover a"]
    ours, theirs = rows[:2]
    assert (ours.sessions, ours.inferred, ours.commands, ours.obeyed) == (2, 2, 18, 18)
    assert (theirs.inferred, theirs.obeyed, theirs.low < 0.5 < theirs.high) == (0, 9, True)
    assert "| all | `paper` | 2 | 0 of 2: 0.0 % [0.0, 65.8] | 9 of 18: 50.0 % [" in people_table(rows)
