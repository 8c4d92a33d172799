"""Compiled distances (numba, the extra ``fast``): the same answers as the numpy code, several times as fast.

Import this package through `signimit.acceleration.find_kernels` only: it needs numba.
"""

from __future__ import annotations

from signimit.kernels.drawings import drawing_distances as drawing_distances
from signimit.kernels.policies import one_way_policy_distances as one_way_policy_distances
from signimit.kernels.signs import sign_distances as sign_distances
