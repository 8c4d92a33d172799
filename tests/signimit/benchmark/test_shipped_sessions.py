"""What is evaluated is shipped, hashed, and what the recipe makes."""

import shutil
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from signimit.benchmark import shipped_sessions as frozen
from signimit.benchmark.shipped_sessions import (
    GRID,
    KIND,
    SESSIONS,
    VERSION,
    decode_sessions,
    digest,
    encode_sessions,
    get_session,
    load_split,
    session_hash,
    split_hash,
)
from signimit.benchmark.splits import SPLITS, compose_split_session
from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.archive import read_archive, write_archive
from signimit.teaching.sessions import Session

DATA = Path(str(resources.files("signimit.benchmark"))) / "data"


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    shutil.copy(DATA / "few.npz", tmp_path)
    shutil.copy(DATA / "sha256.json", tmp_path)
    return tmp_path


def test_twenty_sessions_of_every_split_are_shipped_in_less_than_five_megabytes() -> None:
    assert {path.stem for path in DATA.glob("*.npz")} == set(SPLITS)
    assert sum(path.stat().st_size for path in DATA.iterdir()) < 5e6
    assert [s.seed for s in load_split("few")] == list(range(SESSIONS))


@pytest.mark.parametrize(
    "name", ["paper", "unseen-person", "many", "counterfactual", "idle-4", "strangers-many", "mouse"]
)
def test_the_recipe_still_makes_what_is_shipped(name: str) -> None:
    """If not, numpy's or our random numbers changed: what is shipped stays what counts, more of it cannot be made."""
    made = decode_sessions(SPLITS[name], encode_sessions([compose_split_session(SPLITS[name], 7)]))[0]
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


@pytest.fixture(scope="module", params=["paper", "filler-word", "counterfactual", "irrelevant-2", "mouse"])
def sessions(request: pytest.FixtureRequest) -> list[Session]:
    return [compose_split_session(SPLITS[request.param], seed) for seed in (0, 1)]


def test_what_comes_back_is_what_went_in_to_half_the_grid(sessions: list[Session]) -> None:
    back = decode_sessions(sessions[0].condition, encode_sessions(sessions))
    assert [s.seed for s in back] == [0, 1]
    for ours, theirs in zip(back, sessions, strict=True):
        for a, b in zip(ours.demonstrations, theirs.demonstrations, strict=True):
            for x, y in zip((*a.signs, a.hand, a.objects), (*b.signs, b.hand, b.objects), strict=True):
                np.testing.assert_allclose(x, y, rtol=0, atol=0.5001 * GRID)
            np.testing.assert_array_equal(a.times, b.times)
        for c, d in zip(ours.commands, theirs.commands, strict=True):
            for x, y in zip((*c.signs, c.objects, c.hand), (*d.signs, d.objects, d.hand), strict=True):
                np.testing.assert_allclose(x, y, rtol=0, atol=0.5001 * GRID)
            assert (c.request, c.family) == (d.request, d.family)
        for p, q in zip(ours.prototypes, theirs.prototypes, strict=True):
            np.testing.assert_allclose(p.points, q.points, rtol=0, atol=0.5001 * GRID)


def test_the_drawings_to_judge_by_are_found_again_in_the_paths(sessions: list[Session]) -> None:
    back = decode_sessions(sessions[0].condition, encode_sessions(sessions))
    for ours, theirs in zip(back, sessions, strict=True):
        assert ours.truth.requests == theirs.truth.requests
        assert list(ours.truth.spoilt) == list(theirs.truth.spoilt)
        spoilt = theirs.truth.movement[~theirs.truth.sound].tolist()
        for movement, (a, b) in enumerate(zip(ours.truth.templates, theirs.truth.templates, strict=True)):
            assert len(a) == len(b) - theirs.truth.language.rounds * spoilt.count(movement)
            for x in a:
                near = [y for y in b if x.shape == y.shape and np.allclose(x, y, rtol=0, atol=1.0001 * GRID)]
                assert len(near) == 1


def test_coding_again_changes_nothing(sessions: list[Session]) -> None:
    arrays = encode_sessions(sessions)
    assert digest(encode_sessions(decode_sessions(sessions[0].condition, arrays))) == digest(arrays)


def test_nothing_that_an_entry_sees_can_be_written_to(sessions: list[Session]) -> None:
    (session, _) = decode_sessions(sessions[0].condition, encode_sessions(sessions))
    seen = [
        *(p.points for p in session.prototypes),
        *(a for c in session.commands for a in (*c.signs, c.objects, c.hand)),
    ]
    seen += [a for d in session.demonstrations for a in (*d.signs, d.objects, d.hand, d.times)]
    assert not any(array.flags.writeable for array in seen)


def test_the_digest_knows_every_number_but_not_the_byte_order(sessions: list[Session]) -> None:
    arrays = encode_sessions(sessions)
    swapped = {name: a.astype(a.dtype.newbyteorder(">")) for name, a in arrays.items()}
    assert digest(swapped) == digest(arrays)
    for name, array in arrays.items():
        changed = array.copy()
        changed.flat[-1] += 1
        assert digest(arrays | {name: changed}) != digest(arrays)
