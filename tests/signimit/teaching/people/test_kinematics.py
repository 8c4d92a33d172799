"""The sigma-lognormal model draws what its closed form promises."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from signimit.teaching.people.kinematics import REACH, MotorPlan, onsets, progress, total_duration, trajectory


def one_stroke(arc: float = 0.0, end: tuple[float, float] = (1.0, 0.0), asymmetry: float = 0.05) -> MotorPlan:
    return MotorPlan(np.array([(0.0, 0.0), end]), np.array([arc]), np.array([0.5]), np.array([0.0]), asymmetry)


def slow_trajectory(plan: MotorPlan, times: np.ndarray, substeps: int = 400) -> np.ndarray:
    """Integrate the velocity: lognormal speed along the tangent of each arc (Plamondon 1995), summed over strokes."""
    sigma = np.sqrt(-np.log(1 - plan.asymmetry))
    points, starts = [], np.r_[0, np.cumsum(plan.durations[:-1] * (1 - plan.overlaps[1:]))]
    fine = np.linspace(-1.0, times[-1], substeps * len(times))
    velocity = np.zeros((len(fine), 2))
    for k, (p, q) in enumerate(zip(plan.targets[:-1], plan.targets[1:], strict=True)):
        mu = np.log(plan.durations[k] / (np.exp(REACH * sigma) - np.exp(-REACH * sigma)))
        since = fine - starts[k] + np.exp(mu - REACH * sigma)
        after = since > 0
        log = np.log(since[after])
        density = np.exp(-((log - mu) ** 2) / (2 * sigma**2)) / (since[after] * sigma * np.sqrt(2 * np.pi))
        share = np.cumsum(density) * (fine[1] - fine[0])
        heading = np.arctan2(*(q - p)[::-1]) + plan.arcs[k] * (share - 0.5)
        half = plan.arcs[k] / 2
        length = np.hypot(*(q - p)) * (half / np.sin(half) if half else 1.0)
        velocity[after] += length * density[:, None] * np.column_stack([np.cos(heading), np.sin(heading)])
    way = plan.targets[0] + np.cumsum(velocity, axis=0) * (fine[1] - fine[0])
    points = [np.interp(times, fine, way[:, axis]) for axis in (0, 1)]
    return np.column_stack(points)


def test_the_closed_form_is_the_integral_of_the_lognormal_velocities() -> None:
    targets = np.array([(0, 0), (1, 0.5), (0.3, 1), (0, -1.0)])
    plan = MotorPlan(
        targets, np.array([0.7, -1.2, 0.0]), np.array([0.4, 0.5, 0.6]), np.array([0, 0.5, 0.3]), asymmetry=0.08
    )
    times = np.linspace(0.02, 1.3, 30)
    assert_allclose(trajectory(plan, times), slow_trajectory(plan, times), atol=5e-3)


@given(
    arc=st.floats(-5.0, 5.0), x=st.floats(-3, 3), y=st.floats(0.1, 3), asymmetry=st.floats(0.01, 0.3)
)  # fmt: skip
@settings(deadline=None, derandomize=True, max_examples=40)
def test_a_stroke_ends_on_its_target(arc: float, x: float, y: float, asymmetry: float) -> None:
    end = trajectory(one_stroke(arc, (x, y), asymmetry), np.array([1e3]))
    assert_allclose(end, [(x, y)], atol=1e-9)


def test_a_half_turn_passes_the_far_point_of_its_half_circle() -> None:
    plan = one_stroke(np.pi, (0.0, 2.0))
    path = trajectory(plan, np.linspace(-0.1, 2.0, 2000))
    assert_allclose(np.linalg.norm(path - (0.0, 1.0), axis=1), 1.0, atol=1e-9)  # circle about the chord's middle
    assert path[:, 0].max() == pytest.approx(1.0, abs=1e-3)  # counter-clockwise: to the right of the way up


def test_a_stroke_goes_988_per_mille_of_its_way_within_its_duration() -> None:
    start, end = progress(one_stroke(), np.array([0.0, 0.5]))[:, 0]
    assert end - start == pytest.approx(0.98758, abs=1e-5)  # 2.5 standard deviations of a normal, both sides


def test_asymmetric_strokes_have_their_peak_earlier() -> None:
    times = np.linspace(0, 0.5, 1001)
    peaks = [np.gradient(progress(one_stroke(asymmetry=a), times)[:, 0]).argmax() for a in (0.01, 0.1, 0.3)]
    assert peaks == sorted(peaks, reverse=True)
    assert len(set(peaks)) == 3


def test_overlap_starts_a_stroke_before_the_last_has_ended() -> None:
    plan = MotorPlan(np.zeros((3, 2)), np.zeros(2), np.array([0.4, 0.6]), np.array([0.0, 0.25]), 0.05)
    assert_allclose(onsets(plan), [0.0, 0.3])
    assert total_duration(plan) == pytest.approx(0.9)


def test_more_overlap_makes_rounder_corners() -> None:
    def gap(overlap: float) -> float:
        targets = np.array([(-1, 0), (0, 1), (1, 0.0)])
        plan = MotorPlan(targets, np.zeros(2), np.full(2, 0.5), np.array([0, overlap]), 0.05)
        return float(np.linalg.norm(trajectory(plan, np.linspace(0, 1, 500)) - (0, 1), axis=1).min())

    assert gap(0.1) < gap(0.3) < gap(0.6)
