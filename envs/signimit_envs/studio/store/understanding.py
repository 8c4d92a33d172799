"""From what was demonstrated to what the imitator makes of it, one demonstration at a time where that will do."""

from __future__ import annotations

import logging
import time
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.learning import ImitationModel, learn
from signimit.teaching.scenes import sample_hand, sample_scene
from signimit_envs.studio.page.belief import belief_json, wish_json
from signimit_envs.studio.store.history import Demonstrations, History

_SCENES = 16  # out of which the imitator chooses the one that teaches it most
_log = logging.getLogger(__name__)


class Understood(NamedTuple):
    """What the imitator makes of some demonstrations.

    Attributes:
        shown: The demonstrations.
        model: What was learned; none if nothing could be.
        belief: The same for the page; none before the first demonstration.
        objects: Where objects are for the next demonstration, shape (O, 2), m.
        hand: Where the demonstrator's hand is then, shape (2,), m.
    """

    shown: Demonstrations
    model: ImitationModel | None
    belief: dict[str, Any] | None
    objects: NDArray[np.float64]
    hand: NDArray[np.float64]


def understand(history: History, before: Understood | None) -> Understood:
    """Learn from the demonstrations of a session.

    What cannot be learned from is logged and said in the belief: the session stays, and the person can undo.

    Args:
        history: The session.
        before: What was understood last, to go on from.
    """
    rng = np.random.default_rng([history.created.seed, 1, len(history.shown)])
    hand, scenes = sample_hand(rng), np.array([sample_scene(rng, history.created.objects) for _ in range(_SCENES)])
    if not history.shown:
        return Understood(history.shown, None, None, scenes[0], hand)
    start = time.perf_counter()
    try:
        model = _learned(history.shown, before)
        wish = model.most_informative(scenes)
        belief = {**belief_json(model), "wish": wish_json(model, wish), "seconds": time.perf_counter() - start}
    except Exception as error:  # what was drawn must stay, and can be undone, whatever fails here
        _log.exception("the demonstrations cannot be learned from")
        return Understood(history.shown, None, {"failed": f"This cannot be learned from: {error}"}, scenes[0], hand)
    return Understood(history.shown, model, belief, scenes[wish.scene], hand)


def _learned(shown: Demonstrations, before: Understood | None) -> ImitationModel:
    known = () if before is None else before.shown
    goes_on = len(known) == len(shown) - 1 and all(a is b for a, b in zip(known, shown, strict=False))
    if before is not None and before.model is not None and goes_on:
        return before.model.observe(shown[-1].demonstration)
    return learn(DemonstrationSet(one.demonstration for one in shown))
