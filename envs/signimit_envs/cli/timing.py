"""How long things take on this machine, as ratios within one run wherever there is a plainer way to compare with.

Every subcommand prints a page of tables and writes it beside the same numbers as JSON: how they were measured, on what,
and all rows.
"""

from __future__ import annotations

import json
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import whole_files
from signimit.policies import POLICY_KINDS
from signimit_envs import ENV_IDS
from signimit_envs.cli.command_line import check_output_folder, command_text
from signimit_envs.exceptions import RenderingError
from signimit_envs.studio import load
from signimit_envs.timing import core, environments, throughput
from signimit_envs.timing.measuring import Table, result_facts, result_page

OUT = Path("out/timing")
COMPARED, COMPARED_SECONDS = 18, 10.0  # reproductions that are done in both ways, and how long each takes, s
LONGEST = 100.0  # s of processors; a step that would take longer is not measured at larger sizes
_TIMES = "Seconds are the least of all turns, ratios medians; the limit is for the ratio, or else for the seconds."


def time_core(*, turns: int = 3, seed: int = 0, out: Path = OUT) -> None:
    """Time the core: Δ and time warping beside the loops that their formulas spell out, and learning.

    Args:
        turns: How often everything is timed, in turns.
        seed: Of the synthetic session that is learned from.
        out: Folder for core.json and core.md.
    """
    check_output_folder(out)
    table = Table("core", f"From twelve demonstrations. {_TIMES}", core.time_core(seed, turns))
    _write("core", {"turns": turns, "seed": seed}, [table], out)


def time_environments(*, turns: int = 20, envs: int = 8, out: Path = OUT) -> None:
    """Time control steps beside the bare simulator, ways to step several environments, and rendered frames.

    Args:
        turns: How often everything is timed, in turns.
        envs: How many environments are stepped side by side.
        out: Folder for env.json and env.md.
    """
    check_output_folder(out)
    _check_least("envs", (envs,), 1)
    rows = [environments.time_steps(env_id, turns) for env_id in ENV_IDS]
    rows += environments.time_vector_envs(envs, turns)
    text = f"Beside the bare simulator; several beside a loop over `gym.make`. Resets are not counted. {_TIMES}"
    try:
        rows += environments.time_frames()
    except RenderingError as error:
        text += f" No frames: {error}"
    _write("env", {"turns": turns, "envs": envs}, [Table("environments", text, rows)], out)


def time_throughput(
    *,
    batches: tuple[int, ...] = (9, 36, 256, 1024),
    threads: tuple[int, ...] = (1, 0),
    parts_of: int = 256,
    seconds: float = 4.0,
    turns: int = 5,
    seed: int = 0,
    out: Path = OUT,
) -> None:
    """Time many reproductions at once beside one at a time, and the parts of a control step.

    Args:
        batches: How many reproductions at once.
        threads: Numbers of threads for the physics, 0 for all processors.
        parts_of: How many reproductions at once are taken to parts.
        seconds: How long a hand moves, 1 to 10 s.
        turns: How often everything is timed, in turns.
        seed: Of the session whose commands are reproduced.
        out: Folder for throughput.json and throughput.md.
    """
    check_output_folder(out)
    for name, numbers, least in (
        ("batches", batches, 1), ("threads", threads, 0), ("parts_of", [parts_of], 1), ("turns", [turns], 1)
    ):  # fmt: skip
        _check_least(name, numbers, least)
    if not 1.0 <= seconds <= 10.0:  # a comparison with NaN is false
        raise InvalidInputError("seconds", "1 to 10", f"{seconds}")
    work = throughput.compose_work(max(*batches, parts_of), seed)
    compared = [throughput.compose_work(COMPARED, seed, kind) for kind in POLICY_KINDS]
    tables = [
        Table(
            "batches",
            "Reproductions a second of `signimit_envs.arm.batch.reproduce_many` in units of what "
            "`signimit_envs.reproduce` does with one `TabletopHandEnv`, scenes set up within the time: median over the "
            "turns, the lowest, and the median by computing time, which hardly depends on what else the machine did. "
            "0 threads are all processors.",
            throughput.measure_batches(work, batches, threads, seconds, turns),
        ),
        Table(
            "agreements",
            f"The same reproductions of {COMPARED_SECONDS:g} s done in both ways, gaps in metres. Where a policy sends "
            "neighbouring hands different ways, the last digit decides which, and paths may part.",
            [throughput.compare_paths(some, COMPARED_SECONDS) for some in compared],
        ),
        Table(
            "parts",
            "Computing time in units of a control step of `reproduce`, each part repeated by itself: one hand alone, "
            f"and each of {parts_of} together.",
            throughput.measure_parts(work.first(parts_of), seconds, turns),
        ),
    ]
    _write("throughput", {"seconds": seconds, "turns": turns, "parts_of": parts_of, "seed": seed}, tables, out)


def time_growth(*, counts: tuple[int, ...] = (12, 25, 50, 100, 200, 500, 1000), out: Path = OUT) -> None:
    """Measure how time and memory of learning grow with the number of demonstrations.

    Args:
        counts: Numbers of demonstrations to measure, ascending.
        out: Folder for scaling.json, scaling.md, scaling.csv and scaling.png.
    """
    from signimit.benchmark.studies.scaling import Measurement, measure_growth
    from signimit.benchmark.studies.tables import write_csv
    from signimit.plots.benchmark import draw_growth

    check_output_folder(out)
    rows = list(measure_growth(counts, LONGEST))
    text = "Time on the wall, of all processors, and memory above the start, each in a process of its own."
    _write("scaling", {"counts": counts}, [Table("growth", text, rows)], out)
    with whole_files(out) as folder:
        write_csv(folder / "scaling.csv", Measurement._fields, rows)
        draw_growth(rows).savefig(folder / "scaling.png", dpi=90)


class Quantity(NamedTuple):
    """A number that was measured on the studio."""

    what: str
    value: float
    unit: str


def time_studio(
    *, sessions: int = 3, answers: int = 40, seconds: float = 10.0, minutes: float = 0.0, out: Path = OUT
) -> None:
    """Run a studio in a process of its own, use it over the loopback as pages would, and time what they wait for.

    Args:
        sessions: Sessions taught, twelve demonstrations each.
        answers: Answers asked for, one by one.
        seconds: How long frames are counted, with one page and with two.
        minutes: How long memory is looked at under load; 0 leaves it out.
        out: Folder for studio.json and studio.md.
    """
    check_output_folder(out)
    _check_least("sessions", (sessions,), 1)
    _check_least("answers", (answers,), 1)
    with tempfile.TemporaryDirectory() as folder, load.studio_process(Path(folder)) as (address, process):
        speed = load.measure_speed(address, sessions, answers, seconds)
        growth = load.measure_growth(address, process, minutes) if minutes > 0 else None
    rows = []
    for what, waits in (("update after a demonstration", speed.update), ("request to first motion", speed.motion)):
        for name, percent in (("median", 50), ("95th percentile", 95), ("longest", 100)):
            rows.append(Quantity(f"{what}, {name} of {len(waits)}", float(np.percentile(waits, percent)), "s"))
    for pages, rates in speed.frames.items():
        rows += [Quantity(f"frames of a page of 640x480, {pages} watching", rate, "1/s") for rate in rates]
    rows.append(Quantity("simulated time over time, 2 watching", speed.real_time, ""))
    if growth is not None:
        for after, memory in ((minutes / 10, growth.before), (minutes, growth.after)):
            rows.append(Quantity(f"memory after {after:g} min under load", memory, "MiB"))
        rows.append(Quantity(f"simulated time over time, {growth.requests} requests", growth.real_time, ""))
    plan = {"sessions": sessions, "answers": answers, "seconds": seconds, "minutes": minutes}
    _write("studio", plan, [Table("studio", "As pages see it, over the loopback.", rows)], out)


def _check_least(name: str, numbers: Sequence[int], least: int) -> None:
    if not numbers or min(numbers) < least:
        raise InvalidInputError(name, f"at least {least}", f"{' '.join(map(str, numbers)) or 'none'}")


def _write(name: str, plan: Mapping[str, Any], tables: Sequence[Table], out: Path) -> None:
    facts = result_facts(command_text(), plan, tables)
    page = result_page(name.capitalize(), facts, tables)
    with whole_files(out) as folder:
        (folder / f"{name}.json").write_text(json.dumps(facts, indent=1, allow_nan=False) + "\n", encoding="utf-8")
        (folder / f"{name}.md").write_text(page, encoding="utf-8")
    print(page)
    print(f"Written to {out}.")


SUBCOMMANDS = {
    "core": time_core, "env": time_environments, "throughput": time_throughput, "growth": time_growth,
    "studio": time_studio,
}  # fmt: skip
