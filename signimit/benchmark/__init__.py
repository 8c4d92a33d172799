"""The public benchmark: learners watch demonstrations, are given commands in signs, and are scored by how a hand moves.

Anything with three methods (`Entry`) can take part; it moves the hand at 50 Hz. The sessions of each split are fixed
and shipped; each split is the paper's session with one thing changed. `signimit.benchmark.studies` compares ways of
inferring from inside, and builds on this package.

Entering, splits, scores and scale: docs/benchmark.md. Command: `benchmark`.
"""

from signimit.benchmark.protocol import Entrant as Entrant
from signimit.benchmark.protocol import Entry as Entry
from signimit.benchmark.protocol import Kit as Kit
from signimit.benchmark.protocol import Observation as Observation
from signimit.benchmark.protocol import Oracle as Oracle
from signimit.benchmark.protocol import Truth as Truth
