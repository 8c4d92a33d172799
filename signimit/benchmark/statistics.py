"""Shares and means of scores, with 95 % intervals that allow for clusters: commands of a session are dependent."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import stdtrit

from signimit.io.safe_files import Record

_Z = 1.959963984540054  # standard normal quantile of 0.975


def wilson_interval(count: float, total: float) -> tuple[float, float]:
    """Compute Wilson's 95 % interval of a share (doi:10.1080/01621459.1927.10502953); (0, 1) of none."""
    if not total:
        return 0.0, 1.0
    share, spread = count / total, _Z**2 / total
    centre = (share + spread / 2) / (1 + spread)
    half = math.sqrt(share * (1 - share) * spread + spread**2 / 4) / (1 + spread)
    return max(0.0, centre - half), min(1.0, centre + half)


def share_text(count: int, total: int) -> str:
    """Say a share with its n and Wilson's 95 % interval, e.g. ``19 of 20: 95.0 % [76.4, 99.1]``."""
    low, high = wilson_interval(count, total)
    return f"{count} of {total}: {100 * count / max(1, total):.1f} % [{100 * low:.1f}, {100 * high:.1f}]"


@dataclass(frozen=True)
class Share:
    """A count out of a total.

    Attributes:
        count: How many.
        total: Of how many.
    """

    count: int
    total: int

    @classmethod
    def of(cls, verdicts: Iterable[bool]) -> Share:
        """Count what is true."""
        known = [bool(v) for v in verdicts]
        return cls(sum(known), len(known))

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's 95 % interval of the share; (0, 1) of none."""
        return wilson_interval(self.count, self.total)

    def __str__(self) -> str:
        """Say e.g. ``36 of 36 (95 % interval 0.90 to 1.00)``."""
        low, high = self.interval
        return f"{self.count} of {self.total} (95 % interval {low:.2f} to {high:.2f})"


@dataclass(frozen=True)
class Estimate:
    """A mean of scores.

    Attributes:
        mean: The mean.
        low: Lower end of its 95 % interval.
        high: Upper end.
        total: Sum of the scores.
        count: How many there are.
    """

    mean: float
    low: float
    high: float
    total: float
    count: int


class Stage(NamedTuple):
    """A stage of a session that is scored.

    Attributes:
        title: Head of its column.
        meaning: What it is.
    """

    title: str
    meaning: str


STAGES: dict[str, Stage] = {
    "groups": Stage("groups", "adjusted Rand index of the movements found in the demonstrations"),
    "focus": Stage("focus", "demonstrations whose object was inferred right"),
    "order": Stage("word order", "sessions in which both words have their right place"),
    "read": Stage("signs", "signs of the commands, two each, that were read right"),
    "obeyed": Stage("obeyed", "commands after which the hand had done what was asked for"),
    "misfit": Stage("misfit", "of the hand's path to what was asked for, in half sizes of the drawings, 3 at worst"),
    "families": Stage("families", "counterfactual families all of whose four commands were obeyed"),
}


def estimate_stage(stage: str, records: Sequence[Record], worst_misfit: float) -> Estimate | None:
    """Estimate one of `STAGES` from sessions of one split; None if it was not scored in all of them.

    No misfit in the records is larger than ``worst_misfit`` half sizes.
    """
    if not records or not all(("families" if stage == "families" else stage) in r for r in records):
        return None
    scores = [_session_scores(stage, r) for r in records]
    sums, counts = [s for s, _ in scores], [n for _, n in scores]
    return estimate_misfit(sums, counts, worst_misfit) if stage == "misfit" else estimate_share(sums, counts)


def _session_scores(stage: str, record: Record) -> tuple[float, int]:
    """Return the sum and the number of a session's scores of a stage."""
    if stage == "families":
        whole: dict[int, bool] = {}
        for family, obeyed in zip(record["families"], record["obeyed"], strict=True):
            whole[family] = whole.get(family, True) and bool(obeyed)
        return float(sum(whole.values())), len(whole)
    scores = record[stage]
    if not isinstance(scores, list):
        return float(scores), 1
    return float(sum(scores)), len(scores) * (2 if stage == "read" else 1)


def estimate_share(sums: ArrayLike, counts: ArrayLike) -> Estimate:
    """Estimate the mean of clustered scores in [0, 1]: shares, or verdicts that are 0 or 1.

    Wilson's interval, with as many independent scores as the spread between clusters leaves: p (1 - p) over the
    variance of the mean, but not fewer than clusters nor more than scores (E. L. Korn and B. I. Graubard, Survey
    Methodology 24, 1998). One cluster counts as one score; where all are right, or none, no spread shows, and all
    count. No variable in [0, 1] spreads more than a coin of the same mean, so that this holds for shares, too.

    Args:
        sums: Sum of the scores of each cluster, shape (n,).
        counts: How many scores each has, shape (n,).
    """
    total, count = np.asarray(sums, dtype=np.float64), np.asarray(counts, dtype=np.float64)
    scores = float(count.sum())
    mean = float(total.sum() / scores)
    share, variance = min(1.0, max(0.0, mean)), _variance_of_mean(total, count)  # a Rand index may be below 0
    effective = scores if len(total) > 1 else 1.0
    if variance > 0 and 0 < share < 1:
        effective = min(scores, max(float(len(total)), share * (1 - share) / variance))
    low, high = wilson_interval(share * effective, effective)
    return Estimate(mean, min(low, mean), max(high, mean), float(total.sum()), int(scores))


def estimate_misfit(sums: ArrayLike, counts: ArrayLike, worst: float) -> Estimate:
    """Estimate the mean of lengths in [0, worst] that come in clusters, with Student's interval; all of it of one."""
    total, count = np.asarray(sums, dtype=np.float64), np.asarray(counts, dtype=np.float64)
    mean, clusters = float(total.sum() / count.sum()), len(total)
    low, high = 0.0, worst
    if clusters > 1:
        half = float(stdtrit(clusters - 1, 0.975)) * float(np.sqrt(_variance_of_mean(total, count)))
        low, high = max(0.0, mean - half), min(worst, mean + half)
    return Estimate(mean, low, high, float(total.sum()), int(count.sum()))


def _variance_of_mean(total: NDArray[np.float64], count: NDArray[np.float64]) -> float:
    """Return the ratio estimator's variance of the mean; 0 of one cluster, which has none."""
    clusters, mean = len(total), total.sum() / count.sum()
    if clusters < 2:
        return 0.0
    return float(clusters / (clusters - 1) * ((total - mean * count) ** 2).sum() / count.sum() ** 2)
