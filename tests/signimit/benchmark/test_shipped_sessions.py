"""What is evaluated is shipped, hashed, and what the recipe makes."""

import shutil
from importlib import resources
from pathlib import Path

import pytest

from signimit.benchmark import shipped_sessions as frozen
from signimit.benchmark.codec import decode_sessions, encode_sessions
from signimit.benchmark.sessions import compose_session
from signimit.benchmark.shipped_sessions import (
    KIND,
    SESSIONS,
    VERSION,
    get_session,
    load_split,
    session_hash,
    split_hash,
)
from signimit.benchmark.splits import SPLITS
from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.archive import read_archive, write_archive

DATA = Path(str(resources.files("signimit.benchmark"))) / "data"


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    shutil.copy(DATA / "few.npz", tmp_path)
    shutil.copy(DATA / "sha256.json", tmp_path)
    return tmp_path


def test_twenty_sessions_of_every_split_are_shipped_in_less_than_three_megabytes() -> None:
    assert {path.stem for path in DATA.glob("*.npz")} == set(SPLITS)
    assert sum(path.stat().st_size for path in DATA.iterdir()) < 3e6
    assert [s.seed for s in load_split("few")] == list(range(SESSIONS))


@pytest.mark.parametrize("name", ["paper", "unseen-person", "many", "counterfactual"])
def test_the_recipe_still_makes_what_is_shipped(name: str) -> None:
    """If not, numpy's or our random numbers changed: what is shipped stays what counts, more of it cannot be made."""
    made = decode_sessions(SPLITS[name], encode_sessions([compose_session(SPLITS[name], 7)]))[0]
    assert session_hash(made) == session_hash(get_session(SPLITS[name], 7))


def test_sessions_beyond_the_shipped_ones_are_composed() -> None:
    session = get_session(SPLITS["few"], SESSIONS)
    assert session.seed == SESSIONS
    assert session_hash(session) != session_hash(get_session(SPLITS["few"], 0))
    assert session_hash(session) == session_hash(get_session(SPLITS["few"], SESSIONS))


def test_a_seed_below_zero_is_refused() -> None:
    with pytest.raises(InvalidInputError, match="seed: expected zero or more, found -1"):
        get_session(SPLITS["few"], -1)


def test_a_file_that_was_changed_is_refused(copy: Path) -> None:
    arrays, _ = read_archive(copy / "few.npz", KIND, VERSION)
    arrays["asked_hands"][0, 0, 0] += 1
    write_archive(copy / "few.npz", KIND, VERSION, arrays)
    with pytest.raises(FileFormatError, match=f"the sessions with SHA-256 {split_hash('few')[:12]}, found others, "):
        load_split("few", copy)


def test_half_a_file_is_refused(copy: Path) -> None:
    whole = (copy / "few.npz").read_bytes()
    (copy / "few.npz").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(FileFormatError, match=r"few\.npz: expected a signimit benchmark split file"):
        load_split("few", copy)


@pytest.mark.parametrize("text", ["{", "[]", '{"paper": "0"}'])
def test_a_torn_list_of_hashes_is_refused(copy: Path, text: str) -> None:
    (copy / "sha256.json").write_text(text)
    with pytest.raises(FileFormatError, match=r"sha256\.json: expected a"):
        load_split("few", copy)


def test_freezing_writes_what_loading_reads(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(frozen, "SESSIONS", 2)
    monkeypatch.setattr(frozen, "SPLITS", {"few": SPLITS["few"]})
    frozen.freeze(tmp_path)
    made = load_split("few", tmp_path)
    shipped = load_split("few")[:2]
    assert [session_hash(s) for s in made] == [session_hash(s) for s in shipped]
