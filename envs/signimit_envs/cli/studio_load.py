"""How fast the studio is on this machine, how smooth, and whether it grows."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from signimit.validation import finite_array
from signimit_envs.studio.load import measure_growth, measure_speed, studio_process


def main(sessions: int = 3, answers: int = 40, seconds: float = 10.0, minutes: float = 0.0) -> None:
    """Run a studio in a process of its own, use it over the loopback as pages would, and print what they wait for.

    Args:
        sessions: Sessions taught, twelve demonstrations each.
        answers: Answers asked for, one by one.
        seconds: How long frames are counted, with one page and with two.
        minutes: How long memory is looked at under load; 0 leaves it out.
    """
    with tempfile.TemporaryDirectory() as folder, studio_process(Path(folder)) as (address, process):
        speed = measure_speed(address, sessions, answers, seconds)
        print(f"update after a demonstration: {_summary(speed.update)}")
        print(f"request to first motion seen: {_summary(speed.motion)}")
        for pages, rates in speed.frames.items():
            print(f"frames/s at 640x480, pages {pages}: {', '.join(f'{rate:.1f}' for rate in rates)}")
        print(f"simulated time over time, two pages: {speed.real_time:.3f}")
        if minutes > 0:
            growth = measure_growth(address, process, minutes)
            print(f"{growth.requests} requests in {growth.minutes:g} minutes: {growth.before:.1f} MiB, then", end=" ")
            print(f"{growth.after:.1f} MiB; simulated time over time {growth.real_time:.3f}")


def _summary(seconds: list[float]) -> str:
    times = 1000 * finite_array(seconds, "times", (None,))
    median, most = np.percentile(times, [50, 95])
    return f"median {median:.0f} ms, 95th percentile {most:.0f} ms, longest {times.max():.0f} ms of {len(times)}"
