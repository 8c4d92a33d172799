"""A course laid out in time, at the speeds the demonstrators showed."""

from __future__ import annotations

import numpy as np

from signimit.paths import box_centre, interpolate, step_lengths
from signimit.policies.base import CONTROL_PERIOD, Array
from signimit.policies.reference_path.reference_path import ReferencePath

SLOWEST = 0.1  # of the mean speed: a longer pause is shortened
FASTEST = 3.0  # of the mean speed: a glitch is slowed down
MOST_NODES = 10_000  # control periods; what would take longer is done faster
CORNER_ALLOWANCE = 1.03  # times the size: a mean of corners that do not quite meet lies inside them


def time_course(course: ReferencePath) -> Array:
    """Lay a course out in time: positions one control period apart, at the mean speed shown at each place."""
    line = np.concatenate([course.points, course.points[:1]]) if course.closed else course.points
    steps = step_lengths(line)
    shown = course.speeds[: len(steps)]
    mean = shown[shown > 0].mean() if (shown > 0).any() else course.reach_speed
    speeds = np.clip(np.where(shown > 0, shown, mean), SLOWEST * mean, FASTEST * mean)
    clock = np.concatenate([[0.0], np.cumsum(steps / speeds)])
    count = int(np.clip(np.rint(clock[-1] / CONTROL_PERIOD), 2, MOST_NODES))
    even = np.linspace(0.0, clock[-1], count + 1)
    if not course.closed:
        return interpolate(even, clock, line)
    centre = box_centre(line)
    nodes: Array = centre + CORNER_ALLOWANCE * (interpolate(even[:-1], clock, line) - centre)
    return nodes
