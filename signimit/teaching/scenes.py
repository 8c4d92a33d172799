"""Scenes and hand paths on the table: object positions, starts of the hand, reaches and drawn strokes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from signimit import paths
from signimit.exceptions import InvalidInputError
from signimit.policies import CONTROL_PERIOD
from signimit.strokes import Stroke

SCENE_HALF_EXTENT = (0.22, 0.18)  # m, objects and starts lie within this of the table's centre
LEAST_SEPARATION = 0.14  # m, between two objects
REACH_SPEED = 0.35  # m/s, mean
DRAWING_SPEED = (0.2, 0.4)  # m/s, mean; recordings made with a stylus on a small screen are brought into it
CANDIDATES, RESTARTS = 64, 100  # places tried before all objects are taken off again, and how often that happens


def sample_scene(rng: np.random.Generator, objects: int = 3) -> NDArray[np.float64]:
    """Draw positions of objects, shape (O, 2), m, table frame, one after the other, at least 0.14 m apart.

    Raises:
        InvalidInputError: If that many objects do not fit.
    """
    for _ in range(RESTARTS):
        scene = np.empty((0, 2))
        for candidate in rng.uniform(-1.0, 1.0, (CANDIDATES, 2)) * SCENE_HALF_EXTENT:
            if (np.linalg.norm(scene - candidate, axis=1) >= LEAST_SEPARATION).all():
                scene = np.concatenate([scene, candidate[None]])
            if len(scene) == objects:
                return scene
    raise InvalidInputError("scene", f"objects that fit {LEAST_SEPARATION} m apart", f"{objects}")


def sample_hand(rng: np.random.Generator) -> NDArray[np.float64]:
    """Draw where a hand starts, shape (2,), m, table frame."""
    return rng.uniform(-1.0, 1.0, 2) * SCENE_HALF_EXTENT


def reaching_path(
    start: NDArray[np.float64], end: NDArray[np.float64], period: float = CONTROL_PERIOD
) -> NDArray[np.float64]:
    """Return a straight minimum-jerk reach from ``start`` to just short of ``end``, shape (T, 2), every ``period`` s.

    Source: T. Flash and N. Hogan, J. Neuroscience 5, 1985 (doi:10.1523/JNEUROSCI.05-07-01688.1985).
    """
    steps = max(2, round(float(np.linalg.norm(end - start)) / REACH_SPEED / period))
    s = np.linspace(0.0, 1.0, steps, endpoint=False)[:, None]
    path: NDArray[np.float64] = start + (end - start) * (10 * s**3 - 15 * s**4 + 6 * s**5)
    return path


def drawn_path(
    stroke: Stroke, half_size: float, end_at_object: bool = False, period: float = CONTROL_PERIOD
) -> NDArray[np.float64]:
    """Return a stroke as a hand draws it about an object at the origin, every ``period`` s, shape (T, 2), m.

    The person's own time profile is kept; the whole is slowed or hastened into a mean speed that hands have.

    Args:
        stroke: The stroke, any unit.
        half_size: Half of the larger side of its bounding box on the table, m.
        end_at_object: Put the last point at the origin, not the centre of the bounding box.
        period: Time between two points, s.
    """
    origin = stroke.points[-1] if end_at_object else paths.box_centre(stroke.points)
    points = (stroke.points - origin) * (half_size / paths.half_size(stroke.points))
    times = stroke.times - stroke.times[0]
    length = float(paths.arc_lengths(points)[-1])
    duration = float(np.clip(times[-1], length / DRAWING_SPEED[1], length / DRAWING_SPEED[0]))
    ticks = np.linspace(0.0, times[-1], max(2, round(duration / period) + 1))
    return paths.interpolate(ticks, times, points)


def sample_times(count: int) -> NDArray[np.float64]:
    """Return when a hand path was sampled, every 20 ms from 0, shape (T,), s."""
    return np.arange(count, dtype=np.float64) * CONTROL_PERIOD
