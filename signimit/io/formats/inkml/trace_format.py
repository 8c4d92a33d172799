"""Trace formats: the channels of a point, their units, resolution and orientation (InkML 1.1, sections 3.1 and 4.1)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import NamedTuple
from xml.etree.ElementTree import Element

from signimit.exceptions import FileFormatError
from signimit.io.formats.xmlfile import local_name
from signimit.validation import LARGEST

TIME_UNITS: Mapping[str, float] = MappingProxyType(
    {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "ns": 1e-9, "sec": 1.0, "msec": 1e-3}
)  # seconds
LENGTH_UNITS: Mapping[str, float] = MappingProxyType(
    {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "himetric": 1e-5, "in": 0.0254, "pt": 0.0254 / 72, "pc": 0.0254 / 6}
)  # metres; 1 himetric of Microsoft's ink is 0.01 mm
_LEAST_RESOLUTION = 1e-30  # smaller ones, and none at all, declare nothing
MOST_CHANNELS = 100  # of a trace format; the standard has names for 26


class Scale(NamedTuple):
    """How large one step of a channel's numbers is.

    Attributes:
        size: Size of a step in the unit.
        unit: ``"m"`` for whatever can be measured, else the name that the file has for it, e.g. ``"dev"``.
    """

    size: float
    unit: str


class Channel(NamedTuple):
    """One number of a point.

    Attributes:
        name: Its name, e.g. ``"X"``.
        kind: ``"integer"``, ``"decimal"``, ``"double"`` or ``"boolean"``.
        default: What it is before it is first reported.
        sign: -1 if it is recorded against the standard's direction, else 1.
        units: Unit of its numbers, if the file says so.
        resolution: Numbers in a unit, or units in a number, with its unit as written; none if not declared.
        intermittent: Whether a point may leave it out.
        respect_to: Reference to the time stamp that a clock counts from.
    """

    name: str
    kind: str = "decimal"
    default: float = 0.0
    sign: float = 1.0
    units: str | None = None
    resolution: tuple[float, str] | None = None
    intermittent: bool = False
    respect_to: str | None = None

    @property
    def numeric(self) -> bool:
        """Whether T and F mean nothing here."""
        return self.name in ("X", "Y", "T")

    def scale(self, units: Mapping[str, float], base: str) -> Scale | None:
        """Return the size of a step; none if the file does not declare any."""
        if self.resolution is not None:
            value, unit = self.resolution
            unit = unit or f"1/{self.units or 'dev'}"
            inverse = unit.startswith("1/")
            size, unit = (1 / value if inverse else value), unit.removeprefix("1/")
        elif self.units is not None:
            size, unit = 1.0, self.units
        else:
            return None
        return Scale(size * units[unit], base) if unit in units else Scale(size, unit)


@dataclass(frozen=True)
class TraceFormat:
    """Which number of a point is what. Without a declaration, X and Y.

    Attributes:
        channels: The channels, in the order of a point's numbers.
    """

    channels: tuple[Channel, ...] = (Channel("X"), Channel("Y"))

    def index(self, name: str) -> int | None:
        """Return the column of a channel; none if there is no such channel."""
        return next((i for i, channel in enumerate(self.channels) if channel.name == name), None)

    def channel(self, name: str) -> Channel | None:
        """Return a channel by its name; none if there is no such channel."""
        return next((channel for channel in self.channels if channel.name == name), None)

    @cached_property
    def required(self) -> int:
        """How many numbers a point has at least: all up to the last of X, Y and T that may not be left out."""
        wanted = [i for i, c in enumerate(self.channels) if c.numeric and not c.intermittent]
        return max(wanted) + 1 if wanted else 1

    @cached_property
    def point_description(self) -> str:
        """What a point consists of, in words."""
        names = ", ".join(channel.name[:20] for channel in self.channels[:20])
        return f"a value for each of {names}" + (" (the last may be left out)" * (self.required < len(self.channels)))

    @cached_property
    def aspect(self) -> float:
        """Size of a step of Y in steps of X.

        Raises:
            FileFormatError: If the two cannot be compared.
        """
        x, y = self.length("X"), self.length("Y")
        if x is None or y is None:
            return 1.0
        if x.unit != y.unit:
            raise FileFormatError("channels X and Y", "units that can be compared", f"{x.unit} and {y.unit}")
        return y.size / x.size

    def length(self, name: str) -> Scale | None:
        """Return the size of a step of X or Y."""
        channel = self.channel(name)
        return None if channel is None else channel.scale(LENGTH_UNITS, "m")

    @cached_property
    def seconds(self) -> float | None:
        """Seconds in a step of T, milliseconds where the file does not say; none if it counts ticks of unknown length.

        Raises:
            FileFormatError: If its unit is not one of time.
        """
        clock = self.channel("T")
        scale = None if clock is None else clock.scale(TIME_UNITS, "s")
        if scale is None:
            return TIME_UNITS["ms"]
        if scale.unit == "dev":
            return None
        if scale.unit != "s":
            raise FileFormatError("channel T", f"a unit of {', '.join(TIME_UNITS)}", repr(scale.unit))
        return scale.size


def read_trace_format(element: Element, source: Element | None) -> TraceFormat:
    """Read a ``<traceFormat>``, with the resolutions that its ``<inkSource>`` declares.

    Raises:
        FileFormatError: If it has more than 100 channels.
    """
    resolutions = {} if source is None else _resolutions(source)
    channels = []
    for child in element:
        intermittent = local_name(child) == "intermittentChannels"
        for channel in child if intermittent else (child,):
            if local_name(channel) == "channel":
                channels.append(_read_channel(channel, resolutions, intermittent))
    if len(channels) > MOST_CHANNELS:  # points that leave them all out would be short to write and long to keep
        raise FileFormatError("traceFormat", f"at most {MOST_CHANNELS} channels", f"{len(channels)}")
    return TraceFormat(tuple(channels)) if channels else TraceFormat()


def _read_channel(element: Element, resolutions: Mapping[str, tuple[float, str]], intermittent: bool) -> Channel:
    name, default = element.get("name", "").strip(), element.get("default", "0").strip()
    return Channel(
        name=name,
        kind=element.get("type", "decimal"),
        default=1.0 if default == "T" else read_number(default) or 0.0,
        sign=-1.0 if element.get("orientation", "+ve").strip() == "-ve" else 1.0,
        units=(element.get("units") or "").strip() or None,
        resolution=resolutions.get(name),
        intermittent=intermittent,
        respect_to=element.get("respectTo"),
    )


def _resolutions(source: Element) -> dict[str, tuple[float, str]]:
    """Return the resolutions of a device's channels; one of 0, as Microsoft writes for force, declares nothing."""
    found = {}
    for element in source.iter():
        if local_name(element) == "channelProperty" and element.get("name") == "resolution":
            value = read_number(element.get("value"))
            if value is not None and value > _LEAST_RESOLUTION:
                found[element.get("channel", "").strip()] = (value, (element.get("units") or "").replace(" ", ""))
    return found


def read_number(text: str | None) -> float | None:
    """Return a number of sane size, or none if the text is not one."""
    try:
        value = float(text or "")
    except ValueError:
        return None
    return value if abs(value) <= LARGEST else None
