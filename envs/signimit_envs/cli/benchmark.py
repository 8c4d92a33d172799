"""The benchmark: run entries on its sessions, and make the leaderboard."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Literal

from tqdm import tqdm

from signimit.benchmark.entries import ENTRANTS, refer_to
from signimit.benchmark.results import ResultFile, read_comparable_summaries, run_missing, write_summary
from signimit.benchmark.running import Engine, local_engine
from signimit.benchmark.shipped_sessions import SESSIONS
from signimit.benchmark.splits import choose_splits
from signimit.benchmark.tables import MANY, hours_for, leaderboard, overview
from signimit.exceptions import InvalidInputError
from signimit.io.safe_files import whole_files

OUT = Path("out/benchmark")


def run_entries(
    *,
    entry: tuple[str, ...] = ("joint",),
    splits: tuple[str, ...] = (),
    sessions: int = SESSIONS,
    first_seed: int = 0,
    engine: Literal["local", "dask"] = "local",
    scheduler: str = "",
    workers: int = 0,
    batch: int = 1,
    out: Path = OUT,
) -> None:
    """Run entries on sessions, and summarise how many commands each obeyed. Goes on where a killed run stopped.

    Args:
        entry: Names of entries, or your own as module:Class or file.py:Class; "all" are all registered ones: joint,
            paper, paper-path, paper-literal, deep-12, deep-1200, deep-plain-12, deep-plain-1200, clone-knn, clone-mlp,
            replay-nearby, replay, oracle-grouping, oracle-focus, oracle, chance.
        splits: Names of splits, of paper, unseen-pair, unseen-scene, unseen-style, unseen-person, word-order,
            filler-word, many, few, noisy, ambiguous, counterfactual, once, open-once, retreat, wrong-2, irrelevant-2,
            idle-4, synonyms, strangers, strangers-many, mouse, strangers-mouse; left out, all of them.
        sessions: How many of each split; the first 20 are shipped, more are composed.
        first_seed: Number of the first session.
        engine: Where sessions run: on the processors of this machine, or on a dask.distributed cluster.
        scheduler: Address of the cluster's scheduler, e.g. tcp://10.0.0.1:8786.
        workers: Processes of the local engine; left out, one for each processor.
        batch: Sessions that are sent together.
        out: Folder of the results.
    """
    if first_seed < 0 or sessions < 1:
        raise InvalidInputError("sessions", "at least 1, from seed 0 on", f"{sessions} from seed {first_seed}")
    seeds = range(first_seed, first_seed + sessions)
    names = [split.name for split in choose_splits(splits)]
    chosen = [refer_to(name) for given in entry for name in (ENTRANTS if given == "all" else (given,))]
    runner = _engine(engine, scheduler, workers or os.cpu_count() or 1, batch)
    for reference in dict.fromkeys(chosen):
        file = ResultFile(out, reference)
        total = len(names) * len(seeds)
        for _ in tqdm(run_missing(file, names, seeds, runner), total=total, unit="session", desc=file.entrant.name):
            pass
        summary = write_summary(file)
        print(overview([summary]))
        found = summary["splits"].values()
        cost = sum(s["seconds"] for s in found) / sum(s["sessions"] for s in found)
        hours = hours_for(MANY, cost)
        print(f"A session takes {cost:.2f} s of a processor; {MANY} take {hours:.1f} h of two processors.")
        print(f"Written to {file.summary}.")


def write_table(*, out: Path = OUT) -> None:
    """Write the leaderboard of all results, README.md, beside them.

    Args:
        out: Folder of the results.
    """
    summaries = read_comparable_summaries(out)
    with whole_files(out) as folder:
        (folder / "README.md").write_text(leaderboard(summaries), encoding="utf-8")
    print(overview(summaries))
    print(f"Written to {out / 'README.md'}.")


def plot(*, out: Path = OUT) -> None:
    """Draw the leaderboard of all results, obeyed.png, beside them.

    Args:
        out: Folder of the results.
    """
    from signimit.plots.benchmark import draw_results

    figure = draw_results(read_comparable_summaries(out))
    with whole_files(out) as folder:
        figure.savefig(folder / "obeyed.png", dpi=90)
    print(f"Written to {out / 'obeyed.png'}.")


def _engine(name: str, scheduler: str, workers: int, batch: int) -> Engine:
    if name == "local":
        return local_engine(workers, batch)
    if not scheduler:
        raise InvalidInputError("--scheduler", "the address of a dask scheduler, e.g. tcp://10.0.0.1:8786", "none")
    from signimit.benchmark.cluster import dask_engine

    return dask_engine(scheduler, batch)


SUBCOMMANDS = {"run": run_entries, "table": write_table, "plot": plot}
