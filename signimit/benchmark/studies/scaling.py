"""How time and memory of learning grow with the number of demonstrations."""

from __future__ import annotations

import itertools
import multiprocessing
import resource
import sys
import time
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from signimit.demonstrations import DemonstrationSet
from signimit.learners.joint.drawing_dissimilarity import compare_drawings, describe_drawing
from signimit.learning import learn
from signimit.paths import resample_path
from signimit.similarity import policy_distances
from signimit.teaching.composition import compose_demonstrations
from signimit.teaching.languages import PAPER_LANGUAGE, Language
from signimit.teaching.people import synthetic_library

SAMPLES = 40
POINTS = 100  # of a path whose policy is compared
STEPS = ("distances of drawings", "distances of policies", "learning")
CODES = ("numba", "numpy")  # with the extra ``fast``, and without


class Measurement(NamedTuple):
    """One step at one size.

    Attributes:
        demonstrations: N.
        step: One of `STEPS`.
        code: One of `CODES`; small steps are done by numpy anyway.
        seconds: Wall-clock time, which what else the machine does makes longer.
        processor_seconds: Time of all processors together.
        megabytes: How much the peak of resident memory grew above what the process had before.
    """

    demonstrations: int
    step: str
    code: str
    seconds: float
    processor_seconds: float
    megabytes: float


def measure_growth(counts: Sequence[int], seconds: float, seed: int = 0) -> Iterator[Measurement]:
    """Measure every step at every size with each code, each in a process of its own; yields as they end.

    Args:
        counts: Numbers of demonstrations, ascending.
        seconds: A step is not tried at larger sizes once its next, if time grows with the square of the size, would
            take longer than this (of all processors together).
        seed: Of the session.
    """
    context = multiprocessing.get_context("spawn")
    for step, code in itertools.product(STEPS, CODES):
        expected = 0.0
        for count, larger in itertools.pairwise((*counts, counts[-1])):
            if expected > seconds:
                break
            with context.Pool(1) as pool:
                measured = pool.apply(_measure, (count, step, code, seed))
            yield measured
            expected = measured.processor_seconds * (larger / count) ** 2


def compose_many(count: int, seed: int) -> DemonstrationSet:
    """Compose that many demonstrations of the paper's language."""
    rng, paper = np.random.default_rng(seed), PAPER_LANGUAGE
    language = Language(repetitions=-(-count // len(paper.seen)))
    signs = synthetic_library((*paper.focus_signs, *paper.movement_signs), samples=SAMPLES, rng=rng)
    movements = synthetic_library(paper.movements, samples=SAMPLES, rng=rng)
    demonstrations, _ = compose_demonstrations(language, signs, movements, rng)
    return DemonstrationSet(demonstrations[:count])


def _measure(count: int, step: str, code: str, seed: int) -> Measurement:
    if code == "numpy":
        sys.modules["numba"] = None  # type: ignore[assignment]  # as if the extra were not installed
    demonstrations = compose_many(count, seed)
    before, start, busy = _peak(), time.perf_counter(), time.process_time()
    if step == "learning":
        learn(demonstrations, policy="knn")
    elif step == "distances of policies":
        policy_distances([resample_path(path, POINTS) for path in demonstrations.paths], demonstrations.objects)
    else:
        compare_drawings([describe_drawing(d.hand, d.times) for d in demonstrations])
    seconds, worked = time.perf_counter() - start, time.process_time() - busy
    return Measurement(count, step, code, round(seconds, 4), round(worked, 4), round(_peak() - before, 1))


def _peak() -> float:
    """Peak of resident memory so far, megabytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
