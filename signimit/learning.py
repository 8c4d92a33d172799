"""The model of a session: learned from demonstrations, it answers utterances (paper, section II)."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.asking import Query, choose_query
from signimit.demonstrations import Demonstration, DemonstrationSet
from signimit.exceptions import InvalidInputError, UnknownNameError
from signimit.explanation import Reasons, explain_understanding, summarise
from signimit.inference import WordOrder
from signimit.learners import DEFAULT_METHOD, get_learner
from signimit.learners.base import SignReader, Understanding
from signimit.learners.model_files import ModelParts, read_model, write_model
from signimit.lexicon import Sign, find_lexicon
from signimit.names import Names, carry_names, check_names
from signimit.notebook import model_html
from signimit.policies import DEFAULT_POLICY, Policy, check_policy_kind, make_policy
from signimit.responses import Movement, Response, find_landmarks, find_movements
from signimit.signs import prototype_points
from signimit.strokes import Stroke
from signimit.validation import finite_array, make_generator

LEAST_CONFIDENCE = 0.5  # of an answer; below a half it is more often wrong than right


@dataclass(frozen=True, eq=False)
class ImitationModel:
    """What was learned from demonstrations (paper, section II); made by `learn`, immutable, and saved in files.

    Attributes:
        demonstrations: What was seen.
        understanding: What was inferred.
        method: Name of the learner.
        policy_kind: Kind of policy that its responses use.
        prototypes: Prototype signs, if the method was given any.
        repeat: Whether all movements go round and round, or none does; None if that was left to the evidence.
        given_names: Names that were given to the movements, an empty text for one without; empty if none were.
    """

    demonstrations: DemonstrationSet
    understanding: Understanding
    method: str
    policy_kind: str
    prototypes: tuple[NDArray[np.float64], ...] | None = None
    repeat: bool | None = None
    given_names: tuple[str, ...] = ()
    _policies: dict[int, Policy] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        for array in (self.labels, self.focus, self.trust, *self.understanding.requests, *self.diagnostics.values()):
            array.setflags(write=False)

    def __repr__(self) -> str:
        """Say what it is made of; `summary` says what was understood."""
        seen, kinds = len(self.demonstrations), int(self.labels.max()) + 1
        counts = f"{seen} demonstration{'s' * (seen != 1)}, {kinds} movement{'s' * (kinds != 1)}"
        return f"ImitationModel({counts}, method={self.method!r}, policy_kind={self.policy_kind!r})"

    def _repr_html_(self) -> str:
        """Draw the movements and the lexicon beside the summary, as notebooks show it."""
        return model_html(self)

    @property
    def labels(self) -> NDArray[np.int64]:
        """Movement of each demonstration, shape (N,); -1 where it is none that the others show."""
        return self.understanding.labels

    @property
    def focus(self) -> NDArray[np.int64]:
        """Object each demonstration was about, shape (N,); -1 where it was about none."""
        return self.understanding.focus

    @cached_property
    def trust(self) -> NDArray[np.float64]:
        """Probability that each demonstration was meant as it looks, shape (N,); 1 where the method does not say."""
        known = self.understanding.trust
        return np.ones(len(self.labels)) if known is None else known

    @cached_property
    def lexicon(self) -> tuple[Sign, ...]:
        """The signs that were found, each with its meaning and the demonstrations that show it."""
        return find_lexicon(self.understanding)

    @property
    def word_order(self) -> WordOrder:
        """Which word names the object and which the movement."""
        return self.understanding.word_order

    @property
    def diagnostics(self) -> Mapping[str, NDArray[Any]]:
        """Arrays that show how the learner came to its conclusions; which ones depends on the method."""
        return self.understanding.diagnostics

    @cached_property
    def landmarks(self) -> NDArray[np.float64]:
        """Place each demonstration was about, shape (N, 2), m, table frame: where its focus was; NaN if about none."""
        return find_landmarks(self.demonstrations, self.focus)

    @cached_property
    def movements(self) -> tuple[Movement, ...]:
        """The movements found, each with its members seen from the object they were about."""
        return find_movements(self.demonstrations, self.labels, self.landmarks)

    @cached_property
    def names(self) -> Names:
        """What objects and movements are called in words and figures."""
        drawn = tuple((movement.paths, movement.times) for movement in self.movements)
        return Names(self.demonstrations.object_names or (), self.given_names, drawn)

    @property
    def object_names(self) -> tuple[str, ...]:
        """Name of each object: as the demonstrations have it, or its colour."""
        return tuple(map(self.names.object, range(self.demonstrations.objects.shape[1])))

    @property
    def movement_names(self) -> tuple[str, ...]:
        """Name of each movement: given, or guessed from its shape where that is beyond doubt, or an empty text."""
        return self.names.movement_names

    def with_names(
        self, movement_names: Iterable[str | None] | None = None, object_names: Iterable[str] | None = None
    ) -> Self:
        """Return the same model with other names for words and figures; what is left out keeps its names.

        Args:
            movement_names: One for each of `movements`; None where the name is to be guessed from the shape.
            object_names: One for each object.

        Raises:
            InvalidInputError: If there are more or fewer, or names cannot be printed and told apart.
        """
        demos, given = self.demonstrations, self.given_names
        if movement_names is not None:
            given = check_names(movement_names, "movement_names", len(self.movements), optional=True)
        if object_names is not None:
            demos = DemonstrationSet(demos, object_names)
        return replace(self, demonstrations=demos, given_names=given, _policies=dict(self._policies))

    @cached_property
    def _reader(self) -> SignReader:
        learner = get_learner(self.method)
        return learner.reader(self.demonstrations, self.prototypes, self.understanding)

    def respond(self, signs: Sequence[ArrayLike], objects: ArrayLike) -> Response:
        """Answer an utterance in a scene (paper, section II-D).

        Args:
            signs: The W signs in the order they were made, each of shape (T_s, 2), any unit.
            objects: Object positions, shape (O, 2), m, table frame.

        Returns:
            What was asked for, and the policy that does it.

        Raises:
            InvalidInputError: If there are not as many signs or objects as in the demonstrations.
        """
        utterance, places = self.demonstrations.check_command(signs, objects)
        reading = self._reader.read(utterance)
        movement, focus = int(reading.movement.argmax()), int(reading.focus.argmax())
        confidence = float(reading.movement[movement] * reading.focus[focus] * reading.known)
        return Response(movement, focus, self.policy(movement).at(places[focus]), confidence, self.names)

    def respond_if_sure(
        self, signs: Sequence[ArrayLike], objects: ArrayLike, least: float = LEAST_CONFIDENCE
    ) -> Response | None:
        """Answer as `respond` does, or decline: return None where the confidence is below ``least``.

        Args:
            signs: As for `respond`.
            objects: As for `respond`.
            least: Confidence below which to decline, from 0 (never) to 1; below a half, an answer is more often wrong
                than right.

        Raises:
            InvalidInputError: As `respond`, and if ``least`` is no probability.
        """
        if not 0.0 <= float(finite_array(least, "least", ())) <= 1.0:
            raise InvalidInputError("least", "a probability from 0 to 1", f"{least}")
        response = self.respond(signs, objects)
        return response if response.confidence >= least else None

    def policy(self, movement: int) -> Policy:
        """Return the policy of a movement in the frame of the object it is about; made once, when first asked for.

        Raises:
            UnknownNameError: If there is no such movement.
        """
        if not isinstance(movement, (int, np.integer)) or movement not in range(len(self.movements)):
            raise UnknownNameError("movement", movement, [str(m) for m in range(len(self.movements))])
        if movement not in self._policies:
            _, paths, times = self.movements[movement]
            self._policies[movement] = make_policy(list(paths), list(times), self.policy_kind, self.repeat)
        return self._policies[movement]

    def observe(self, demonstration: Demonstration) -> Self:
        """Return a model of one demonstration more; N distances are measured, not N² as by `learn`.

        Policies that were made already are kept for movements whose demonstrations and foci have not changed.

        Raises:
            InvalidInputError: If it differs in words or objects from the others, or the method cannot go on.
        """
        demos = DemonstrationSet([*self.demonstrations, demonstration], self.demonstrations.object_names)
        understanding = get_learner(self.method).extend(demos, self.understanding)
        if understanding is None:
            raise InvalidInputError("method", "one that learns one demonstration at a time: joint", repr(self.method))
        named = carry_names(self.given_names, self.labels, understanding.labels)
        later = type(self)(demos, understanding, self.method, self.policy_kind, self.prototypes, self.repeat, named)
        made = {self._shown(m): policy for m, policy in self._policies.items()}
        unchanged = {m: later._shown(m) for m in range(len(later.movements)) if later._shown(m) in made}
        later._policies.update({m: made[shown] for m, shown in unchanged.items()})
        return later

    def _shown(self, movement: int) -> tuple[tuple[int, int], ...]:
        """Return all that a policy is made of: the demonstrations of a movement, each with its focus."""
        return tuple((t, int(self.focus[t])) for t in self.movements[movement].members)

    def most_informative(self, scenes: ArrayLike) -> Query:
        """Say what to ask for next, and where, so that the answer teaches most.

        Args:
            scenes: Object positions of the scenes there are to choose from, shape (S, O, 2), m, table frame.

        Returns:
            Signs to make, copied from demonstrations, and the number of the scene.

        Raises:
            InvalidInputError: If there is no scene, one has other objects, or the method has no probabilities to tell.
        """
        return choose_query(self.demonstrations, self.understanding, scenes)

    def explain(self) -> Reasons:
        """Say why: how sure each focus and movement is, what is under suspicion, what speaks for the word order.

        Raises:
            InvalidInputError: If the method has no probabilities to tell.
        """
        return explain_understanding(self.understanding, self.demonstrations.objects, self.names)

    def summary(self) -> str:
        """Say in words what was understood."""
        return summarise(self.understanding, self.demonstrations.objects.shape[1], self.names)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a ``.npz`` file without pickles, whole or not at all."""
        kinds = self.method, self.policy_kind, self.prototypes, self.repeat, self.given_names
        write_model(path, ModelParts(self.demonstrations, self.understanding, *kinds))

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """Read what `save` wrote.

        Raises:
            FileFormatError: If the file is not a whole, sane model.
        """
        return cls(*read_model(path))


def learn(
    demonstrations: DemonstrationSet,
    prototypes: Sequence[Stroke | ArrayLike] | None = None,
    method: str = DEFAULT_METHOD,
    policy: str = DEFAULT_POLICY,
    rng: np.random.Generator | int | None = 0,
    repeat: bool | None = None,
) -> ImitationModel:
    """Understand demonstrations: movements, foci, word order and the meaning of signs (paper, section II).

    Args:
        demonstrations: What was seen, N; nothing else is used.
        prototypes: Strokes that span the paper's sign space; the methods ``"paper"`` and ``"paper-literal"`` need them.
        method: Name of a learner; ``signimit.learners.LEARNERS`` has them.
        policy: Kind of policy for the responses; ``signimit.policies.POLICY_KINDS`` has them.
        rng: Generator, or seed of one; the same seed gives the same model.
        repeat: Whether movements go round and round (True), or are made once and then the hand rests (False). Left
            out, the demonstrations of each movement tell.

    Returns:
        A model that answers utterances.

    Raises:
        InvalidInputError: If something cannot be used.
        UnknownNameError: If there is no such method or policy, or the policy cannot be told whether it repeats.
    """
    if not isinstance(demonstrations, DemonstrationSet):
        raise InvalidInputError("demonstrations", "a DemonstrationSet", type(demonstrations).__name__)
    learner = get_learner(method)
    check_policy_kind(policy, repeat)
    strokes = None if prototypes is None else prototype_points(prototypes)
    understanding = learner.infer(demonstrations, strokes, make_generator(rng))
    return ImitationModel(demonstrations, understanding, method, policy, strokes, repeat)
