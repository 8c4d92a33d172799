"""Learn to obey unlabelled hand signs, from demonstrations in which one person signs and another moves.

A re-implementation of, and an advance on, T. Cederborg and P.-Y. Oudeyer, "Imitating Operations On Internal
Cognitive Structures for Language Acquisition", Humanoids 2011.

Units are metres, seconds and radians. Table frame: x right, y away from the arm's base, origin at the table's centre.

Notation, here and in every docstring:

======  ================================================================  =========================================
symbol  meaning                                                           where
======  ================================================================  =========================================
N       number of demonstrations                                          `DemonstrationSet`
O       number of objects; 0 red, 1 green, 2 blue                         `Demonstration`
W       number of signs in an utterance                                   `Demonstration`
T       number of samples of a path; the paper's N, again                 `Demonstration`
P       number of prototype signs                                         `SignSpace`
t, k    numbers of two demonstrations                                     `policy_distances`
i, j    numbers of an object of t, and of one of k                        `policy_distances`
D       mean squared angle of path t to its nearest points of k           `policy_distances`
Δ       distance of two paths in two frames, (N, N, O, O), rad²           `policy_distances`
γ       similarity, the inverse of Δ, 1/rad²                              `policy_similarities`
M       memberships of trajectories in movement groups, (N, N)            `Grouping`
ω       joint memberships, (N, N)                                         `signimit.grouping.joint_memberships`
ϖ       mean similarity of a trajectory, weighted by ω, (N,)              `signimit.grouping.push_strengths`
ξ       push strength, (N, N)                                             `signimit.grouping.push_strengths`
======  ================================================================  =========================================

From the paper to the code:

==========  ============================================================  =========================================
section     what                                                          where
==========  ============================================================  =========================================
II          the pipeline, with any learner                                `learn`, `ImitationModel`
II          the pipeline as the paper has it                              `signimit.learners.paper`
II-A        demonstrations                                                `Demonstration`, `DemonstrationSet`
II-A        dynamic time warping; signs as similarities to prototypes     `dtw_distance`, `SignSpace`
II-B        Δ, distances of policies in all pairs of frames               `policy_distances`
II-B        γ, similarities, and the largest of each pair                 `policy_similarities`, `maximum_similarities`
II-C        Algorithm 1, movement groups                                  `group_movements`
II-C        focus: the object each demonstration was about                `infer_focus`
II-C        word order                                                    `infer_word_order`
II-D        nearest sign: what an utterance asks for                      `ImitationModel.respond`
II-E        policies                                                      `make_policy`
II-E        the 50 nearest points, ``make_policy(kind="knn")``            `signimit.policies.knn`
II-F        the arm                                                       `signimit_envs.arm`
III         the 36 reproductions                                          `signimit_envs.sessions`
III         what a hand has performed                                     `performed`
figure 4    demonstrations, seen from each object                         `signimit.plots.paper.draw_demonstrations`
figure 5    similarities in all pairs of frames                           `signimit.plots.paper.draw_similarities`
figure 6    largest similarities                                          `signimit.plots.paper.draw_maximum_similarity`
figure 7    reproductions                                                 `signimit.plots.paper.draw_reproductions`
==========  ============================================================  =========================================

Glossary:

request       What is asked: a movement about an object.
utterance     The W signs that ask for it.
command       An utterance and the scene it is made in.
response      The model's answer to a command: movement, focus, policy, confidence.
reproduction  What the hand did on it.
performance   The judge's reading of a reproduction: which movement, about which object, how well.
misfit        Error of a path in half sizes of the drawing that it should be; a half size is half of the larger extent.
operation     What a focus word asks for: a function from a scene to a place. The paper's three are "object 0, 1, 2".
focus         The object that a demonstration or a request is about.
signer        Who makes signs (the paper's interactant).
mover         Who moves (the paper's demonstrator).

Indices, files and messages about input count from 0; sentences about a model, figures and films count from 1.
"""

from signimit.asking import Query
from signimit.demonstrations import Demonstration, DemonstrationSet
from signimit.evaluation import Performance, count_turns, performed
from signimit.exceptions import (
    FileFormatError,
    InvalidInputError,
    MissingDependencyError,
    SignimitError,
    UnknownNameError,
)
from signimit.explanation import Ambiguity, Reasons, Suspicion
from signimit.grouping import Grouping, group_movements
from signimit.inference import WordOrder, infer_focus, infer_word_order
from signimit.learners.base import Belief, Understanding
from signimit.learning import ImitationModel, learn
from signimit.names import Names
from signimit.policies import POLICY_KINDS, PlacedPolicy, Policy, load_policy, make_policy, run_policy
from signimit.policies import StatefulPolicy as StatefulPolicy  # the name of `Policy` in 0.1.0
from signimit.responses import Movement, Response
from signimit.signs import SignSpace, dtw_distance, normalised_sign
from signimit.similarity import maximum_similarities, policy_distances, policy_similarities
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching import PAPER_LANGUAGE, GroundTruth, Language, compose_demonstrations
from signimit.teaching.people import synthetic_library

__version__ = "0.2.0"
__all__ = [  # noqa: RUF022 -- in the order of the paper
    # II-A: what is shown
    "Demonstration", "DemonstrationSet", "Stroke", "StrokeLibrary", "SignSpace", "dtw_distance", "normalised_sign",
    # II-B
    "policy_distances", "policy_similarities", "maximum_similarities",
    # II-C
    "Grouping", "group_movements", "infer_focus", "WordOrder", "infer_word_order",
    # II and II-D: the whole
    "learn", "ImitationModel", "Movement", "Response", "Understanding", "Belief", "Reasons", "Ambiguity", "Suspicion",
    "Query", "Names",
    # II-E
    "Policy", "PlacedPolicy", "POLICY_KINDS", "make_policy", "load_policy", "run_policy",
    # III: what was performed
    "Performance", "performed", "count_turns",
    # lessons
    "Language", "PAPER_LANGUAGE", "GroundTruth", "compose_demonstrations", "synthetic_library",
    # errors
    "SignimitError", "InvalidInputError", "FileFormatError", "UnknownNameError", "MissingDependencyError",
]  # fmt: skip
_ROOMS = ("io", "learners", "policies", "teaching")  # packages that are there after `import signimit`


def __dir__() -> list[str]:
    """Names for tab completion: the public API and the packages behind it."""
    return sorted([*__all__, *_ROOMS, "__version__"])
