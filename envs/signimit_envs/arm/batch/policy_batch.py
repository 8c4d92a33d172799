"""Policies that move many hands: each is called once for all the hands it moves, wherever its objects are."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit import InvalidInputError
from signimit.policies.frames import PlacedPolicy
from signimit_envs.sessions.reproduction import hand_velocities

Array = NDArray[np.float64]
Policy = Callable[[Array], ArrayLike]


class _Group(NamedTuple):
    """Hands that one policy moves.

    Attributes:
        members: Their numbers, shape (G,); that of a lone hand twice, since BLAS adds up a single row in another order
            than one of many, and what a hand is told should not depend on the others.
        move: Hands (G, 2), m, to velocities (G, 2), m/s, table frame.
    """

    members: NDArray[np.intp]
    move: Callable[[Array], Array]


class PolicyBatch:
    """Hands and their policies, from one control step to the next."""

    def __init__(self, policies: Sequence[Policy]) -> None:
        """Find which hands have the same policy.

        Args:
            policies: One a hand; those of a `signimit.Response` are the same if only their objects' places differ.

        Raises:
            InvalidInputError: If one is not a policy.
        """
        members: dict[tuple[type, int], list[int]] = {}
        for number, policy in enumerate(policies):
            if not callable(policy):
                raise InvalidInputError(f"policies: reproduction {number}", "a policy", type(policy).__name__)
            same = policy.policy if isinstance(policy, PlacedPolicy) else policy
            members.setdefault((type(policy), id(same)), []).append(number)
        several = [numbers if len(numbers) > 1 else 2 * numbers for numbers in members.values()]
        self._groups = [_Group(np.array(n), hand_velocities(_merged([policies[i] for i in n]))) for n in several]
        self._count = len(policies)

    def velocities(self, hands: Array) -> Array:
        """Return the velocity of each hand, shape (B, 2), m/s, for hands of the same shape, m, table frame.

        Raises:
            InvalidInputError: If a policy does not give each of its hands a finite velocity.
        """
        wanted = np.empty((self._count, 2))
        for group in self._groups:
            wanted[group.members] = _checked(group.move(hands[group.members]), group)
        return wanted


def _merged(policies: Sequence[Policy]) -> Policy:
    """Return one policy for hands that have the same, each about an object of its own."""
    first = policies[0]
    if not isinstance(first, PlacedPolicy):
        return first
    return replace(first, origin=np.array([policy.origin for policy in policies if isinstance(policy, PlacedPolicy)]))


def _checked(velocities: Array, group: _Group) -> Array:
    where, shape = f"policy of reproduction {group.members[0]}", (len(group.members), 2)
    if velocities.shape != shape:
        raise InvalidInputError(where, f"velocities of shape {shape} for as many hands", f"shape {velocities.shape}")
    if not np.isfinite(velocities).all():
        raise InvalidInputError(where, "finite velocities", f"{velocities[~np.isfinite(velocities)][0]}")
    return velocities
