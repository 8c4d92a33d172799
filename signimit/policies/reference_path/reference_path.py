"""What a movement is, apart from how one gets to it: the course that all its demonstrations share.

Nothing here assumes a circle, a period or that the movement does not cross itself. Candidate courses are taken from
the demonstrations: what lies between a demonstration's end and each earlier moment at which it came by that place
(closed), and the demonstration as a whole (open). The candidate that tells most about all demonstrations with the
fewest nodes is kept and refined by barycentre averaging.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.display import one_line
from signimit.paths import (
    TimedPath,
    arc_lengths,
    box_centre,
    half_size,
    interpolate,
    space_path,
    space_timed_path,
    step_lengths,
)
from signimit.policies.base import CONTROL_PERIOD, Array
from signimit.policies.reference_path.alignment import PhaseAlignment, align_phases
from signimit.policies.reference_path.averaging import MeanPass, cut_passes, mean_pass
from signimit.policies.reference_path.loop_closure import close_loop
from signimit.strokes import Stroke

COARSE, FINE = 110, 360  # points of a typical demonstration, to choose a course and to refine it
LONGEST = 4  # typical lengths; what is longer is sampled more coarsely
MOST_MODELS = 8  # demonstrations that candidate courses are taken from
MOST_CHOSEN_BY = 12  # demonstrations that choose among them
MOST_REFINED_BY = 40  # demonstrations averaged; more add time, not accuracy
RETURN_GAP = 0.8  # half sizes from a demonstration's end, within which an earlier place may have begun its last round
NODE_COST = 0.2  # half sizes; of a node, beside the costs of points: a longer course must pay for itself
INLIERS = 0.8  # of the demonstrations choose the course: a wrong member has no say
FEWEST_ROUNDS = 1.3  # the typical demonstration of a repeating movement goes round at least so often
REFINEMENTS = 3
SHORTEST_PASS = 0.15  # of a round; less is the end of a stroke, not another round
FEWEST_NODES = 5  # of the way to a goal that everybody reaches from another side
SLOWEST = 0.1  # of the mean speed: a longer pause is shortened
FASTEST = 3.0  # of the mean speed: a glitch is slowed down
MOST_NODES = 10_000  # control periods; what would take longer is done faster
CORNER_ALLOWANCE = 1.03  # times the size: a mean of corners that do not quite meet lies inside them


@one_line
class ReferencePath(NamedTuple):
    """The part of a movement that its demonstrations share.

    Attributes:
        points: Nodes at equal steps of length, shape (M, 2), m.
        speeds: Mean speed from each node to the next, shape (M,), m/s; zero where nobody showed it.
        closed: Whether the movement goes round and round, or ends at the last node.
        half_size: Half of the larger extent of the movement, m.
        reach_speed: Mean speed of the demonstrators on their way to the course, m/s.
    """

    points: Array
    speeds: Array
    closed: bool
    half_size: float
    reach_speed: float


def learn_reference_path(demonstrations: Sequence[Stroke]) -> ReferencePath:
    """Find the shared course of demonstrations of one movement."""
    length = float(np.median([arc_lengths(d.points)[-1] for d in demonstrations]))
    chosen = _spread(demonstrations, MOST_CHOSEN_BY)
    coarse = [space_path(d.points, length / COARSE, most=LONGEST * COARSE) for d in chosen]
    unit = float(np.median([half_size(path[len(path) // 2 :]) for path in coarse]))  # the reach is over by then
    points, closed = _choose_path(coarse, unit)
    return _refine_path(_spread(demonstrations, MOST_REFINED_BY), points, closed, unit)


def _spread(demonstrations: Sequence[Stroke], most: int) -> list[Stroke]:
    """Return at most so many demonstrations, evenly spread over all."""
    count = len(demonstrations)
    return [demonstrations[i * count // min(most, count)] for i in range(min(most, count))]


def _candidates(path: Array, unit: float) -> Iterator[tuple[Array, bool]]:
    """Yield possible courses: the rounds that a path's end may close, and the whole path as an open course."""
    gaps = np.hypot(*(path - path[-1]).T)
    for i in range(1, len(path) - 8):
        if gaps[i] <= gaps[i - 1] and gaps[i] < gaps[i + 1] and gaps[i] < RETURN_GAP * unit:
            yield path[i:-1], True
    yield path, False


def _choose_path(paths: Sequence[Array], unit: float) -> tuple[Array, bool]:
    """Return the nodes of the cheapest candidate, and whether it is closed."""
    best, choice = np.inf, (paths[0], False)
    for path in paths[:MOST_MODELS]:
        for points, closed in _candidates(path, unit):
            alignments = align_phases(paths, points, closed, unit)
            if closed and np.median([_rounds(a.phases, len(points)) for a in alignments]) < FEWEST_ROUNDS:
                continue
            costs = np.sort([a.cost for a in alignments])[: int(np.ceil(INLIERS * len(paths)))]
            total = float(costs.mean()) + NODE_COST * len(points)
            if total < best:
                best, choice = total, (points, closed)
    return choice


def _rounds(phases: NDArray[np.int64], nodes: int) -> float:
    drawn = phases[phases >= 0]
    return float(drawn[-1] - drawn[0]) / nodes


def _refine_path(demonstrations: Sequence[Stroke], points: Array, closed: bool, unit: float) -> ReferencePath:
    """Align, average, and begin again with the average."""
    length = float(np.median([arc_lengths(d.points)[-1] for d in demonstrations]))
    spacing = length / FINE
    paths = [space_timed_path(d.points, d.times, spacing, LONGEST * FINE) for d in demonstrations]
    mean = MeanPass(points, points[:, 0], points[:, 0])
    alignments: list[PhaseAlignment] = []
    for _ in range(REFINEMENTS):
        nodes = space_path(mean.points, spacing, closed, LONGEST * FINE)
        alignments = align_phases([p.points for p in paths], nodes, closed, unit)
        shortest = SHORTEST_PASS if closed else 0.0
        passes = [
            one
            for path, alignment in zip(paths, alignments, strict=True)
            for one in cut_passes(path, alignment.phases, len(nodes), shortest)
        ]
        mean = _shared_part(mean_pass(passes), 0.0 if closed else 0.5 * len(paths))
    line, speeds = close_loop(mean.points, mean.speeds, unit) if closed else (mean.points, mean.speeds)
    return ReferencePath(line, speeds, closed, unit, _reach_speed(paths, alignments))


def _shared_part(mean: MeanPass, fewest: float) -> MeanPass:
    """Drop nodes that nobody passed, and the beginning that fewer than so many did: the reach of the model."""
    passed = np.flatnonzero(mean.support > 0)
    begin = int(np.argmax(mean.support[passed] >= fewest))
    if mean.support[passed[begin]] < fewest:
        begin = len(passed)
    kept = passed[min(begin, max(len(passed) - FEWEST_NODES, 0)) :]
    return MeanPass(*(values[kept] for values in mean))


def _reach_speed(paths: Sequence[TimedPath], alignments: Sequence[PhaseAlignment]) -> float:
    """Return the mean speed before the drawing begins, m/s; that of everything if nobody had far to go."""
    begins = [int(np.argmax(a.phases >= 0)) for a in alignments]
    way = sum(arc_lengths(p.points)[i] for p, i in zip(paths, begins, strict=True))
    if sum(begins) < len(paths) * FINE // 50:
        begins = [len(p.points) - 1 for p in paths]
        way = sum(arc_lengths(p.points)[-1] for p in paths)
    return float(way / sum(p.times[i] - p.times[0] for p, i in zip(paths, begins, strict=True)))


def sample_reference_path(path: ReferencePath) -> Array:
    """Return positions one control period apart, shape (K, 2), m, at the mean speed shown at each place.

    A closed path is grown by `CORNER_ALLOWANCE` about the centre of its bounding box.
    """
    line = np.concatenate([path.points, path.points[:1]]) if path.closed else path.points
    steps = step_lengths(line)
    shown = path.speeds[: len(steps)]
    mean = shown[shown > 0].mean() if (shown > 0).any() else path.reach_speed
    speeds = np.clip(np.where(shown > 0, shown, mean), SLOWEST * mean, FASTEST * mean)
    clock = np.concatenate([[0.0], np.cumsum(steps / speeds)])
    count = int(np.clip(np.rint(clock[-1] / CONTROL_PERIOD), 2, MOST_NODES))
    even = np.linspace(0.0, clock[-1], count + 1)
    if not path.closed:
        return interpolate(even, clock, line)
    centre = box_centre(line)
    nodes: Array = centre + CORNER_ALLOWANCE * (interpolate(even[:-1], clock, line) - centre)
    return nodes
