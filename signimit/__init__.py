"""Learn to obey unlabelled signs by watching somebody else obey them.

A re-implementation of, and an advance on, T. Cederborg and P.-Y. Oudeyer, "Imitating Operations On Internal
Cognitive Structures for Language Acquisition", Humanoids 2011.

Notation, here and in every docstring:

======== ============================================================== ===================
symbol   meaning                                                        paper
======== ============================================================== ===================
N        number of demonstrations                                       N
O        number of objects; 0 red, 1 green, 2 blue                      3
W        number of signs in an utterance                                2
P        number of prototype signs                                      3
T        samples of a path                                              N, again
Δ        distance of two paths in two frames, ``(N, N, O, O)`` [rad²]   Δ_{t;k;i;j}
γ        similarity, the inverse of Δ                                   γ_{t;k;i;j}, γ_{t;k}
M        memberships of trajectories in movement groups, ``(N, N)``     m_{m;t}
ω        joint memberships                                              ω_{t;k}
ϖ        weighted mean similarity                                       ϖ_t
ξ        push strength                                                  ξ_{t;k}
======== ============================================================== ===================

Metres, seconds, radians. Table frame: x right, y away from the arm's base, origin at the table's centre.
"""

from signimit.demonstrations import Demonstration as Demonstration
from signimit.demonstrations import DemonstrationSet as DemonstrationSet
from signimit.evaluation import Performance as Performance
from signimit.evaluation import count_turns as count_turns
from signimit.evaluation import performed as performed
from signimit.exceptions import FileFormatError as FileFormatError
from signimit.exceptions import InvalidInputError as InvalidInputError
from signimit.exceptions import MissingDependencyError as MissingDependencyError
from signimit.exceptions import SignimitError as SignimitError
from signimit.exceptions import UnknownNameError as UnknownNameError
from signimit.explanation import Query as Query
from signimit.grouping import Grouping as Grouping
from signimit.grouping import group_movements as group_movements
from signimit.inference import WordOrder as WordOrder
from signimit.inference import infer_focus as infer_focus
from signimit.inference import infer_word_order as infer_word_order
from signimit.learning import ImitationModel as ImitationModel
from signimit.learning import Movement as Movement
from signimit.learning import Response as Response
from signimit.learning import learn as learn
from signimit.policies import POLICY_KINDS as POLICY_KINDS
from signimit.policies import PlacedPolicy as PlacedPolicy
from signimit.policies import Policy as Policy
from signimit.policies import StatefulPolicy as StatefulPolicy
from signimit.policies import load_policy as load_policy
from signimit.policies import make_policy as make_policy
from signimit.policies import run_policy as run_policy
from signimit.signs import SignSpace as SignSpace
from signimit.signs import dtw_distance as dtw_distance
from signimit.signs import normalised_sign as normalised_sign
from signimit.similarity import maximum_similarities as maximum_similarities
from signimit.similarity import policy_distances as policy_distances
from signimit.similarity import policy_similarities as policy_similarities
from signimit.strokes import Stroke as Stroke
from signimit.strokes import StrokeLibrary as StrokeLibrary
from signimit.teaching.composition import GroundTruth as GroundTruth
from signimit.teaching.composition import compose_demonstrations as compose_demonstrations
from signimit.teaching.languages import PAPER_LANGUAGE as PAPER_LANGUAGE
from signimit.teaching.languages import Language as Language
from signimit.teaching.people import synthetic_library as synthetic_library

__version__ = "0.1.0"
