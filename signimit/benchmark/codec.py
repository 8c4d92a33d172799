"""Sessions as arrays of whole numbers: small, and the same on every machine.

Lengths are kept to 0.05 mm. A path is its first point, and the change of its step from
sample to sample, which is small because hands move smoothly.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.commands import Command
from signimit.benchmark.sessions import BenchmarkSession
from signimit.benchmark.splits import Split
from signimit.demonstrations import Demonstration, DemonstrationSet
from signimit.teaching.composition import GroundTruth
from signimit.teaching.languages import Request
from signimit.teaching.scenes import sample_times

GRID = 5e-5  # m
Arrays = dict[str, NDArray[Any]]
Path = NDArray[np.float64]


def encode_sessions(sessions: Sequence[BenchmarkSession]) -> Arrays:
    """Turn sessions of one split into arrays; all have as many demonstrations and commands."""
    hands = [d.hand for s in sessions for d in s.demonstrations]
    shown = [sign for s in sessions for d in s.demonstrations for sign in d.signs]
    asked = [sign for s in sessions for c in s.commands for sign in c.signs]
    prototypes = [p for s in sessions for p in s.prototypes]
    arrays: Arrays = {"seeds": np.array([s.seed for s in sessions], dtype=np.int32)}
    for name, paths in {"hands": hands, "shown": shown, "asked": asked, "prototypes": prototypes}.items():
        arrays |= {f"{name}_{part}": array for part, array in _pack(paths).items()}
    arrays["loops"] = np.array([_loop_bounds(s) for s in sessions], dtype=np.int16)
    arrays["shown_objects"] = _whole([s.demonstrations.objects for s in sessions])
    arrays["asked_objects"] = _whole([[c.objects for c in s.commands] for s in sessions])
    arrays["asked_hands"] = _whole([[c.hand for c in s.commands] for s in sessions])
    arrays["meant"] = np.array([s.truth.requests for s in sessions], dtype=np.int8)
    arrays["requests"] = np.array([[c.request for c in s.commands] for s in sessions], dtype=np.int8)
    arrays["families"] = np.array([[c.family for c in s.commands] for s in sessions], dtype=np.int8)
    return arrays


def decode_sessions(split: Split, arrays: Mapping[str, NDArray[Any]]) -> tuple[BenchmarkSession, ...]:
    """Undo `encode_sessions`, up to the grid.

    Raises:
        KeyError: If an array is missing.
    """
    hands, shown, asked, prototypes = (_unpack(arrays, name) for name in ("hands", "shown", "asked", "prototypes"))
    sessions = []
    for number, seed in enumerate(arrays["seeds"].tolist()):
        demonstrations = _demonstrations(split, hands, shown, arrays["shown_objects"][number] * GRID)
        truth = _truth(split, demonstrations, arrays["meant"][number], arrays["loops"][number])
        session = BenchmarkSession(
            split=split,
            seed=seed,
            demonstrations=demonstrations,
            prototypes=tuple(islice(prototypes, len(split.language.prototypes))),
            truth=truth,
            commands=tuple(_commands(split, asked, arrays, number)),
        )
        sessions.append(session)
    return tuple(sessions)


def digest(arrays: Mapping[str, NDArray[Any]]) -> str:
    """Return the SHA-256 of arrays, whatever the byte order of the machine."""
    sha = hashlib.sha256()
    for name, array in sorted(arrays.items()):
        sha.update(f"{name} {array.shape} ".encode())
        sha.update(array.astype(array.dtype.newbyteorder("<")).tobytes())
    return sha.hexdigest()


def _demonstrations(split: Split, hands: Iterator[Path], signs: Iterator[Path], objects: Path) -> DemonstrationSet:
    made = []
    for places in objects:
        hand, utterance = next(hands), tuple(islice(signs, split.language.words))
        made.append(Demonstration(utterance, places, hand, sample_times(len(hand))))
    return DemonstrationSet(made)


def _truth(split: Split, shown: DemonstrationSet, meant: NDArray[Any], loops: NDArray[Any]) -> GroundTruth:
    templates: list[list[Path]] = [[] for _ in split.language.movements]
    for demonstration, (movement, focus), bounds in zip(shown, meant.tolist(), loops.tolist(), strict=True):
        for start, stop in bounds:
            templates[movement].append(demonstration.hand[start:stop] - demonstration.objects[focus])
    movement_of, focus_of = meant.astype(np.int64).T
    return GroundTruth(split.language, movement_of, focus_of, tuple(tuple(t) for t in templates))


def _commands(split: Split, signs: Iterator[Path], arrays: Mapping[str, NDArray[Any]], number: int) -> list[Command]:
    names = ("requests", "asked_objects", "asked_hands", "families")
    made = []
    for request, objects, hand, family in zip(*(arrays[name][number] for name in names), strict=True):
        utterance = tuple(islice(signs, split.language.words))
        places = _read_only(objects * GRID), _read_only(hand * GRID)
        made.append(Command(Request(*request.tolist()), utterance, *places, int(family)))
    return made


def _loop_bounds(session: BenchmarkSession) -> list[list[tuple[int, int]]]:
    """Find where in each hand path the drawings to judge by are."""
    unplaced = [list(drawings) for drawings in session.truth.templates]
    bounds = []
    for demonstration, (movement, focus) in zip(session.demonstrations, session.truth.requests, strict=True):
        found, origin = [], demonstration.objects[focus]
        while unplaced[movement] and (start := _place_of(unplaced[movement][0] + origin, demonstration.hand)) >= 0:
            loop = unplaced[movement].pop(0)
            found.append((start, start + len(loop)))
        bounds.append(found)
    return bounds


def _place_of(loop: Path, hand: Path) -> int:
    """Return where a drawing begins in a path, -1 if nowhere; tolerant, for a decoded path was rounded."""
    near = np.flatnonzero((np.abs(hand[: len(hand) - len(loop) + 1] - loop[0]) < GRID / 100).all(axis=1))
    return next((int(s) for s in near if np.allclose(hand[s : s + len(loop)], loop, rtol=0, atol=GRID / 100)), -1)


def _whole(lengths: Any) -> NDArray[np.int32]:
    return np.rint(np.asarray(lengths) / GRID).astype(np.int32)


def _pack(paths: Sequence[Path]) -> Arrays:
    """Describe paths by their first points, their samples' number, and the changes of their steps."""
    wholes = [_whole(path) for path in paths]
    changes = [np.diff(np.diff(whole, axis=0), axis=0, prepend=0) for whole in wholes]
    return {
        "first": np.array([whole[0] for whole in wholes], dtype=np.int32),
        "samples": np.array([len(whole) for whole in wholes], dtype=np.int16),
        "changes": np.concatenate(changes).astype(np.int16).T.copy(),
    }


def _unpack(arrays: Mapping[str, NDArray[Any]], name: str) -> Iterator[Path]:
    first, samples = arrays[f"{name}_first"].astype(np.int64), arrays[f"{name}_samples"].astype(np.int64)
    cuts = np.cumsum(samples - 1)[:-1]
    for start, changes in zip(first, np.split(arrays[f"{name}_changes"].T.astype(np.int64), cuts), strict=True):
        steps = np.concatenate([start[None], np.cumsum(changes, axis=0)])
        yield _read_only(np.cumsum(steps, axis=0) * GRID)


def _read_only(array: Path) -> Path:
    """Keep entries from changing what others will see, for sessions are read once for all."""
    array.setflags(write=False)
    return array
