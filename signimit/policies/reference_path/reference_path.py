"""What a movement is, apart from how one gets to it: the course that all its demonstrations share.

Nothing here assumes a circle, a period or that the movement does not cross itself. The reach and the way home are cut
off. A movement repeats if most drawings come round again. Candidate courses are taken from the drawings: what lies
between a drawing's end and each earlier moment at which it came by that place if the movement repeats, and whole
drawings if it is made once. The candidate that tells most about all drawings with the fewest nodes is kept and
refined by barycentre averaging.
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
    nearest_distances,
    space_path,
    space_timed_path,
    step_lengths,
)
from signimit.policies.base import CONTROL_PERIOD, Array
from signimit.policies.reference_path.alignment import REACH_COST, PhaseAlignment, align_phases
from signimit.policies.reference_path.averaging import MeanPass, cut_passes, mean_pass
from signimit.policies.reference_path.loop_closure import close_loop
from signimit.segmentation import find_drawing
from signimit.strokes import Stroke

COARSE, FINE = 110, 360  # points of a typical demonstration, to choose a course and to refine it
LONGEST = 4  # typical lengths; what is longer is sampled more coarsely
MOST_MODELS = 8  # demonstrations that candidate courses are taken from
MOST_CHOSEN_BY = 12  # demonstrations that choose among them
MOST_REFINED_BY = 40  # demonstrations averaged; more add time, not accuracy
RETURN_GAP = 0.8  # half sizes from a demonstration's end, within which an earlier place may have begun its last round
NODE_COST = 0.2  # half sizes; of a node, beside the costs of points: a longer course must pay for itself
INLIERS = 0.8  # of the demonstrations choose the course: a wrong member has no say
FEWEST_ROUNDS = (
    1.17  # of a drawing that comes round again; circles drawn once by six people are 1 to 1.16 rounds, one 1.2
)
SAME_ROUND = 0.15  # half sizes, the cost of a point; rounds of one drawing cost 0.03 to 0.1, other shapes 0.3
REFINEMENTS = 3
SHORT_REACH = 0.02  # of a drawing's length; who had less to go shows no speed of a reach
SHORTEST_PASS = 0.15  # of a round; less is the end of a stroke, not another round
FEWEST_NODES = 5  # of the way to a goal that everybody reaches from another side
SLOWEST = 0.1  # of the mean speed: a longer pause is shortened
FASTEST = 3.0  # of the mean speed: a glitch is slowed down
LONGEST_STEP = 0.2  # half sizes in a control period; a hand that is halfway between nodes further apart is at neither
MOST_NODES = 10_000  # control periods; what would take longer is done faster
CORNER_ALLOWANCE = 1.03  # times the size: a mean of corners that do not quite meet lies inside them


@one_line
class ReferencePath(NamedTuple):
    """The part of a movement that its demonstrations share.

    Attributes:
        points: Nodes at equal steps of length, shape (M, 2), m.
        speeds: Mean speed from each node to the next, shape (M,), m/s; zero where nobody showed it.
        closed: Whether the movement goes round and round, or is made once and ends at the last node.
        half_size: Half of the larger extent of the movement, m.
        reach_speed: Mean speed of the demonstrators on their way to the course, m/s.
    """

    points: Array
    speeds: Array
    closed: bool
    half_size: float
    reach_speed: float


def learn_reference_path(demonstrations: Sequence[Stroke], repeat: bool | None = None) -> ReferencePath:
    """Find the shared course of demonstrations of one movement.

    Args:
        demonstrations: Hand paths in the frame of the object, reach and way home included.
        repeat: Whether the movement goes round and round (True), or is made once, whole, as it was drawn (False). Left
            out, it is what most demonstrations show: it repeats if they come round again.
    """
    demonstrations = _spread(demonstrations, MOST_REFINED_BY)
    drawings = [_drawing(d) for d in demonstrations]
    length = float(np.median([arc_lengths(d.points)[-1] for d in drawings]))
    coarse = [space_path(d.points, length / COARSE, most=LONGEST * COARSE) for d in _spread(drawings, MOST_CHOSEN_BY)]
    unit = float(np.median([half_size(path) for path in coarse]))
    points, closed = _choose_path(coarse, unit, repeat)
    return _refine_path(demonstrations, drawings, points, closed, unit)


def _drawing(demonstration: Stroke) -> Stroke:
    """Return a demonstration without the reach and the way home."""
    kept = find_drawing(demonstration.points, demonstration.times)
    return Stroke(demonstration.points[kept], demonstration.times[kept])


def _spread(demonstrations: Sequence[Stroke], most: int) -> list[Stroke]:
    """Return at most so many demonstrations, evenly spread over all."""
    count = len(demonstrations)
    return [demonstrations[i * count // min(most, count)] for i in range(min(most, count))]


def _rounds_of(path: Array, unit: float) -> Iterator[Array]:
    """Yield what may be the last round of a path: from each earlier moment at which it came by its end's place."""
    gaps = np.hypot(*(path - path[-1]).T)
    for i in range(1, len(path) - 8):
        if gaps[i] <= gaps[i - 1] and gaps[i] < gaps[i + 1] and gaps[i] < RETURN_GAP * unit:
            yield path[i:-1]


def _comes_round_again(path: Array) -> bool:
    """Tell whether a drawing is more than a round of one of its own rounds."""
    unit = half_size(path)
    for course in _rounds_of(path, unit):
        (alignment,) = align_phases([path], course, True, unit)
        if alignment.cost <= SAME_ROUND * len(path) and _rounds(alignment.phases, len(course)) >= FEWEST_ROUNDS:
            return True
    return False


def _choose_path(paths: Sequence[Array], unit: float, repeat: bool | None) -> tuple[Array, bool]:
    """Return the nodes of the cheapest candidate, and whether it is closed."""
    models = list(paths[:MOST_MODELS])
    closed = sum(map(_comes_round_again, paths)) > len(paths) / 2 if repeat is None else repeat
    rounds = [course for path in models for course in _rounds_of(path, unit)] if closed else []
    best, choice = np.inf, paths[0]
    for points in rounds + models if repeat or not rounds else rounds:
        costs = np.sort([a.cost for a in align_phases(paths, points, closed, unit)])
        total = float(costs[: int(np.ceil(INLIERS * len(paths)))].mean()) + NODE_COST * len(points)
        if total < best:
            best, choice = total, points
    return choice, closed


def _rounds(phases: NDArray[np.int64], nodes: int) -> float:
    drawn = phases[phases >= 0]
    return float(drawn[-1] - drawn[0]) / nodes


def _refine_path(
    demonstrations: Sequence[Stroke], drawings: Sequence[Stroke], points: Array, closed: bool, unit: float
) -> ReferencePath:
    """Align, average, and begin again with the average."""
    length = float(np.median([arc_lengths(d.points)[-1] for d in drawings]))
    spacing = length / FINE
    paths = [space_timed_path(d.points, d.times, spacing, LONGEST * FINE) for d in drawings]
    if not closed:
        points = _without_reach(points, paths, unit)
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
        mean = mean_pass(passes, nodes, unit, closed)
    line, speeds = close_loop(mean.points, mean.speeds, unit) if closed else (mean.points, mean.speeds)
    begins = [float(p.times[np.argmax(a.phases >= 0)]) for p, a in zip(paths, alignments, strict=True)]
    return ReferencePath(line, speeds, closed, unit, _reach_speed(demonstrations, begins, length))


def _without_reach(points: Array, paths: Sequence[TimedPath], unit: float) -> Array:
    """Return a course without the beginning that most paths never come near: the reach of the model."""
    near = np.mean([nearest_distances(points, p.points) < REACH_COST * unit for p in paths], axis=0)
    begin = int(np.argmax(near >= 0.5))
    return points[min(begin, max(len(points) - FEWEST_NODES, 0)) :]


def _reach_speed(demonstrations: Sequence[Stroke], begins: Sequence[float], length: float) -> float:
    """Return the mean speed before the drawings begin, s, m/s; that of everything if nobody had far to go."""
    ways = [d.points[: max(int(np.searchsorted(d.times, t)), 1)] for d, t in zip(demonstrations, begins, strict=True)]
    way = sum(float(arc_lengths(w)[-1]) for w in ways)
    if way < SHORT_REACH * length * len(ways):
        ways = [d.points for d in demonstrations]
        way = sum(float(arc_lengths(w)[-1]) for w in ways)
    return way / sum(float(d.times[len(w) - 1] - d.times[0]) for d, w in zip(demonstrations, ways, strict=True))


def sample_reference_path(path: ReferencePath) -> Array:
    """Return positions one control period apart, shape (K, 2), m, at the mean speed shown at each place.

    A closed path is grown by `CORNER_ALLOWANCE` about the centre of its bounding box.
    """
    line = np.concatenate([path.points, path.points[:1]]) if path.closed else path.points
    steps = step_lengths(line)
    shown = path.speeds[: len(steps)]
    mean = shown[shown > 0].mean() if (shown > 0).any() else path.reach_speed
    fastest = min(FASTEST * mean, LONGEST_STEP * path.half_size / CONTROL_PERIOD)
    speeds = np.minimum(np.maximum(np.where(shown > 0, shown, mean), SLOWEST * mean), fastest)
    clock = np.concatenate([[0.0], np.cumsum(steps / speeds)])
    count = int(np.clip(np.rint(clock[-1] / CONTROL_PERIOD), 2, MOST_NODES))
    even = np.linspace(0.0, clock[-1], count + 1)
    if not path.closed:
        return interpolate(even, clock, line)
    centre = box_centre(line)
    nodes: Array = centre + CORNER_ALLOWANCE * (interpolate(even[:-1], clock, line) - centre)
    return nodes
