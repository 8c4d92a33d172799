"""Pen data of UNIPEN text: components, movements with the pen down or up, and the tablet that recorded them."""

from __future__ import annotations

import math
import re
from array import array
from collections.abc import Sequence
from dataclasses import dataclass, field
from io import StringIO
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError
from signimit.io.formats.import_report import Finding
from signimit.io.formats.unipen.statements import Statement

MOST_COMPONENTS = 100_000
LONGEST_LINE, LONGEST_WRITER = 1_000_000, 200  # characters
RATES = (10.0, 1000.0)  # points a second that a tablet can mean; files also state rates of a serial line, such as 9600
PER_MM = {"INCH": 1 / 25.4, "MM": 1.0}
_RESOLUTION = re.compile(r"(?:([XY])_)?POINTS_PER_(INCH|MM)")
_NOTHING = np.empty((0, 2))


class Component(NamedTuple):
    """A movement of the pen while it was down, or up.

    Attributes:
        down: Whether the pen was down.
        points: Shape (T, 2), in units of X, y up.
        switch: Its number among all times that the pen was put down or taken up, also those without points.
        stamps: Channel T as written, shape (T,); none without one.
        run: Number of the stretch of components between which the time is known, from pen-up points or ``.DT``.
        start: Time of the first point since its stretch began, s.
        interval: Time between points, s; none without a declared rate.
        writer: Who wrote it.
        error: What is wrong with it, so that no drawing can have it.
    """

    down: bool
    points: NDArray[np.float64] = _NOTHING
    switch: int = 0
    stamps: NDArray[np.float64] | None = None
    run: int = 0
    start: float = 0.0
    interval: float | None = None
    writer: str = "unknown"
    error: FileFormatError | None = None


@dataclass
class PenReader:
    """Reader of the components of a file, and of what is declared about the tablet.

    Attributes:
        components: Those with points, as segments count them: a ``.PEN_UP`` without points is none.
        findings: What was assumed.
        writer: Who writes from here on.
    """

    components: list[Component] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    writer: str = "unknown"
    _channels: Sequence[str] = ("X", "Y")
    _per_mm: dict[str, float] = field(default_factory=dict)
    _interval: float | None = None
    _gap: float = 0.0  # s, told by .DT since the last component
    _end: float = 0.0  # s, of the last point in its stretch
    _switches: int = 0
    _lifts: set[str] = field(default_factory=set)  # ways in which the pen was taken up: bare, recorded, unsaid
    _down: tuple[str, int] | None = None  # place and number of the component that is not ended

    def read(self, statement: Statement) -> None:
        """Take in a statement, if it is about the pen.

        Raises:
            FileFormatError: If X and Y are not among the channels, or there are more components than a file can mean.
        """
        keyword, body = statement.keyword, statement.body
        if keyword in ("PEN_DOWN", "PEN_UP"):
            drawn = bool(body) and not body.isspace()
            if self._down or keyword == "PEN_UP":
                self._lifts.add("unsaid" if keyword == "PEN_DOWN" else "recorded" if drawn else "bare")
            self._switches += 1
            self._down = (statement.where, len(self.components)) if keyword == "PEN_DOWN" else None
            if drawn:
                self._add_component(statement)
        elif keyword == "DT":
            self._gap += (_positive_number(body) or 0.0) / 1000
        elif keyword == "WRITER_ID":
            self.writer = " ".join(body.partition("\n")[0].split())[:LONGEST_WRITER] or self.writer
        elif keyword == "COORD":
            self._channels = tuple(body.upper().split())
            if [self._channels.count(axis) for axis in "XY"] != [1, 1] or self._channels.count("T") > 1:
                raise FileFormatError(statement.where, ".COORD with X and Y, once each", repr(body.strip()[:60]))
        elif keyword == "POINTS_PER_SECOND":
            rate = _positive_number(body) or 0.0
            self._interval = 1 / rate if RATES[0] <= rate <= RATES[1] else None
            if self._interval is None:
                self._assume(statement, ".POINTS_PER_SECOND that no tablet has, which is passed over")
        elif (found := _RESOLUTION.fullmatch(keyword)) and (number := _positive_number(body)):
            self._per_mm |= dict.fromkeys(found[1] or "XY", number * PER_MM[found[2]])

    def finish(self) -> None:
        """Note that a text ends with the pen down although it else takes it up: the last component may be cut off."""
        if self._down and self._lifts == {"bare"} and self._down[1] < len(self.components):
            error = FileFormatError(self._down[0], ".PEN_UP after the last .PEN_DOWN", "the end of the file")
            self.components[-1] = self.components[-1]._replace(error=error)

    def _add_component(self, statement: Statement) -> None:
        down = statement.keyword == "PEN_DOWN"
        if len(self.components) == MOST_COMPONENTS:
            raise FileFormatError(statement.where, f"at most {MOST_COMPONENTS} components", "more")
        try:
            rows = _read_numbers(statement, self._channels)
        except FileFormatError as error:
            self.components.append(Component(down, switch=self._switches - 1, run=len(self.components), error=error))
            return
        points = rows[:, [self._channels.index("X"), self._channels.index("Y")]]
        if len(self._per_mm) == 2 and not math.isclose(self._per_mm["X"], self._per_mm["Y"], rel_tol=1e-6):
            points[:, 1] *= self._per_mm["X"] / self._per_mm["Y"]
        stamps = self._known_stamps(rows[:, self._channels.index("T")], statement) if "T" in self._channels else None
        run, start = self._clock(down)
        self._end, self._gap = start + (len(points) - 1) * (self._interval or 0.0), 0.0
        self.components.append(
            Component(down, points, self._switches - 1, stamps, run, start, self._interval, self.writer)
        )

    def _clock(self, down: bool) -> tuple[int, float]:
        """Return in which stretch the next component begins, and when: one step after a recorded change of the pen."""
        if not self.components:
            return 0, 0.0
        last, gap = self.components[-1], self._gap
        if self._interval and last.interval and last.down != down:
            gap = gap or self._interval
        return (last.run, self._end + gap) if self._interval and gap else (last.run + 1, 0.0)

    def _known_stamps(self, stamps: NDArray[np.float64], statement: Statement) -> NDArray[np.float64] | None:
        """Fill in stamps of 0 after others: lipitk tells the first and last only. None if the last is not told."""
        unknown = (stamps == 0) & np.logical_or.accumulate(stamps != 0)
        if not unknown.any():
            return stamps
        self._assume(statement, "stamps of 0 between others, which are spread evenly", int(unknown.sum()))
        known = np.flatnonzero(~unknown)
        return None if unknown[-1] else np.interp(np.arange(len(stamps)), known, stamps[known])

    def _assume(self, statement: Statement, what: str, count: int = 1) -> None:
        self.findings.append(Finding(statement.where, what, count, "assumed"))


def _positive_number(body: str) -> float | None:
    """Return the number that a declaration begins with; none if it has none that means anything, such as ``?``."""
    try:
        number = float(body.split(maxsplit=1)[0])
    except (ValueError, IndexError):
        return None
    return number if 0 < number < math.inf else None


def _read_numbers(statement: Statement, channels: Sequence[str]) -> NDArray[np.float64]:
    """Return the points of a component, shape (T, channels), also where each number has a line of its own.

    Raises:
        FileFormatError: Names the line that has no whole number of points.
    """
    numbers, odd, longest = array("d"), "", 0
    two = tuple(channels) == ("X", "Y")
    expected = "two numbers" if two else f"{len(channels)} numbers, {' '.join(channels)[:60]}"
    for number, line in enumerate(StringIO(statement.body), statement.line):
        words = line.split() if len(line) < LONGEST_LINE else ["a line of", f"{len(line)} characters"]
        where = f"{statement.path}: line {number}"
        try:
            numbers.extend(map(float, words))
        except ValueError:
            raise FileFormatError(where, expected, repr(line.strip()[:60])) from None
        longest = max(longest, len(words))
        if len(words) % len(channels) and not odd:
            odd = f"{number}"
            error = FileFormatError(where, expected, repr(line.strip()[:60]))
    if odd and (longest > 1 or len(numbers) % len(channels)):
        raise error
    return np.frombuffer(numbers, dtype=np.float64).reshape(-1, len(channels))
