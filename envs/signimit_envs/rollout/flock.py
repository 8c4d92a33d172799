"""Policies that move many hands: each is called once for all the hands it moves, wherever its objects are."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit import InvalidInputError
from signimit.frames import TablePolicy
from signimit_envs.reproduction import hand_velocities

Array = NDArray[np.float64]
Policy = Callable[[Array], ArrayLike]


@dataclass(frozen=True)
class _Group:
    """Hands that one policy moves.

    Attributes:
        members: Their numbers, shape (G,); that of a lone hand twice, since BLAS adds up a single row in another order
            than one of many, and what a hand is told should not depend on the others.
        origins: Where the objects are that they move about, shape (G, 2), m.
        move: Hands (G, 2) in the objects' frames, m, to velocities (G, 2), m/s.
    """

    members: NDArray[np.intp]
    origins: Array
    move: Callable[[Array], Array]


class Flock:
    """Hands and their policies, from one control step to the next."""

    def __init__(self, policies: Sequence[Policy]) -> None:
        """Find which hands have the same policy.

        Args:
            policies: One a hand; those of a `signimit.Response` are the same if only their objects' places differ.

        Raises:
            InvalidInputError: If one is not a policy.
        """
        members: dict[int, list[int]] = {}
        movers: dict[int, Any] = {}
        origins = np.zeros((len(policies), 2))
        for number, policy in enumerate(policies):
            if not callable(policy):
                raise InvalidInputError(f"policies: reproduction {number}", "a policy", type(policy).__name__)
            mover: Any = policy
            if isinstance(policy, TablePolicy):
                mover, origins[number] = policy.policy, policy.origin
            movers[id(mover)] = mover
            members.setdefault(id(mover), []).append(number)
        self._groups = []
        for key, numbers in members.items():
            several = np.array(numbers if len(numbers) > 1 else 2 * numbers)
            self._groups.append(_Group(several, origins[several], hand_velocities(movers[key])))
        self._count = len(policies)

    def velocities(self, hands: Array) -> Array:
        """Return the velocity of each hand, shape (B, 2), m/s, for hands of the same shape, m, table frame.

        Raises:
            InvalidInputError: If a policy does not give each of its hands a finite velocity.
        """
        wanted = np.empty((self._count, 2))
        for group in self._groups:
            wanted[group.members] = _checked(group.move(hands[group.members] - group.origins), group)
        return wanted


def _checked(velocities: Array, group: _Group) -> Array:
    where, shape = f"policy of reproduction {group.members[0]}", (len(group.members), 2)
    if velocities.shape != shape:
        raise InvalidInputError(where, f"velocities of shape {shape} for as many hands", f"shape {velocities.shape}")
    if not np.isfinite(velocities).all():
        raise InvalidInputError(where, "finite velocities", f"{velocities[~np.isfinite(velocities)][0]}")
    return velocities
