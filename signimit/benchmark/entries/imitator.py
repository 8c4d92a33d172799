"""The learners of this project as entries: an `ImitationModel` and the policy that it answers with."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.protocol import Entrant, Kit, Observation
from signimit.demonstrations import DemonstrationSet
from signimit.learners.base import Reading, Understanding
from signimit.learning import ImitationModel, learn
from signimit.policies import DEFAULT_POLICY, Policy


class Follower:
    """Base of entries that answer a command with a policy in the table frame."""

    def follow(self, policy: Policy) -> None:
        """Begin to follow a policy."""
        self._policy, self._state = policy, policy.start()

    def act(self, observation: Observation) -> NDArray[np.float64]:
        """Return the policy's velocity for the next control period, shape (2,), m/s."""
        self._state, velocity = self._policy.step(self._state, observation.hand)
        return velocity


class Imitator(Follower):
    """Entry that learns an `ImitationModel` and follows the policies of its responses.

    Attributes:
        understanding: What was inferred.
        reading: What the last utterance asked for, by the model: all weight on its choice.
    """

    understanding: Understanding
    reading: Reading

    def __init__(self, understand: Callable[[DemonstrationSet], ImitationModel]) -> None:
        """Store the function that learns a model from demonstrations."""
        self._understand = understand

    def observe(self, demonstrations: DemonstrationSet) -> None:
        """Learn the model."""
        self._model = self._understand(demonstrations)
        self.understanding = self._model.understanding

    def begin(self, signs: tuple[NDArray[np.float64], ...], objects: NDArray[np.float64]) -> None:
        """Read the utterance."""
        response = self._model.respond(signs, objects)
        self.reading = certain_reading(response.movement, response.focus, len(self._model.movements), len(objects))
        self.follow(response.policy)


def certain_reading(movement: int, focus: int, movements: int, objects: int) -> Reading:
    """Return a reading with all probability on one movement and one object."""
    return Reading(np.eye(movements)[movement], np.eye(objects)[focus])


def learner_entrant(name: str, title: str, method: str, policy: str = DEFAULT_POLICY) -> Entrant:
    """Make the entrant of `signimit.learn` with a method and a kind of policy."""

    def make(kit: Kit) -> Imitator:
        return Imitator(lambda demonstrations: learn(demonstrations, kit.prototypes, method, policy, kit.rng))

    return Entrant(name=name, title=title, make=make)
