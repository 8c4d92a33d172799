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
from signimit.exceptions import FileFormatError as FileFormatError
from signimit.exceptions import InvalidInputError as InvalidInputError
from signimit.exceptions import MissingDependencyError as MissingDependencyError
from signimit.exceptions import SignimitError as SignimitError
from signimit.exceptions import UnknownNameError as UnknownNameError
from signimit.strokes import Stroke as Stroke
from signimit.strokes import StrokeLibrary as StrokeLibrary

__version__ = "0.1.0"
