"""Box-constrained damped least squares in closed form, for many small problems at once.

Each problem has one solution, which lies inside the box or on one of its faces. Nearly always it lies inside, so that
is tried first; for the rest every face is tried, 26 for three unknowns.
"""

from __future__ import annotations

from functools import cache
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_ROUNDING = 1e-12  # in the unknowns' unit; by so much a solution on a face may pass the other bounds


class LeastSquares(NamedTuple):
    """B problems of n unknowns x: minimise ``|J x - d|² + λ |x - p|²`` for lower <= x <= upper.

    Attributes:
        jacobian: J, shape (2, n, B).
        wanted: d, shape (2, B).
        preferred: p, shape (n, B).
        damping: λ, above 0.
        lower: Shape (n, B).
        upper: Shape (n, B), nowhere below ``lower``.
    """

    jacobian: Array
    wanted: Array
    preferred: Array
    damping: float
    lower: Array
    upper: Array

    def among(self, chosen: NDArray[np.intp]) -> LeastSquares:
        """Return the problems of some numbers, shape (C,)."""
        return LeastSquares(
            jacobian=self.jacobian[..., chosen],
            wanted=self.wanted[:, chosen],
            preferred=self.preferred[:, chosen],
            damping=self.damping,
            lower=self.lower[:, chosen],
            upper=self.upper[:, chosen],
        )


def solve_box(problem: LeastSquares) -> Array:
    """Return the solutions x, shape (n, B)."""
    solution = _stationary(problem, problem.preferred, 1.0)
    outside = ((solution < problem.lower) | (solution > problem.upper)).any(axis=0)
    limited = np.flatnonzero(outside)
    if len(limited):
        solution[:, limited] = _best_face(problem.among(limited))
    return solution


def _stationary(problem: LeastSquares, start: Array, free: Array | float) -> Array:
    """Return the minimum of the objective over some unknowns, the others held at their start.

    With F the columns of J that are free, it is start + Fᵀ (F Fᵀ + λ)⁻¹ (d - J start): two by two, however many
    unknowns.

    Args:
        problem: The problems.
        start: Preferred value of what is free, value of what is not, shape (..., n, B).
        free: 1 for what is free, 0 for what is not, shape (..., n, 1).
    """
    left_x, left_y = (problem.wanted[axis] - (problem.jacobian[axis] * start).sum(axis=-2) for axis in (0, 1))
    x, y = problem.jacobian[0] * free, problem.jacobian[1] * free
    xx, yy = (np.square(row).sum(axis=-2) + problem.damping for row in (x, y))
    xy = (x * y).sum(axis=-2)
    determinant = xx * yy - xy * xy
    along_x = (yy * left_x - xy * left_y) / determinant
    along_y = (xx * left_y - xy * left_x) / determinant
    solution: Array = start + x * along_x[..., None, :] + y * along_y[..., None, :]
    return solution


def _best_face(problem: LeastSquares) -> Array:
    """Return the best of the faces' minima that lie within the box, shape (n, B)."""
    _, _, preferred, damping, lower, upper = problem
    sides = _faces(len(preferred))
    fixed = np.where(sides < 0, lower, upper)
    solutions = _stationary(problem, np.where(sides == 0, preferred, fixed), (sides == 0).astype(np.float64))
    inside = ((solutions >= lower - _ROUNDING) & (solutions <= upper + _ROUNDING)).all(axis=1)
    cost = damping * np.square(solutions - preferred).sum(axis=1)
    for axis in (0, 1):
        cost += np.square((problem.jacobian[axis] * solutions).sum(axis=1) - problem.wanted[axis])
    best = np.where(inside, cost, np.inf).argmin(axis=0)
    return solutions[best, :, np.arange(len(best))].T.clip(lower, upper)


@cache
def _faces(unknowns: int) -> NDArray[np.int64]:
    """Return which bound holds each unknown on each face, shape (3^n - 1, n, 1): -1 the lower, 1 the upper, 0 none."""
    sides = np.array([face for face in product((-1, 0, 1), repeat=unknowns) if any(face)])
    sides.setflags(write=False)
    return sides[..., None]
