"""The shipped evaluation sessions: twenty of each split, their file format, and the hash that results carry.

In a file, sessions are arrays of whole numbers: small, and the same on every machine. Lengths are kept to 0.05 mm. A
path is its first point, and the change of its step from sample to sample, which is small because hands move smoothly.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from importlib import resources
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.splits import SPLITS, compose_split_session
from signimit.demonstrations import Demonstration, DemonstrationSet
from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.archive import read_archive, write_archive
from signimit.strokes import Stroke
from signimit.teaching.composition import GroundTruth
from signimit.teaching.languages import Request
from signimit.teaching.people.person import SAMPLE_TIME
from signimit.teaching.scenes import sample_times
from signimit.teaching.sessions import Command, Condition, Session

SESSIONS = 20  # shipped of each split, seeds 0 to 19
KIND, VERSION = "benchmark split", 1
_HASHES = "sha256.json"
_FOLDER = Path(str(resources.files("signimit.benchmark"))) / "data"
GRID = 5e-5  # m
Arrays = dict[str, NDArray[Any]]
Points = NDArray[np.float64]


def get_session(split: Condition, seed: int) -> Session:
    """Return a session: as shipped, or composed where the seed is beyond those.

    Raises:
        InvalidInputError: If the seed is negative.
        FileFormatError: If the shipped file is not the one that was frozen.
    """
    if seed < 0:
        raise InvalidInputError("seed", "zero or more", f"{seed}")
    if seed < SESSIONS:
        return load_split(split.name)[seed]
    return decode_sessions(split, encode_sessions([compose_split_session(split, seed)]))[0]


@lru_cache(maxsize=len(SPLITS))
def load_split(name: str, folder: Path = _FOLDER) -> tuple[Session, ...]:
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


def session_hash(session: Session) -> str:
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
    """Compose and write the shipped sessions of all splits; done once for each `signimit.benchmark.splits.RECIPE`."""
    hashes = {}
    for name, split in SPLITS.items():
        arrays = encode_sessions([compose_split_session(split, seed) for seed in range(SESSIONS)])
        write_archive(Path(folder) / f"{name}.npz", KIND, VERSION, arrays)
        hashes[name] = digest(arrays)
    (Path(folder) / _HASHES).write_text(json.dumps(hashes, indent=1) + "\n", encoding="utf-8")


def encode_sessions(sessions: Sequence[Session]) -> Arrays:
    """Turn sessions of one split into arrays; all have as many demonstrations, spoilt ones and commands."""
    hands = [d.hand for s in sessions for d in s.demonstrations]
    shown = [sign for s in sessions for d in s.demonstrations for sign in d.signs]
    asked = [sign for s in sessions for c in s.commands for sign in c.signs]
    prototypes = [p.points for s in sessions for p in s.prototypes]
    arrays: Arrays = {"seeds": np.array([s.seed for s in sessions], dtype=np.int32)}
    for name, paths in {"hands": hands, "shown": shown, "asked": asked, "prototypes": prototypes}.items():
        arrays |= {f"{name}_{part}": array for part, array in _pack(paths).items()}
    arrays["loops"] = np.array([_loop_bounds(s) for s in sessions], dtype=np.int16)
    arrays["shown_objects"] = _whole([s.demonstrations.objects for s in sessions])
    arrays["asked_objects"] = _whole([[c.objects for c in s.commands] for s in sessions])
    arrays["asked_hands"] = _whole([[c.hand for c in s.commands] for s in sessions])
    arrays["meant"] = np.array([s.truth.requests for s in sessions], dtype=np.int8)
    if any(len(s.truth.spoilt) for s in sessions):
        arrays["spoilt"] = np.array([s.truth.spoilt for s in sessions], dtype=np.int16)
    arrays["requests"] = np.array([[c.request for c in s.commands] for s in sessions], dtype=np.int8)
    arrays["families"] = np.array([[c.family for c in s.commands] for s in sessions], dtype=np.int8)
    return arrays


def decode_sessions(split: Condition, arrays: Mapping[str, NDArray[Any]]) -> tuple[Session, ...]:
    """Undo `encode_sessions`, up to the grid.

    Raises:
        KeyError: If an array is missing.
    """
    hands, shown, asked, prototypes = (_unpack(arrays, name) for name in ("hands", "shown", "asked", "prototypes"))
    language, sessions = split.language, []
    for number, seed in enumerate(arrays["seeds"].tolist()):
        demonstrations = []
        for objects in arrays["shown_objects"][number] * GRID:
            hand, utterance = next(hands), tuple(islice(shown, language.words))
            demonstrations.append(Demonstration(utterance, objects, hand, sample_times(len(hand))))

        meant = arrays["meant"][number].astype(np.int64)
        spoilt = arrays["spoilt"][number].astype(np.int64) if "spoilt" in arrays else np.zeros(0, dtype=np.int64)
        templates: list[list[Points]] = [[] for _ in language.movements]
        for shown_once, (movement, focus), bounds in zip(demonstrations, meant, arrays["loops"][number], strict=True):
            templates[movement] += [shown_once.hand[a:b] - shown_once.objects[focus] for a, b in bounds if a < b]

        commands = [
            Command(
                Request(*request.tolist()),
                tuple(islice(asked, language.words)),
                _read_only(objects * GRID),
                _read_only(hand * GRID),
                int(family),
            )
            for request, objects, hand, family in zip(
                *(arrays[name][number] for name in ("requests", "asked_objects", "asked_hands", "families")),
                strict=True,
            )
        ]
        signs = islice(prototypes, len(language.prototypes))
        sessions.append(
            Session(
                condition=split,
                seed=seed,
                demonstrations=DemonstrationSet(demonstrations),
                prototypes=tuple(
                    Stroke(points, np.arange(len(points), dtype=np.float64) * SAMPLE_TIME) for points in signs
                ),
                truth=GroundTruth(language, meant[:, 0], meant[:, 1], tuple(map(tuple, templates)), spoilt),
                commands=tuple(commands),
            )
        )
    return tuple(sessions)


def digest(arrays: Mapping[str, NDArray[Any]]) -> str:
    """Return the SHA-256 of arrays, whatever the byte order of the machine."""
    sha = hashlib.sha256()
    for name, array in sorted(arrays.items()):
        sha.update(f"{name} {array.shape} ".encode())
        sha.update(array.astype(array.dtype.newbyteorder("<")).tobytes())
    return sha.hexdigest()


def _loop_bounds(session: Session) -> list[list[tuple[int, int]]]:
    """Find where in each hand path the drawings to judge by are; in one that is spoilt none is, from 0 to 0."""
    truth, bounds = session.truth, []
    unplaced = [list(drawings) for drawings in truth.templates]
    for demonstration, (movement, focus), sound in zip(
        session.demonstrations, truth.requests, truth.sound, strict=True
    ):
        found, left = [], []
        for loop in unplaced[movement] if sound else ():
            start = _place_of(loop + demonstration.objects[focus], demonstration.hand)
            if start < 0:
                left.append(loop)
            else:
                found.append((start, start + len(loop)))
        if sound:
            unplaced[movement] = left
        bounds.append(found or [(0, 0)] * truth.language.rounds)
    return bounds


def _place_of(loop: Points, hand: Points) -> int:
    """Return where a drawing begins in a path, -1 if nowhere; tolerant, for a decoded path was rounded."""
    near = np.flatnonzero((np.abs(hand[: len(hand) - len(loop) + 1] - loop[0]) < GRID / 100).all(axis=1))
    return next((int(s) for s in near if np.allclose(hand[s : s + len(loop)], loop, rtol=0, atol=GRID / 100)), -1)


def _whole(lengths: Any) -> NDArray[np.int32]:
    return np.rint(np.asarray(lengths) / GRID).astype(np.int32)


def _pack(paths: Sequence[Points]) -> Arrays:
    """Describe paths by their first points, their samples' number, and the changes of their steps."""
    wholes = [_whole(path) for path in paths]
    changes = [np.diff(np.diff(whole, axis=0), axis=0, prepend=0) for whole in wholes]
    return {
        "first": np.array([whole[0] for whole in wholes], dtype=np.int32),
        "samples": np.array([len(whole) for whole in wholes], dtype=np.int16),
        "changes": np.concatenate(changes).astype(np.int16).T.copy(),
    }


def _unpack(arrays: Mapping[str, NDArray[Any]], name: str) -> Iterator[Points]:
    first, samples = arrays[f"{name}_first"].astype(np.int64), arrays[f"{name}_samples"].astype(np.int64)
    cuts = np.cumsum(samples - 1)[:-1]
    for start, changes in zip(first, np.split(arrays[f"{name}_changes"].T.astype(np.int64), cuts), strict=True):
        steps = np.concatenate([start[None], np.cumsum(changes, axis=0)])
        yield _read_only(np.cumsum(steps, axis=0) * GRID)


def _read_only(array: Points) -> Points:
    """Keep entries from changing what others will see, for sessions are read once for all."""
    array.setflags(write=False)
    return array
