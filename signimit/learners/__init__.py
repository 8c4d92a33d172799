"""Ways of understanding demonstrations, one module each, by name."""

from __future__ import annotations

from signimit.exceptions import UnknownNameError
from signimit.learners.base import Learner
from signimit.learners.joint.learner import JointLearner as JointLearner
from signimit.learners.paper import PaperLearner as PaperLearner

LEARNERS: dict[str, Learner] = {
    "joint": JointLearner(),
    "paper": PaperLearner(),
    "paper-literal": PaperLearner(grouping="paper-literal"),
}
DEFAULT_METHOD = "joint"


def get_learner(method: str) -> Learner:
    """Return the learner of that name.

    Raises:
        UnknownNameError: If there is none.
    """
    if not isinstance(method, str) or method not in LEARNERS:
        raise UnknownNameError("method", method, LEARNERS)
    return LEARNERS[method]
