"""What several tests of the benchmark need."""

import numpy as np
import pytest

from signimit.benchmark.entries import EntrantReference
from signimit.benchmark.protocol import Kit

STILL = """
class Still:
    def observe(self, demonstrations): self.seen = len(demonstrations)
    def begin(self, signs, objects): self.word = signs[0][0, 0]
    def act(self, observation): return 0.1 * self.word, 0.0
"""


@pytest.fixture
def kit() -> Kit:
    return Kit((), np.random.default_rng(0))


@pytest.fixture(scope="session")
def still() -> EntrantReference:
    """Names an entry that hardly moves, in a way that depends on the signs: cheap to run."""
    return EntrantReference("still.py:Still", STILL)
