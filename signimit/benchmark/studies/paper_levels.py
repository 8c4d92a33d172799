"""Levels of the study of the paper's method: what is varied, one factor at a time, and conditions added one by one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from signimit.benchmark.studies.varied_demonstrations import (
    CIRCLE_AGAINST,
    DOWN_AGAINST,
    ONE_SENSE,
    UP_AGAINST,
    Variation,
)
from signimit.policies.knn import NEIGHBOURS

FIRST = ("random", "near identity")  # M_1 of Algorithm 1
LADDERS = ("added one by one", "all but one")  # factors that stand for many conditions


class Level(NamedTuple):
    """One value of one factor, all else being equal.

    Attributes:
        factor: What is varied.
        value: Its value, in words.
        variation: How demonstrations are drawn.
        first: M_1 of Algorithm 1, one of `FIRST`.
        neighbours: k of the policy.
        steady: Whether the hand goes at constant speed in the mean direction; else as slowly as directions cancel.
    """

    factor: str
    value: str
    variation: Variation
    first: str = "random"
    neighbours: int = NEIGHBOURS
    steady: bool = False


def factor_levels(senses: tuple[int, int, int]) -> list[Level]:
    """Return every level of every factor, varied one at a time from the usual demonstrations in these senses."""
    base = Variation(senses=senses)
    changes: dict[str, dict[str, dict[str, Any]]] = {
        "spacing of points": {"as the hand moved": {}, "evenly spaced": {"pace": "even"}},
        "shape": {"as drawn": {}, "ideal": {"shape": "ideal"}},
        "scatter, half sizes": {
            "one, repeated": {"one_drawing": True},
            "people's": {},
            "+ 0.05": {"waver": 0.05},
            "+ 0.1": {"waver": 0.1},
        },
        "rounds": {"1": {"rounds": 1}, "2": {}, "3": {"rounds": 3}, "6": {"rounds": 6}},
        "points a second": {"12": {"density": 0.25}, "50": {}, "125": {"density": 2.5}, "200": {"density": 4.0}},
        "reach": {
            "none": {"reach": "none"},
            "to the nearest point": {"reach": "to the nearest point"},
            "to the beginning": {},
        },
        "half size, cm": {"10.5": {"sizes": (0.105, 0.105)}, "9-12": {}, "6-15": {"sizes": (0.06, 0.15)}},
        "objects apart, cm": {
            "5": {"separation": 0.05},
            "14": {},
            "25": {"separation": 0.25},
            "40": {"separation": 0.4},
        },
    }
    levels = [
        Level(factor, value, replace(base, **change))
        for factor, values in changes.items()
        for value, change in values.items()
    ]
    levels += [Level("M_1", first, base, first=first) for first in FIRST]
    return levels


def policy_levels() -> list[Level]:
    """Return the levels of k and of the hand's speed; the grouping does not depend on them."""
    counts = (1, 5, 10, 20, NEIGHBOURS, 100, 200)
    speeds = {"mean of the outputs": False, "constant": True}
    levels = [Level("k nearest points", str(k), Variation(), neighbours=k) for k in counts]
    return levels + [Level("speed of the hand", name, Variation(), steady=steady) for name, steady in speeds.items()]


def sense_levels() -> list[Level]:
    """Return who of the three movements turns against the others."""
    named = {"none": ONE_SENSE, "triangle up": UP_AGAINST, "triangle down": DOWN_AGAINST, "circle": CIRCLE_AGAINST}
    return [Level("which turns the other way", name, Variation(senses=senses)) for name, senses in named.items()]


STEPS_UP: dict[str, dict[str, Any]] = {
    "one sense": {"senses": ONE_SENSE},
    "circle against": {"senses": CIRCLE_AGAINST},
    "even points": {"pace": "even"},
    "M_1 near identity": {},
    "reach to the nearest point": {"reach": "to the nearest point"},
    "125 points a second": {"density": 2.5},
    "constant speed": {},
    "one size": {"sizes": (0.105, 0.105)},
    "one drawing": {"one_drawing": True},
}
"""Conditions in the order in which they are added, one on top of the other; 125 reports a second are a mouse's."""


def ladder_levels() -> list[Level]:
    """Return conditions added one by one, and then all of them but one."""
    levels, names = [], list(STEPS_UP)
    for count in range(1, len(names) + 1):
        levels.append(_with_all(LADDERS[0], ("+ " * (count > 1)) + names[count - 1], names[:count]))
    levels += [_with_all(LADDERS[1], "without " + name, [n for n in names if n != name]) for name in names[1:]]
    levels.append(_with_all(LADDERS[1], "and without circle against", [n for n in names[:-1] if n != "circle against"]))
    return levels


def _with_all(factor: str, value: str, names: Sequence[str]) -> Level:
    changes: dict[str, Any] = {}
    for name in names:
        changes |= STEPS_UP[name]
    first, steady = FIRST["M_1 near identity" in names], "constant speed" in names
    return Level(factor, value, replace(Variation(), **changes), first=first, steady=steady)


def study_levels() -> list[Level]:
    """Return all levels of the study; those of every factor twice, in one sense and with the circle against."""
    factors = [*factor_levels(CIRCLE_AGAINST), *factor_levels(ONE_SENSE)]
    return [*sense_levels(), *factors, *policy_levels(), *ladder_levels()]
