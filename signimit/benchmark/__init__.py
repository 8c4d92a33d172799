"""The benchmark: instructions are unlabelled motion, and what counts is what the hand does.

`signimit.benchmark.studies` compares ways of inferring on the same sessions, from inside. This is the public protocol:
anything with three methods (`Entry`) watches the demonstrations of a session, is asked for something by signs, and
moves a hand at 50 Hz. Splits are named, frozen and shipped, and each is the paper's session with one thing changed.

Entering, splits, scores and scale: docs/benchmark.md. Command: `benchmark`.
"""

from signimit.benchmark.protocol import Entrant as Entrant
from signimit.benchmark.protocol import Entry as Entry
from signimit.benchmark.protocol import Kit as Kit
from signimit.benchmark.protocol import Observation as Observation
from signimit.benchmark.protocol import Oracle as Oracle
from signimit.benchmark.protocol import Truth as Truth
