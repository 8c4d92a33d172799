"""How far a share that was counted can be trusted."""

from __future__ import annotations

import math

_Z = 1.959963984540054  # standard normal quantile of 0.975


def wilson_interval(count: float, total: float) -> tuple[float, float]:
    """Compute Wilson's 95 % interval of a share (doi:10.1080/01621459.1927.10502953); (0, 1) of none."""
    if not total:
        return 0.0, 1.0
    share, spread = count / total, _Z**2 / total
    centre = (share + spread / 2) / (1 + spread)
    half = math.sqrt(share * (1 - share) * spread + spread**2 / 4) / (1 + spread)
    return max(0.0, centre - half), min(1.0, centre + half)
