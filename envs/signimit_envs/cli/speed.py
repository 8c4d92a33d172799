"""How fast signimit is here, as ratios to the plainest way of doing the same, within one run."""

from __future__ import annotations

from typing import Literal

import numpy as np

from signimit.teaching.composition import compose_demonstrations, compose_prototypes
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit.teaching.people import synthetic_library
from signimit_envs import ENV_IDS
from signimit_envs.timing.measurements import (
    compare_distances,
    compare_environment,
    installed_versions,
    time_frames,
    time_learning,
)

TARGETS = {"signimit/Tabletop-v0": 1.5, "signimit/TabletopHand-v0": 1.3}  # times the bare simulator


def main(what: Literal["all", "env", "core", "render"] = "all", /, *, repetitions: int = 20, seed: int = 0) -> None:
    """Measure how fast signimit is on this machine.

    Args:
        what: The environments' steps, the learning core, frames, or all of them.
        repetitions: How often each pair of ways is timed, in turns.
        seed: Of the synthetic session that is learned from.
    """
    print("  ".join(f"{name} {version}" for name, version in installed_versions().items()))
    if what in ("all", "env"):
        print_environments(repetitions)
    if what in ("all", "core"):
        print_core(seed, max(2, repetitions // 7))
    if what in ("all", "render"):
        for camera, seconds in time_frames().items():
            print(f"frame 480x480, {camera:12s}{seconds * 1e3:25.1f} ms           at most 12")


def print_environments(repetitions: int) -> None:
    """Print what a control step costs beside the bare simulator."""
    for env_id in ENV_IDS:
        ours, plain, ratio = compare_environment(env_id, repetitions)
        times = f"{ours * 1e6:7.0f} us, bare {plain * 1e6:5.0f} us"
        print(f"{env_id:27s}{times}, ratio {ratio:5.2f}     at most {TARGETS[env_id]}")


def print_core(seed: int, repetitions: int) -> None:
    """Print what learning from twelve demonstrations costs, and its costliest step beside plain loops."""
    language, rng = PAPER_LANGUAGE, np.random.default_rng(seed)
    labels = (*language.focus_signs, *language.movement_signs, *language.prototypes)
    signs = synthetic_library(labels, rng=rng)
    demonstrations, _ = compose_demonstrations(language, signs, synthetic_library(language.movements, rng=rng), rng)
    prototypes = compose_prototypes(language, signs, rng)
    (ours, plain, ratio), difference = compare_distances(demonstrations, repetitions)
    times = f"{ours * 1e3:7.1f} ms, loops {plain * 1e3:5.0f} ms"
    print(f"distances of {len(demonstrations)} paths      {times}, {1 / ratio:5.0f} x faster  at least 20")
    print(f"largest relative difference  {difference:.1e}                               at most 1e-12")
    seconds = time_learning(demonstrations, prototypes, "paper")
    print(f"learning, method paper     {seconds * 1e3:7.0f} ms                               at most 150")
