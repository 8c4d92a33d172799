"""What a performed path was, about which object, and how well (paper, section III). For evaluators, not learners.

A path is compared with a drawing by aligning them in order: the end of the path, as long as the drawing and a little,
is resampled by its length, and its samples go through the drawing's points forward, never back. From the alignment
follow the two measures that decide: how far the path is from the drawing and its directions (`Performance.misfit`), and
how much of the drawing was passed, in order (`Performance.coverage`). Nearness alone would not do: half a loop drawn to
and fro, a loop drawn backwards, or a triangle for a circle are near a drawing most of the time.

A path is compared twice: as one drawing from its beginning to its end, and as a piece of what goes round and round,
wherever that began; from the end to the beginning it may go any way.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.drawing_alignment import DrawingAlignment
from signimit.exceptions import InvalidInputError
from signimit.paths import arc_lengths, half_size, headings, interpolate, unit_tangents
from signimit.validation import finite_array, item_list, moving_points

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

TOLERANCE = 0.22  # misfit up to which a path counts as a movement, in half sizes; `study judge`
COVERED = 0.95  # least share of a drawing that must be passed; `study judge`
SIZES = (0.77, 1.34)  # of a path that counts, in sizes of the drawing; by hand: sessions draw 0.75 to 1.33
_SAMPLES = 64  # of a path and of a drawing
_ONCE, _ROUNDS = 1.15, 1.35  # length of the path's end that is compared, in lengths of the drawing
_FITTED_SIZES = (0.85, 1.18)  # within which a drawing is scaled before it is compared
_SHORTEST = 0.3  # of a drawing's length: who went less has performed nothing
_ASIDE = 0.8  # half sizes between the means of path and drawing from which they are not compared
_DETOUR = 0.5  # lengths of the drawing by which the way to what is made once may be longer than straight
_OVERLAP, _OVERLAP_GAP = 0.25, 0.5  # share of the way, half sizes: where a drawing may run past its own beginning


class Performance(NamedTuple):
    """What was performed.

    Attributes:
        movement: Number of the movement, -1 for none of them.
        focus: Number of the object, -1 for none.
        misfit: Misfit of the best candidate, in half sizes of the shown drawing: half of the mean gaps there and
            back, plus twice the mean of 1 - cos of the angle between directions. Infinite if the hand rested.
        coverage: Share of the shown drawing, in [0, 1], that the path passed in order.
        turns: Signed revolutions of the whole path about the candidate object, counter-clockwise positive.
    """

    movement: int
    focus: int
    misfit: float
    coverage: float
    turns: float

    @property
    def path_error(self) -> float:
        """The misfit, by the name that it had in version 0.1.0."""
        return self.misfit


NOTHING = Performance(-1, -1, float("inf"), 0.0, 0.0)


class Template(NamedTuple):
    """A shown drawing, in the object's frame, ready for comparison.

    Attributes:
        points: Points evenly spaced along it, shape (64, 2), m.
        directions: Unit directions there, shape (64, 2).
        drawn: Which points were drawn, shape (64,); the others bridge the end and the beginning.
        length: Of the way through all points, m.
        half_size: Of the drawing, m.
        rounds: Whether the last point is followed by the first.
    """

    points: Array
    directions: Array
    drawn: Mask
    length: float
    half_size: float
    rounds: bool


def make_template(drawing: ArrayLike, rounds: bool = False) -> Template:
    """Prepare one shown drawing.

    What runs past its own beginning is cut there.

    Args:
        drawing: Hand positions, shape (T, 2), m, in the object's frame.
        rounds: Whether it is drawn again and again; else it has a beginning and an end.
    """
    points = moving_points(drawing, "template")
    line = _without_overlap(points)
    drawn_length = float(arc_lengths(line)[-1])
    if rounds:
        line = np.concatenate([line, line[:1]])
    lengths = arc_lengths(line)
    at = np.linspace(0.0, lengths[-1], _SAMPLES, endpoint=not rounds)
    spaced = interpolate(at, lengths, line)
    drawn = at <= drawn_length * (1 + 1e-9)
    return Template(spaced, unit_tangents(spaced, closed=rounds), drawn, float(lengths[-1]), half_size(points), rounds)


def _without_overlap(points: Array) -> Array:
    """Cut a drawing where, late, it passes its own beginning in the same direction."""
    lengths = arc_lengths(points)
    at = np.linspace(0.0, lengths[-1], 4 * _SAMPLES)
    line = interpolate(at, lengths, points)
    gaps = np.where(at >= (1 - _OVERLAP) * at[-1], np.hypot(*(line - line[0]).T), np.inf)
    nearest = int(gaps.argmin())
    directions = unit_tangents(line)
    if gaps[nearest] < _OVERLAP_GAP * half_size(points) and directions[nearest] @ directions[2] > 0.5:
        return line[: nearest + 1]
    return points


def performed(
    path: ArrayLike,
    objects: ArrayLike,
    templates: Sequence[Sequence[ArrayLike]],
    repeat: Sequence[bool | None] | None = None,
) -> Performance:
    """Say which movement a path performed about which object (paper, section III).

    The movement and object with the least misfit count if one of the movement's drawings has a misfit of at most 0.22
    half sizes, at least 95 % of it was passed in order, and the path has its size (0.77 to 1.34). A hand that draws
    from a drawing's beginning to its end has passed it all; a hand that joins elsewhere has once it has gone on for 0.3
    of a round beyond. Shift, sampling and speed do not matter, nor rests.

    Args:
        path: Hand positions, shape (T, 2), m, table frame.
        objects: Object positions, or any other places, shape (O, 2), m, table frame.
        templates: For each movement the drawings that show it, each of shape (T, 2), m, in the object's frame.
        repeat: For each movement, whether it goes round and round (True), is made once and then the hand rests
            (False), or either is accepted (None, as for all if left out).

    Returns:
        The best candidate; movement and focus are -1 if it does not count.

    Raises:
        InvalidInputError: If an array is not finite or has another shape, a movement has no drawing, or ``repeat`` is
            not one for each movement.
    """
    hand, places = finite_array(path, "path", (None, 2)), finite_array(objects, "objects", (None, 2))
    return PathJudge(templates, repeat).judge(hand, places)


class Comparison(NamedTuple):
    """Measures of a path against C pairs of a template and a place; each of shape (C,).

    Attributes:
        template: Index of the template.
        place: Index of the place.
        misfit: In half sizes of the drawing.
        coverage: Share of the drawing that was passed in order.
        size: Size of the path, in sizes of the drawing.
        direct: Whether the way to the drawing was about straight.
    """

    template: NDArray[np.intp]
    place: NDArray[np.intp]
    misfit: Array
    coverage: Array
    size: Array
    direct: Mask


class PathJudge:
    """`performed` with movements that are prepared once.

    Attributes:
        templates: The prepared drawings, in order of movements.
        movement: Movement of each template, shape (K,).
    """

    def __init__(self, templates: Sequence[Sequence[ArrayLike]], repeat: Sequence[bool | None] | None = None) -> None:
        """Prepare the drawings of every movement; arguments and errors as of `performed`."""
        listed = [item_list(d, f"templates of movement {m}") for m, d in enumerate(item_list(templates, "templates"))]
        repeated = [None] * len(listed) if repeat is None else list(repeat)
        if len(repeated) != len(listed):
            raise InvalidInputError("repeat", f"one for each of {len(listed)} movements", f"{len(repeated)}")
        ways = {None: (False, True), False: (False,), True: (True,)}
        made = [
            (m, make_template(drawing, rounds))
            for m, drawings in enumerate(listed)
            for drawing in drawings
            for rounds in ways[repeated[m]]
        ]
        self.templates = [template for _, template in made]
        self.movement = np.array([m for m, _ in made])
        self._points = np.stack([t.points for t in self.templates])
        self._directions = np.stack([t.directions for t in self.templates])
        self._drawn = np.stack([t.drawn for t in self.templates])
        self._lengths = np.array([t.length for t in self.templates])
        self._half_sizes = np.array([t.half_size for t in self.templates])
        self._rounds = np.array([t.rounds for t in self.templates])
        self._once = np.array([repeated[m] is False for m in self.movement])
        self._means, self._spreads = _mean_and_spread(self._points)

    def judge(self, path: Array, places: Array, movements: Sequence[int] | None = None) -> Performance:
        """Say which movement a path performed about which place.

        Args:
            path: Hand positions, shape (T, 2), m, table frame.
            places: Shape (O, 2), m, table frame.
            movements: Those that are considered; left out, all.
        """
        chosen = None if movements is None else np.isin(self.movement, movements)
        found = self.compare(path, places, chosen)
        if not len(found.misfit):
            return NOTHING
        movement, place, same = self.best(found)
        counts = (
            same & self.fits(found) & (found.misfit <= TOLERANCE) & (found.coverage >= COVERED)
        )  # of those that count the nearest is reported, else the one that comes nearest to counting
        key = np.where(counts, found.misfit, np.inf) if counts.any() else found.misfit + 1 - found.coverage
        which = int(np.where(same, key, np.inf).argmin())
        named = (movement, place) if counts.any() else (-1, -1)
        turns = count_turns(path, places[place])
        return Performance(*named, float(found.misfit[which]), float(found.coverage[which]), turns)

    def best(self, found: Comparison) -> tuple[int, int, Mask]:
        """Return the movement and the place with the least misfit, and which comparisons are of them, shape (C,)."""
        least = int(found.misfit.argmin())
        movement, place = self.movement[found.template[least]], found.place[least]
        same = (self.movement[found.template] == movement) & (found.place == place)
        return int(movement), int(place), np.asarray(same)

    def fits(self, found: Comparison) -> Mask:
        """Say where the size is right and, for what is made once, the way there about straight, shape (C,)."""
        sized = (found.size >= SIZES[0]) & (found.size <= SIZES[1])
        return np.asarray(sized & (found.direct | ~self._once[found.template]))

    def compare(self, path: Array, places: Array, chosen: Mask | None = None) -> Comparison:
        """Compare a path, shape (T, 2), m, with templates about places, shape (O, 2), m, table frame.

        Left out are drawings that are much longer than the path, and pairs that lie aside, unless all do.

        Args:
            path: Hand positions.
            places: Where the drawings are placed.
            chosen: Which templates are compared, shape (K,); left out, all.
        """
        lengths = arc_lengths(path) if len(path) else np.zeros(1)
        long_enough = lengths[-1] >= _SHORTEST * self._lengths
        templates = np.flatnonzero(long_enough if chosen is None else long_enough & chosen)
        if not len(templates) or not len(places):
            return Comparison(*(np.zeros(0, int),) * 2, *(np.zeros(0),) * 3, np.zeros(0, bool))
        moved = np.concatenate([[True], np.diff(lengths) > 1e-9 * lengths[-1]])
        path, lengths = path[moved], lengths[moved]
        template_lengths, half_sizes = self._lengths[templates], self._half_sizes[templates]
        means, spreads = _mean_and_spread(_ends(path, lengths, template_lengths))
        scales = (spreads / self._spreads[templates]).clip(*_FITTED_SIZES)
        ways = np.where(self._rounds[templates], _ROUNDS, _ONCE) * template_lengths * scales
        hands = _ends(path, lengths, ways)
        aside = np.linalg.norm(means[:, None] - self._means[templates, None] - places, axis=2) / half_sizes[:, None]
        which, place = np.nonzero((aside <= _ASIDE) | (aside == aside.min()))
        k = templates[which]
        scale, size = scales[which, None, None], half_sizes[which] * scales[which]
        drawings = self._means[k, None] + scale * (self._points[k] - self._means[k, None])
        near = DrawingAlignment(
            (hands[which] - places[place, None]) / size[:, None, None],
            drawings / size[:, None, None],
            self._directions[k],
            self._drawn[k],
            self._rounds[k],
        )
        before = lengths[-1] - np.minimum(ways[which], lengths[-1]) * (1 - near.begun / (_SAMPLES - 1))
        begun = hands[which, near.begun]
        detour = before - np.linalg.norm(begun - path[0], axis=1)
        direct = detour <= _DETOUR * template_lengths[which]
        return Comparison(k, place, near.misfit(), near.coverage(), scales[which] * near.size(), direct)


def _mean_and_spread(points: Array) -> tuple[Array, Array]:
    """Compute the means of point sets, shape (C, n, 2), and the RMS distances from them: (C, 2) and (C,)."""
    means = points.mean(axis=1)
    return means, np.sqrt(((points - means[:, None]) ** 2).sum(axis=2).mean(axis=1))


def _ends(path: Array, lengths: Array, ways: Array) -> Array:
    """Resample the last ``ways``, shape (C,), of a path by its length; all of it if it is shorter: (C, 64, 2)."""
    at = lengths[-1] - np.minimum(ways, lengths[-1])[:, None] * np.linspace(1.0, 0.0, _SAMPLES)
    return interpolate(at.ravel(), lengths, path).reshape(len(ways), _SAMPLES, 2)


def count_turns(path: ArrayLike, centre: ArrayLike) -> float:
    """Count the signed revolutions of a path, shape (T, 2), about a point, counter-clockwise positive."""
    seen = finite_array(path, "path", (None, 2)) - finite_array(centre, "centre", (2,))
    return float(np.diff(np.unwrap(headings(seen))).sum() / (2 * np.pi)) if len(seen) else 0.0
