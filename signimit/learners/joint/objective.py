"""The one objective of the joint learner: how well a hypothesis explains all demonstrations, in nats.

Every demonstration *asks* for a movement and an object, in words, and *does* a movement about a place. Mostly both are
the same; a demonstration that answers something else asks for one thing and does another, and one that is beside the
point does nothing that the others do. The objective adds up

- for each movement that is done, the evidence that its drawings are alike and lie alike about their places,
- for each meaning that is asked for, the evidence that its signs are alike,
- for each demonstration, the evidence of its place,

less prices: for each movement, for unequal sizes of movements, for each demonstration that does not do what it asks
for, and for each that is beside the point. A group of n has n (n - 1) / 2 pairs, but n drawings do not tell more than
n - 1 comparisons: its sum over pairs is weighted by 2 / n.
"""

from __future__ import annotations

from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from signimit.inference import WordOrder
from signimit.learners.joint.distance_model import SIGNS, DistanceModel
from signimit.learners.joint.measurements import Measurements

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
_NEAR = 1 / 11  # share of the others that are near: of twelve demonstrations the nearest one
NOTHING = -1  # movement of a demonstration that is beside the point


class Assumptions(NamedTuple):
    """What the objective assumes of people; one setting for everybody, chosen with `study assumptions`.

    Attributes:
        likeness: Dissimilarity at which two drawings are as likely one movement as two, nats, in a typical session.
        typical: Dissimilarity of most drawings to near others, nats, down to which likeness is the same.
        closeness: Nats by which likeness falls for each nat that the session's drawings are closer than typical: who
            repeats themselves closely means something else sooner.
        slope: Nats that a unit of dissimilarity counts.
        most_alike: Nats that a pair of drawings may say at most for one movement: closer than close is no more equal.
        most_unlike: The same against.
        offset_spread: Standard deviation of a drawing's middle about where its movement lies, half sizes.
        area: Of the table, squared half sizes: a drawing that has nothing to do with a place lies anywhere in it.
        most_offset: Nats that the place of a pair may say for one movement.
        least_offset: The same against.
        word_weight: Weight of signs against drawings.
        movement_price: Nats for each movement.
        imbalance_price: Nats for each unit of Pearson's chi-square against movements of equal sizes.
        mistake_price: Nats for a demonstration that does something else than it asks for, besides the choice of what.
        irrelevance_price: Nats for a demonstration that is beside the point.
    """

    likeness: float = -1.0
    typical: float = -5.5
    closeness: float = 0.8
    slope: float = 0.7
    most_alike: float = 2.5
    most_unlike: float = 5.0
    offset_spread: float = 0.25
    area: float = 20.0
    most_offset: float = 3.0
    least_offset: float = -4.0
    word_weight: float = 1.5
    movement_price: float = 3.0
    imbalance_price: float = 1.0
    mistake_price: float = 3.0
    irrelevance_price: float = 5.0


PEOPLE = Assumptions()


class Hypothesis(NamedTuple):
    """What each of N demonstrations does, and what it asks for.

    Attributes:
        movement: That is done, shape (N,); `NOTHING` where it is none of the movements.
        place: Candidate place that it is about, shape (N,).
        asked_movement: That its words ask for, shape (N,).
        asked_focus: What its words ask for it to be about, shape (N,).
    """

    movement: Indices
    place: Indices
    asked_movement: Indices
    asked_focus: Indices

    @property
    def meant(self) -> NDArray[np.bool_]:
        """Whether each demonstration does what it asks for, shape (N,)."""
        return np.asarray((self.movement == self.asked_movement) & (self.place == self.asked_focus))

    def compact(self) -> Self:
        """Number the movements 0, 1, ... in order of first appearance."""
        order = list(dict.fromkeys(m for m in (*self.movement, *self.asked_movement) if m != NOTHING))
        number = np.zeros(max(order) + 2, dtype=np.int64)
        number[order], number[NOTHING] = np.arange(len(order)), NOTHING
        return self._replace(movement=number[self.movement], asked_movement=number[self.asked_movement])


class Scores(NamedTuple):
    """What the objective gains by each choice for each demonstration, given all others; nats.

    Attributes:
        done: By doing a movement about a place, shape (N, K + 1, C); the last movement is a new one. -inf if it would
            leave a movement that somebody else asks for and nobody else shows.
        movement: By asking for a movement, shape (N, K + 1).
        focus: By asking for it to be about a place, shape (N, C).
        shown: Whether somebody else does the movement, shape (N, K + 1).
        mistake: Price of doing a movement when something else is asked for, shape (N, K + 1).
        irrelevance: Price of doing none of the movements, shape (N,).
    """

    done: Array
    movement: Array
    focus: Array
    shown: NDArray[np.bool_]
    mistake: Array
    irrelevance: Array

    @property
    def meant(self) -> Array:
        """Gain by doing what is asked for, shape (N, K + 1, C)."""
        return np.asarray(self.done + self.movement[:, :, None] + self.focus[:, None])

    @property
    def mistaken(self) -> Array:
        """Gain by doing something else than what is asked for, without that of asking, shape (N, K + 1, C)."""
        return np.asarray(self.done - self.mistake[:, :, None])

    @property
    def askable(self) -> Array:
        """Gain by asking for a movement that somebody else shows, shape (N, K + 1); -inf where nobody does."""
        return np.asarray(np.where(self.shown, self.movement, -np.inf))


class Objective:
    """The objective under one word order, with sums over groups that follow the moves of a search."""

    def __init__(self, seen: Measurements, words: Array, order: WordOrder, assumed: Assumptions) -> None:
        """Prepare the evidence.

        Args:
            seen: What was measured.
            words: Evidence of each pair of signs for one meaning, shape (W, N, N), as `word_evidence` gives it.
            order: Which word asks for what.
            assumed: What is assumed of people.
        """
        self._likeness = drawing_evidence(seen.drawings, assumed)
        self._offsets, self._place, self.assumed = seen.offsets, seen.place_evidence, assumed
        self._movement_word, self._focus_word = words[order.movement], words[order.focus]
        self.count, self.places = seen.place_evidence.shape
        self._everyone = np.arange(self.count)

    def start(self, hypothesis: Hypothesis) -> None:
        """Take up a copy of a hypothesis."""
        self.hypothesis = known = Hypothesis(*(values.copy() for values in hypothesis.compact()))
        self._done_sums = np.zeros(
            (self.count, int(max(known.movement.max(), known.asked_movement.max())) + 2, self.places)
        )
        for t in np.flatnonzero(known.movement != NOTHING):
            self._done_sums[:, known.movement[t]] += self._alike(int(t), int(known.place[t]))
        self._movement_sums = self._movement_word @ _members(known.asked_movement, self._done_sums.shape[1])
        self._focus_sums = self._focus_word @ _members(known.asked_focus, self.places)

    def _alike(self, member: int, place: int) -> Array:
        """Evidence that each drawing, from each of its places, is one movement with a member's, shape (N, C)."""
        assumed = self.assumed
        squares = ((self._offsets - self._offsets[member, place]) ** 2).sum(axis=2)
        variance = 4 * assumed.offset_spread**2
        near = np.log(assumed.area / (np.pi * variance)) - squares / variance
        alike = self._likeness[member][:, None] + near.clip(assumed.least_offset, assumed.most_offset)
        alike[member] = 0.0
        return np.asarray(alike)

    def move(self, member: int, movement: int, place: int, asked_movement: int, asked_focus: int) -> None:
        """Let one demonstration do and ask for something else."""
        known = self.hypothesis
        if known.movement[member] != NOTHING:
            self._done_sums[:, known.movement[member]] -= self._alike(member, int(known.place[member]))
        if movement != NOTHING:
            self._done_sums[:, movement] += self._alike(member, place)
        for sums, word, old, new in (
            (self._movement_sums, self._movement_word, known.asked_movement[member], asked_movement),
            (self._focus_sums, self._focus_word, known.asked_focus[member], asked_focus),
        ):
            sums[:, old] -= word[member]
            sums[:, new] += word[member]
        for values, value in zip(known, (movement, place, asked_movement, asked_focus), strict=True):
            values[member] = value
        self._renumber()

    def _renumber(self) -> None:
        known = self.hypothesis
        used = np.unique(np.concatenate([known.movement, known.asked_movement]))
        used = used[used != NOTHING]
        if len(used) == self._done_sums.shape[1] - 1 and used[-1] == len(used) - 1:
            return
        number = np.full(self._done_sums.shape[1] + 1, NOTHING)
        number[used] = np.arange(len(used))
        known.movement[:], known.asked_movement[:] = number[known.movement], number[known.asked_movement]
        self._done_sums = np.pad(self._done_sums[:, used], ((0, 0), (0, 1), (0, 0)))
        self._movement_sums = np.pad(self._movement_sums[:, used], ((0, 0), (0, 1)))

    def scores(self) -> Scores:
        """Compute what each choice for each demonstration gains, given all others."""
        known, assumed = self.hypothesis, self.assumed
        done = known.movement != NOTHING
        member = _members(known.movement, self._done_sums.shape[1])
        own = np.where(done, self._done_sums[self._everyone, known.movement, known.place], 0.0)
        others, sums = member.sum(axis=0) - member, (own @ member) / 2 - member * own[:, None]
        drawn = _weight(others + 1)[:, :, None] * (sums[:, :, None] + self._done_sums)
        drawn -= (_weight(others) * sums)[:, :, None]
        mistakes, before = done & ~known.meant, (others > 0).sum(axis=1)[:, None]
        choice = self._choice(before + (others == 0))
        # A movement more is a choice more for all who do something else than they ask for.
        price = self._price(others) + (mistakes.sum() - mistakes)[:, None] * (choice - self._choice(before))
        asking = _members(known.asked_movement, member.shape[1])
        alone = (member * (others == 0) * (asking.sum(axis=0) - asking)).any(axis=1)
        price += np.where(alone[:, None] & (member == 0), np.inf, 0.0)
        gain = drawn + self._place[:, None] - price[:, :, None]
        movement = self._joining(self._movement_sums, known.asked_movement)
        focus = self._joining(self._focus_sums, known.asked_focus)
        irrelevance = np.where(alone, np.inf, assumed.irrelevance_price)
        return Scores(gain, movement, focus, others > 0, assumed.mistake_price + choice, irrelevance)

    def _joining(self, sums: Array, meaning: Indices) -> Array:
        """Gain of each sign by each meaning, given all others, shape (N, M)."""
        member = _members(meaning, sums.shape[1])
        own = sums[self._everyone, meaning]
        others, rest = member.sum(axis=0) - member, (own @ member) / 2 - member * own[:, None]
        return np.asarray(_weight(others + 1) * (rest + sums) - _weight(others) * rest)

    def _choice(self, movements: NDArray[np.int64] | int) -> Array:
        """Price of the choice what to do by mistake, among so many movements."""
        return np.asarray(np.log(np.maximum(movements, 1) * self.places))

    def _price(self, sizes: Array) -> Array:
        """Price of joining movements, shape (N, K + 1), over leaving them as they are; ``sizes`` without the joiner."""
        before = (sizes > 0).sum(axis=1)[:, None]
        squares, total = (sizes**2).sum(axis=1)[:, None], sizes.sum(axis=1)[:, None]
        after = _imbalance(before + (sizes == 0), squares + 2 * sizes + 1, total + 1)
        change = self.assumed.imbalance_price * (after - _imbalance(before, squares, total))
        return np.asarray(self.assumed.movement_price * (sizes == 0) + change)

    def value(self) -> float:
        """Compute the objective of the hypothesis, nats."""
        known, assumed = self.hypothesis, self.assumed
        done = known.movement != NOTHING
        member = _members(known.movement, self._done_sums.shape[1])
        sizes = member.sum(axis=0)
        own = np.where(done, self._done_sums[self._everyone, known.movement, known.place], 0.0)
        total = (_weight(sizes) * (own @ member)).sum() / 2 + self._place[self._everyone, known.place][done].sum()
        for sums, meaning in ((self._movement_sums, known.asked_movement), (self._focus_sums, known.asked_focus)):
            signs = _members(meaning, sums.shape[1])
            total += (_weight(signs.sum(axis=0)) * (sums[self._everyone, meaning] @ signs)).sum() / 2
        sizes = sizes[sizes > 0]
        total -= assumed.movement_price * len(sizes)
        total -= assumed.imbalance_price * float(_imbalance(len(sizes), (sizes**2).sum(), sizes.sum()))
        mistakes = int((done & ~known.meant).sum())
        total -= (assumed.mistake_price + self._choice(len(sizes))) * mistakes
        return float(total - assumed.irrelevance_price * (~done).sum())


def drawing_evidence(dissimilarities: Array, assumed: Assumptions) -> Array:
    """Evidence of drawings for one movement, shape (N, N), nats; 0 on the diagonal."""
    others = dissimilarities[~np.eye(len(dissimilarities), dtype=bool)].reshape(len(dissimilarities), -1)
    near = np.quantile(others, _NEAR, axis=1, method="lower") if others.size else assumed.typical
    nearest = float(np.median(near))
    likeness = assumed.likeness + assumed.closeness * min(0.0, nearest - assumed.typical)
    alike = (assumed.slope * (likeness - dissimilarities)).clip(-assumed.most_unlike, assumed.most_alike)
    np.fill_diagonal(alike, 0.0)
    return np.asarray(alike)


def word_evidence(distances: Array, assumed: Assumptions, model: DistanceModel = SIGNS) -> Array:
    """Weighted evidence of signs for one meaning, shape (W, N, N), nats; 0 on the diagonals."""
    ratios = assumed.word_weight * model.log_ratios(distances, model.equal_mean)
    ratios[:, np.arange(ratios.shape[1]), np.arange(ratios.shape[1])] = 0.0
    return np.asarray(ratios)


def _members(labels: Indices, count: int) -> Array:
    """Return 1 where a demonstration is of a group, else 0, shape (N, count)."""
    return np.asarray(labels[:, None] == np.arange(count), dtype=np.float64)


def _weight(sizes: Array) -> Array:
    """Weight of a group's sum over pairs, by its size."""
    return np.asarray(np.where(sizes > 1, 2 / np.maximum(sizes, 1), 0.0))


def _imbalance(groups: NDArray[np.int64] | int, squares: Array, total: Array) -> Array:
    """Pearson's chi-square against equal sizes, from the number of groups, and the sums of sizes and their squares."""
    return np.asarray(groups * squares / np.maximum(total, 1) - total)
