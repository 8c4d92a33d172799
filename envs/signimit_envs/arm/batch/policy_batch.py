"""The policies of many hands as one policy: those that several hands share are called once for all of them."""

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
        members: Numbers of the hands, shape (G,); that of a lone hand twice, since BLAS adds up a single row in another
            order than one of many, and a hand's velocity should not depend on the number of others.
        policy: Policy of hands (G, 2), m, table frame.
    """

    members: NDArray[np.intp]
    policy: Policy


class PolicyBatch(Policy):
    """Policy of B hands in the table frame, each with a policy of its own; its state is a tuple of their states."""

    def __init__(self, policies: Sequence[Policy | Callable[[Array], ArrayLike]]) -> None:
        """Group the hands by their policies.

        Args:
            policies: Policies of the hands, B of them; those of a `signimit.Response` are the same if only their
                objects' places differ.

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
            shared = policies[several[0]]
            if isinstance(shared, PlacedPolicy):  # each hand about an object of its own
                placed = [policies[number] for number in several]
                shared = shared.at([policy.place for policy in placed if isinstance(policy, PlacedPolicy)])
            self._groups.append(_Group(np.array(several), as_policy(shared)))

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
            where, shape = f"policy of reproduction {group.members[0]}", (len(group.members), 2)
            if wanted.shape != shape:
                expected = f"velocities of shape {shape} for as many hands"
                raise InvalidInputError(where, expected, f"shape {wanted.shape}")
            if not np.isfinite(wanted).all():
                raise InvalidInputError(where, "finite velocities", f"{wanted[~np.isfinite(wanted)][0]}")
            velocities[group.members] = wanted
            states.append(after)
        return tuple(states), velocities
