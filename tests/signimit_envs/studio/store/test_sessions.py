"""Sessions on the disk: named by us, listed, locked, and read again as they were."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from signimit import FileFormatError, InvalidInputError
from signimit_envs.studio.limits import Limits
from signimit_envs.studio.store.events import Asked, Created, Demonstrated, DrawnDemonstration, Titled
from signimit_envs.studio.store.sessions import ID_PATTERN, SessionStore

BEGINNING = Created("title", "2020-01-01T00:00:00", "paper", 3, 0)
Make = Callable[[], DrawnDemonstration]


@pytest.fixture
def store(tmp_path: Path) -> Iterator[SessionStore]:
    kept = SessionStore(tmp_path / "sessions")
    yield kept
    kept.close()


def test_a_session_is_read_again_as_it_was(store: SessionStore, shown: Make) -> None:
    name, one = store.create(BEGINNING), shown()
    assert re.fullmatch(ID_PATTERN, name)
    store.append(name, Demonstrated((one,)))
    history = store.read(name)
    assert history.shown[0].hand.points.tolist() == one.hand.points.tolist()
    assert history.created.seed == 0


def test_a_journal_does_not_grow_beyond_what_can_be_read(
    store: SessionStore, shown: Make, monkeypatch: pytest.MonkeyPatch
) -> None:
    name = store.create(BEGINNING)
    store.append(name, Demonstrated((shown(),)))
    monkeypatch.setattr("signimit_envs.studio.store.sessions.LIMITS", Limits(journal=1000))
    with pytest.raises(
        InvalidInputError, match="session: expected at most 1000 bytes; begin another session, found more"
    ):
        store.append(name, Demonstrated((shown(),)))
    assert len(store.read(name).shown) == 1


def test_the_list_knows_the_latest_of_every_session(store: SessionStore, shown: Make) -> None:
    name = store.create(BEGINNING)
    assert store.listed()[0].demonstrations == 0
    for event in (Demonstrated((shown(), shown())), Asked(shown().signs, 0, 0, 1.0), Titled("new")):
        store.append(name, event)
    listed = store.listed()[0]
    assert (listed.title, listed.demonstrations, listed.answers, listed.revision) == ("new", 2, 1, 2)


def test_a_session_that_cannot_be_read_does_not_hide_the_others(store: SessionStore, tmp_path: Path) -> None:
    good, bad = store.create(BEGINNING), store.create(BEGINNING)
    (tmp_path / "sessions" / bad / "journal.jsonl").write_text("nonsense\n")
    assert [one.id for one in store.listed()] == [good]
    with pytest.raises(InvalidInputError, match="line 1"):
        store.read(bad)


@pytest.mark.parametrize("name", ["", ".", "..", "../etc", "a/b", "20200101-000000-0123456g", "/", "\0"])
def test_a_name_that_is_not_ours_is_nowhere(name: str, store: SessionStore) -> None:
    assert name not in store


def test_only_one_studio_has_a_folder(store: SessionStore, tmp_path: Path) -> None:
    pytest.importorskip("fcntl")
    with pytest.raises(InvalidInputError, match="expected no other studio in it"):
        SessionStore(tmp_path / "sessions")
    store.close()
    SessionStore(tmp_path / "sessions").close()


def test_the_store_takes_only_so_many(store: SessionStore, monkeypatch: pytest.MonkeyPatch) -> None:
    from signimit_envs.studio.limits import Limits

    monkeypatch.setattr("signimit_envs.studio.store.sessions.LIMITS", Limits(sessions=2))
    store.create(BEGINNING)
    store.create(BEGINNING)
    with pytest.raises(InvalidInputError, match="at most 2"):
        store.create(BEGINNING)


def test_tracks_are_kept_beside_and_apart(store: SessionStore) -> None:
    name = store.create(BEGINNING)
    parts = [{"first": n, "rate": 50, "path": [[n, n]], "objects": [[[n, 0]]]} for n in range(3)]
    for answer, part in ((0, parts[0]), (1, parts[1]), (0, parts[2])):
        store.append_track(name, answer, part)
    assert store.read_track(name, 0) == [parts[0], parts[2]]
    assert store.read_track(name, 2) == []


@pytest.mark.parametrize(
    ("part", "sentence"),
    [
        ({"path": [[0, 0]]}, "expected an entry 'objects', found none"),
        ({"path": [[0, "x"]], "objects": [[[0, 0]]], "first": 0, "rate": 50}, "path: expected numbers"),
        ({"path": [[0, 0]], "objects": [], "first": 0, "rate": 50}, "objects: expected numbers of shape (1, n, 2)"),
        (
            {"path": [[0, 0]], "objects": [[[0, 0]]], "joints": [[0, 0]], "first": 0, "rate": 50},
            "joints: expected",
        ),
        ({"path": [[0, 0]], "objects": [[[0, 0]]], "first": 0.5, "rate": 50}, "first, rate: expected 0 or more"),
        ({"path": [[0, 0]], "objects": [[[0, 0]]], "first": 0, "rate": 0}, "first, rate: expected 0 or more"),
        ({"path": [[0, 0]], "objects": [[[0, 0]]], "first": 9, "rate": 1e-300}, "first, rate: expected 0 or more"),
        ({"path": [[0, 0]], "objects": [[[0, 0]]], "first": 10**400, "rate": 50}, "first, rate: expected 0 or more"),
    ],
)
def test_a_line_that_is_no_part_of_a_track_is_named(store: SessionStore, part: dict[str, Any], sentence: str) -> None:
    name = store.create(BEGINNING)
    store.append_track(name, 0, part)
    with pytest.raises(FileFormatError) as error:
        store.read_track(name, 0)
    assert "track-0.jsonl: line 1" in str(error.value)
    assert sentence in str(error.value)


def test_objects_do_not_come_and_go_within_a_track(store: SessionStore) -> None:
    name = store.create(BEGINNING)
    for objects in ([[[0, 0], [1, 1]]], [[[0, 0]]]):
        store.append_track(name, 0, {"first": 0, "rate": 50, "path": [[0, 0]], "objects": objects})
    with pytest.raises(FileFormatError, match=r"track-0\.jsonl: line 2: objects: expected 2 as in line 1, found 1"):
        store.read_track(name, 0)
