"""How many reproductions a second, many at once against one at a time, and what a control step is made of."""

from __future__ import annotations

import json
from pathlib import Path

from signimit.io.safe_files import whole_files
from signimit_envs.cli.command_line import command_text
from signimit_envs.timing.throughput.report import markdown, measure_throughput, report
from signimit_envs.timing.throughput.work import ThroughputPlan


def main(
    batches: tuple[int, ...] = (9, 36, 256, 1024),
    threads: tuple[int, ...] = (1, 0),
    parts_of: int = 256,
    envs: int = 8,
    seconds: float = 4.0,
    turns: int = 5,
    seed: int = 0,
    out: Path = Path("results/throughput"),
) -> None:
    """Measure throughput on this machine, as ratios within one run, and write throughput.json and throughput.md.

    Args:
        batches: How many reproductions at once.
        threads: Numbers of threads for the physics, 0 for all processors.
        parts_of: How many reproductions at once are taken to parts.
        envs: How many environments are stepped side by side.
        seconds: How long a hand moves, 1 to 10 s.
        turns: How often everything is timed.
        seed: Of the session whose commands are reproduced.
        out: Folder for what is written.
    """
    plan = ThroughputPlan(
        batches=batches, threads=threads, parts_of=parts_of, envs=envs, seconds=seconds, turns=turns, seed=seed
    )
    command = command_text()
    with whole_files(out) as folder:
        measured = measure_throughput(plan)
        page = markdown(measured, plan, command)
        (folder / "throughput.md").write_text(page, encoding="utf-8")
        (folder / "throughput.json").write_text(json.dumps(report(measured, plan, command), indent=1) + "\n")
    print(page)
