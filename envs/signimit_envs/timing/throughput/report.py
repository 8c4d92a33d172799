"""Everything that was measured, for people and for programs."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, NamedTuple

from signimit.policies import POLICY_KINDS
from signimit_envs.arm.scene import SUBSTEPS
from signimit_envs.timing.measurements import installed_versions
from signimit_envs.timing.throughput.batches import Agreement, BatchSpeed, compare_paths, measure_batches
from signimit_envs.timing.throughput.parts import Part, measure_parts
from signimit_envs.timing.throughput.vector_envs import WayToStep, measure_vector_envs
from signimit_envs.timing.throughput.work import ThroughputPlan, compose_work

_COMPARED, _COMPARED_SECONDS = 18, 10.0  # reproductions that are done in both ways


class Throughput(NamedTuple):
    """What was measured: one row each for a batch, a kind of policy, a part of a step, a way to step environments."""

    batches: list[BatchSpeed]
    agreements: list[Agreement]
    parts: list[Part]
    vector_envs: list[WayToStep]


def measure_throughput(plan: ThroughputPlan) -> Throughput:
    """Measure all of a plan."""
    work = compose_work(max(*plan.batches, plan.parts_of), plan.seed)
    return Throughput(
        measure_batches(work, plan),
        [compare_paths(compose_work(_COMPARED, plan.seed, kind), _COMPARED_SECONDS) for kind in POLICY_KINDS],
        measure_parts(work.first(plan.parts_of), plan.seconds, plan.turns),
        measure_vector_envs(plan.envs, plan.seconds, plan.turns),
    )


def report(measured: Throughput, plan: ThroughputPlan, command: str) -> dict[str, Any]:
    """Say in what JSON can say what was measured, how and with what."""
    return {
        "command": command,
        "processors": os.cpu_count(),
        "versions": dict(installed_versions()),
        "plan": {name: getattr(plan, name) for name in ("seconds", "turns", "parts_of", "envs", "seed")},
        "batches": [row._asdict() for row in measured.batches],
        "agreements": [row._asdict() for row in measured.agreements],
        "parts": [row._asdict() for row in measured.parts],
        "vector environments": [row._asdict() for row in measured.vector_envs],
    }


def markdown(measured: Throughput, plan: ThroughputPlan, command: str) -> str:
    """Return a page with a table of each kind."""
    versions = ", ".join(f"{name} {version}" for name, version in installed_versions().items())
    return f"""# Throughput

Made by `{command}` on {os.cpu_count()} processors.
Versions: {versions}.

All numbers are ratios of times taken in turns within one run, medians over {plan.turns} turns of {plan.seconds:g} s of
simulated time. What else the machine did is in those by the clock; those by computing time, of all threads together,
hardly depend on it.

## Many reproductions at once

`signimit_envs.arm.batch.reproduce_many` beside `signimit_envs.reproduce` with one `TabletopHandEnv`: learned policies,
inverse kinematics and {SUBSTEPS} physics steps a control step in both, scenes set up within the time.

{_batch_table(measured.batches)}

The same reproductions of {_COMPARED_SECONDS:g} s done in both ways. Where a policy sends neighbouring hands different
ways, the last digit decides which, and paths may part.

{_agreement_table(measured.agreements)}

## The parts of a control step

Computing time in per cent of a control step of `reproduce`, each part repeated by itself.

{_part_table(measured.parts, plan.parts_of)}

## {plan.envs} environments side by side

Time by the clock for the same steps of `signimit/TabletopHand-v0`, resets not counted.

{_way_table(measured.vector_envs)}
"""


def _batch_table(rows: Sequence[BatchSpeed]) -> str:
    head = "| at once | threads | reproductions a second | least of all turns | the same by computing time |\n"
    lines = [
        f"| {r.batch} | {r.threads or 'all'} | {r.faster:.1f} x | {r.lowest:.1f} x | {r.computing:.1f} x |"
        for r in rows
    ]
    return "\n".join([head + "|---|---|---|---|---|", *lines])


def _agreement_table(rows: Sequence[Agreement]) -> str:
    head = (
        "| policy | the same verdict (movement and object) | largest distance of two hands at one time |\n|---|---|---|"
    )
    lines = [f"| {r.kind} | {r.same_verdicts} of {r.reproductions} | {r.largest_gap * 1e3:.4f} mm |" for r in rows]
    return "\n".join([head, *lines])


def _part_table(rows: Sequence[Part], count: int) -> str:
    head = f"| | one hand | each of {count} hands |\n|---|---|---|"
    lines = [
        f"| {r.name} | {100 * r.alone:.1f} | {'' if r.together is None else f'{100 * r.together:.1f}'} |" for r in rows
    ]
    return "\n".join([head, *lines])


def _way_table(rows: Sequence[WayToStep]) -> str:
    return "\n".join(["| | time |\n|---|---|", *(f"| {r.name} | {r.time:.2f} |" for r in rows)])
