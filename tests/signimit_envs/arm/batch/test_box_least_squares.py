"""Least squares between bounds: scipy finds the same, slowly."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

from signimit_envs.arm.batch.box_least_squares import LeastSquares, solve_box


def problems(count: int, damping: float, room: float, unknowns: int = 3, seed: int = 0) -> LeastSquares:
    rng = np.random.default_rng(seed)
    lower = -room * rng.random((unknowns, count))
    upper = room * rng.random((unknowns, count))
    jacobian, wanted = rng.normal(size=(2, unknowns, count)), rng.normal(size=(2, count))
    return LeastSquares(jacobian, wanted, rng.normal(size=(unknowns, count)), damping, lower, upper)


def oracle(problem: LeastSquares, b: int) -> NDArray[np.float64]:
    """The same as a plain least squares with more rows, given to scipy's active set method."""
    unknowns, root = len(problem.preferred), np.sqrt(problem.damping)
    rows = np.vstack([problem.jacobian[..., b], root * np.eye(unknowns)])
    values = np.concatenate([problem.wanted[:, b], root * problem.preferred[:, b]])
    bounds = problem.lower[:, b], problem.upper[:, b]
    return np.asarray(lsq_linear(rows, values, bounds, method="bvls", tol=1e-14).x)


@pytest.mark.parametrize("unknowns", [2, 3, 4])
@pytest.mark.parametrize("room", [0.3, 1.0, 3.0, 30.0])
def test_the_least_is_found_inside_and_on_every_kind_of_face(room: float, unknowns: int) -> None:
    problem = problems(60, 0.05, room, unknowns)
    found = solve_box(problem)
    wanted = np.stack([oracle(problem, b) for b in range(60)], axis=1)
    np.testing.assert_allclose(found, wanted, atol=1e-9)


def test_a_weak_preference_decides_what_the_rest_leaves_open() -> None:
    problem = problems(200, 1e-8, 2.0)
    found = solve_box(problem)
    for b in range(200):
        rest, best = (problem.jacobian[..., b] @ x - problem.wanted[:, b] for x in (found[:, b], oracle(problem, b)))
        assert rest @ rest <= best @ best + 1e-9


def test_no_bound_is_passed() -> None:
    problem = problems(2000, 1e-8, 1.0)
    found = solve_box(problem)
    assert ((problem.lower <= found) & (found <= problem.upper)).all()


def test_bounds_that_leave_no_room_are_the_solution() -> None:
    problem = problems(5, 1e-8, 0.0)
    np.testing.assert_array_equal(solve_box(problem), np.zeros((3, 5)))


def test_each_problem_is_solved_as_if_it_were_alone() -> None:
    problem = problems(50, 1e-8, 1.0)
    found = solve_box(problem)
    for chosen in ([7], [3, 1, 2], list(range(49, -1, -1))):
        some = solve_box(problem.among(np.array(chosen)))
        np.testing.assert_array_equal(some, found[:, chosen])
