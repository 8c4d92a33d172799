"""Policies of people whose hands go home, tremble or stop early draw what was shown."""

from __future__ import annotations

import numpy as np
import pytest

from signimit.benchmark.studies.path_quality import judge_path
from signimit.policies import make_policy, run_policy
from signimit.teaching.composition import compose_demonstrations
from signimit.teaching.imperfections import Imperfection, go_home, stop_early, tremble
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit.teaching.people import SIGN_LABELS, synthetic_library
from signimit.teaching.stroke_sampler import StrokeSampler


@pytest.mark.parametrize("imperfections", [(go_home,), (tremble,), (stop_early,), (stop_early, tremble)])
def test_imperfect_demonstrations_teach_what_they_are_of(imperfections: tuple[Imperfection, ...]) -> None:
    rng = np.random.default_rng(0)
    signs = StrokeSampler(synthetic_library(SIGN_LABELS, samples=12, rng=rng))
    movements = StrokeSampler(synthetic_library(PAPER_LANGUAGE.movements, samples=24, rng=rng))
    shown, truth = compose_demonstrations(PAPER_LANGUAGE, signs, movements, rng)
    for imperfection in imperfections:
        shown, truth = imperfection(shown, truth, movements, rng)
    hands = rng.uniform(-0.3, 0.3, (4, 2))
    for movement, loops in enumerate(truth.templates):
        mine = [t for t in range(len(shown)) if truth.movement[t] == movement]
        paths = [shown[t].hand - shown[t].objects[truth.focus[t]] for t in mine]
        path = run_policy(make_policy(paths, [shown[t].times for t in mine]), hands, 8.0)
        assert all(judge_path(path[:, b], loops).draws for b in range(len(hands)))
