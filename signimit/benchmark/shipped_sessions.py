"""The evaluation sessions that are shipped: twenty of each split, with a hash that results carry."""

from __future__ import annotations

import json
import os
from functools import lru_cache
from importlib import resources
from pathlib import Path

from signimit.benchmark.codec import decode_sessions, digest, encode_sessions
from signimit.benchmark.sessions import BenchmarkSession, compose_session
from signimit.benchmark.splits import SPLITS, Split
from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.archive import read_archive, write_archive

SESSIONS = 20  # shipped of each split, seeds 0 to 19
KIND, VERSION = "benchmark split", 1
_HASHES = "sha256.json"
_FOLDER = Path(str(resources.files("signimit.benchmark"))) / "data"


def get_session(split: Split, seed: int) -> BenchmarkSession:
    """Return a session: as shipped, or composed where the seed is beyond those.

    Raises:
        InvalidInputError: If the seed is negative.
        FileFormatError: If the shipped file is not the one that was frozen.
    """
    if seed < 0:
        raise InvalidInputError("seed", "zero or more", f"{seed}")
    if seed < SESSIONS:
        return load_split(split.name)[seed]
    return decode_sessions(split, encode_sessions([compose_session(split, seed)]))[0]


@lru_cache(maxsize=len(SPLITS))
def load_split(name: str, folder: Path = _FOLDER) -> tuple[BenchmarkSession, ...]:
    """Read the shipped sessions of a split.

    Raises:
        OSError: If there is no such file.
        FileFormatError: If it is torn, or not what was frozen.
    """
    path = folder / f"{name}.npz"
    arrays, _ = read_archive(path, KIND, VERSION)
    wanted, found = split_hash(name, folder), digest(arrays)
    if found != wanted:
        raise FileFormatError(str(path), f"the sessions with SHA-256 {wanted[:12]}", f"others, {found[:12]}")
    return decode_sessions(SPLITS[name], arrays)


def split_hash(name: str, folder: Path = _FOLDER) -> str:
    """Return the SHA-256 of the shipped sessions of a split, as written down when they were frozen."""
    return str(_hashes(folder)[name])


def session_hash(session: BenchmarkSession) -> str:
    """Return the SHA-256 of all that happens in one session."""
    return digest(encode_sessions([session]))


@lru_cache(maxsize=4)
def _hashes(folder: Path) -> dict[str, str]:
    path = folder / _HASHES
    try:
        hashes = json.loads(path.read_text(encoding="utf-8"))
    except ValueError:
        raise FileFormatError(str(path), "a JSON object with a hash for each split", "something else") from None
    if not isinstance(hashes, dict) or set(hashes) != set(SPLITS):
        raise FileFormatError(str(path), f"a hash for each of {', '.join(SPLITS)}", "something else")
    return hashes


def freeze(folder: str | os.PathLike[str]) -> None:
    """Compose and write the shipped sessions of all splits; done once for each `signimit.benchmark.sessions.RECIPE`."""
    hashes = {}
    for name, split in SPLITS.items():
        arrays = encode_sessions([compose_session(split, seed) for seed in range(SESSIONS)])
        write_archive(Path(folder) / f"{name}.npz", KIND, VERSION, arrays)
        hashes[name] = digest(arrays)
    (Path(folder) / _HASHES).write_text(json.dumps(hashes, indent=1) + "\n", encoding="utf-8")
