"""Sessions on the disk: named by us, listed, locked, and read again as they were."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from signimit import InvalidInputError
from signimit_envs.studio.store.events import Asked, Created, Demonstrated, Shown, Titled
from signimit_envs.studio.store.session_store import ID_PATTERN, Shelf

BEGINNING = Created("title", "2020-01-01T00:00:00", "paper", 3, 0)
Make = Callable[[], Shown]


@pytest.fixture
def shelf(tmp_path: Path) -> Iterator[Shelf]:
    kept = Shelf(tmp_path / "sessions")
    yield kept
    kept.close()


def test_a_session_is_read_again_as_it_was(shelf: Shelf, shown: Make) -> None:
    name, one = shelf.create(BEGINNING), shown()
    assert re.fullmatch(ID_PATTERN, name)
    shelf.append(name, Demonstrated((one,)))
    history = shelf.read(name)
    assert history.shown[0].hand.points.tolist() == one.hand.points.tolist()
    assert history.created.seed == 0


def test_the_list_knows_the_latest_of_every_session(shelf: Shelf, shown: Make) -> None:
    name = shelf.create(BEGINNING)
    assert shelf.listed()[0].demonstrations == 0
    for event in (Demonstrated((shown(), shown())), Asked(shown().signs, 0, 0, 1.0), Titled("new")):
        shelf.append(name, event)
    listed = shelf.listed()[0]
    assert (listed.title, listed.demonstrations, listed.answers, listed.revision) == ("new", 2, 1, 2)


def test_a_session_that_cannot_be_read_does_not_hide_the_others(shelf: Shelf, tmp_path: Path) -> None:
    good, bad = shelf.create(BEGINNING), shelf.create(BEGINNING)
    (tmp_path / "sessions" / bad / "journal.jsonl").write_text("nonsense\n")
    assert [one.id for one in shelf.listed()] == [good]
    with pytest.raises(InvalidInputError, match="line 1"):
        shelf.read(bad)


@pytest.mark.parametrize("name", ["", ".", "..", "../etc", "a/b", "20200101-000000-0123456g", "/", "\0"])
def test_a_name_that_is_not_ours_is_nowhere(name: str, shelf: Shelf) -> None:
    assert name not in shelf


def test_only_one_studio_has_a_folder(shelf: Shelf, tmp_path: Path) -> None:
    pytest.importorskip("fcntl")
    with pytest.raises(InvalidInputError, match="expected no other studio in it"):
        Shelf(tmp_path / "sessions")
    shelf.close()
    Shelf(tmp_path / "sessions").close()


def test_the_shelf_takes_only_so_many(shelf: Shelf, monkeypatch: pytest.MonkeyPatch) -> None:
    from signimit_envs.studio.limits import Limits

    monkeypatch.setattr("signimit_envs.studio.store.session_store.LIMITS", Limits(sessions=2))
    shelf.create(BEGINNING)
    shelf.create(BEGINNING)
    with pytest.raises(InvalidInputError, match="at most 2"):
        shelf.create(BEGINNING)


def test_tracks_are_kept_beside_and_apart(shelf: Shelf) -> None:
    name = shelf.create(BEGINNING)
    shelf.append_track(name, 0, {"path": [[0, 0]]})
    shelf.append_track(name, 1, {"path": [[1, 1]]})
    shelf.append_track(name, 0, {"path": [[2, 2]]})
    assert shelf.read_track(name, 0) == [{"path": [[0, 0]]}, {"path": [[2, 2]]}]
    assert shelf.read_track(name, 2) == []
