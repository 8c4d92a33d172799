"""Besiege the studio: hostile requests and frames over the loopback, and a look at what they did."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from signimit.benchmark.tables import markdown_table
from signimit.exceptions import InvalidInputError
from signimit_envs.studio.siege.siege import besiege

FAULTY = 1


def fuzz_studio(*, requests: int = 2000, visits: int | None = None, seed: int = 0, keep: Path | None = None) -> None:
    """Run a studio in a process of its own, and send it what no page would. Ends with code 1 if there are faults.

    Requests go to all routes that the server describes and to others, with odd headers, tokens, paths, bodies, files,
    chunks and pauses; visits of the socket send messages, frames and floods, and often never read. A fault is an answer
    of 500 or more, none at all, an exception in the log, a file outside the studio's folder that was touched, memory
    that grows, or an honest page that cannot go on. Rates are not limited, or hardly a request would get in.

    Args:
        requests: How many requests.
        visits: How many visits of the socket, of one to some thousand frames; left out, one for twenty requests.
        seed: Decides what is sent.
        keep: Folder to make for the studio's log and sessions.
    """
    visits = requests // 20 if visits is None else visits
    if requests < 1 or visits < 0:
        raise InvalidInputError("requests, visits", "at least 1, and 0 or more", f"{requests}, {visits}")
    if keep is not None and keep.exists():
        raise InvalidInputError("--keep", "a folder that is not there yet", str(keep))
    from tqdm import tqdm

    with tempfile.TemporaryDirectory() as folder, tqdm(total=requests + visits, unit="attack") as bar:
        report = besiege(keep or Path(folder) / "room", requests, visits, seed, bar.update)
    print(markdown_table(("attack", "made"), list(report.kinds.items())))
    print(markdown_table(("answer", "given"), list(report.statuses.items())))
    print(
        f"{report.requests} requests, {report.frames} frames in {report.seconds:.0f} s; memory {report.before:.0f} MiB "
        f"after a tenth, {report.after:.0f} at the end, {report.highest:.0f} at most; {len(report.faults)} faults."
    )
    for fault in report.faults:
        print(fault)
    if report.faults:
        sys.exit(FAULTY)
