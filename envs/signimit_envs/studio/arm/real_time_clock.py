"""Keeping step with the clock: how long to wait between steps that stand for equal times."""

from __future__ import annotations

FASTEST = 2.0  # times real time, while a delay is made up for
LONGEST_DELAY = 5.0  # s; what is later than that was suspended, not held up


class Pace:
    """Says when the next step is due; it reads no clock, it is told the time.

    A step that was held up is followed by the same steps as ever, closer together, until simulated time has
    caught up: no step is left out or made longer, and nothing runs faster than twice real time, so whoever
    watches sees a hand that hurries for as long as it was held up, and never one that jumps. A delay past
    `LONGEST_DELAY` (a machine that slept) is not made up for but counted, as nobody wants to see seconds of it.

    Attributes:
        lost: Time that is not made up for, s.
    """

    def __init__(self, period: float, now: float) -> None:
        """Begin.

        Args:
            period: Time from one step to the next, s.
            now: The time on a clock that never goes back, s.
        """
        self._period = period
        self._due = self._start = now
        self.lost = 0.0

    def wait(self, now: float) -> float:
        """Return how long to wait before the next step begins, s, when one has just ended."""
        self._due += self._period
        delay = now - self._due
        if delay > LONGEST_DELAY:
            self.lost += delay
            self._due = now
        self._start = max(self._due, self._start + self._period / FASTEST, now)
        return self._start - now
