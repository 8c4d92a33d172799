"""One policy for many hands, each with a policy of its own: one that several hands share is stepped once for them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit import InvalidInputError, PlacedPolicy, Policy
from signimit.policies import as_policy

Array = NDArray[np.float64]


class _Group(NamedTuple):
    """Hands that one policy moves.

    Attributes:
        members: Their numbers, shape (G,); that of a lone hand twice, since BLAS adds up a single row in another order
            than one of many, and what a hand is told should not depend on the others.
        policy: Of hands (G, 2), m, table frame.
    """

    members: NDArray[np.intp]
    policy: Policy


class PolicyBatch(Policy):
    """The policies of many hands as one, of B hands in the table frame; its state has a state for each policy."""

    def __init__(self, policies: Sequence[Policy | Callable[[Array], ArrayLike]]) -> None:
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
        self._groups, self._count = [], len(policies)
        for numbers in members.values():
            several = numbers if len(numbers) > 1 else 2 * numbers
            self._groups.append(_Group(np.array(several), _shared([policies[number] for number in several])))

    def start(self) -> tuple[Any, ...]:
        """Return the states before the first step."""
        return tuple(group.policy.start() for group in self._groups)

    def step(self, state: tuple[Any, ...], hand: ArrayLike) -> tuple[tuple[Any, ...], Array]:
        """Return the next states and the velocities, shape (B, 2), m/s, of hands of the same shape, m, table frame.

        Raises:
            InvalidInputError: If a policy does not give each of its hands a finite velocity.
        """
        hands, states, velocities = np.asarray(hand), [], np.empty((self._count, 2))
        for group, before in zip(self._groups, state, strict=True):
            after, wanted = group.policy.step(before, hands[group.members])
            velocities[group.members] = _checked(wanted, group)
            states.append(after)
        return tuple(states), velocities


def _shared(policies: Sequence[Policy | Callable[[Array], ArrayLike]]) -> Policy:
    """Return one policy for hands that have the same, each about an object of its own."""
    first = policies[0]
    if not isinstance(first, PlacedPolicy):
        return as_policy(first)
    return first.at([policy.place for policy in policies if isinstance(policy, PlacedPolicy)])


def _checked(velocities: Array, group: _Group) -> Array:
    where, shape = f"policy of reproduction {group.members[0]}", (len(group.members), 2)
    if velocities.shape != shape:
        raise InvalidInputError(where, f"velocities of shape {shape} for as many hands", f"shape {velocities.shape}")
    if not np.isfinite(velocities).all():
        raise InvalidInputError(where, "finite velocities", f"{velocities[~np.isfinite(velocities)][0]}")
    return velocities
