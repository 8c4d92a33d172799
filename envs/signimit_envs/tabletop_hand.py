"""The environment `signimit/TabletopHand-v0`: actions are velocities of the hand, mink solves for the joints."""

from __future__ import annotations

from typing import Any

from signimit_envs.tabletop.env import TabletopEnv


class TabletopHandEnv(TabletopEnv):
    """Obey two signs with hand velocities: `TabletopEnv` with ``control="hand"`` unless something else is asked for.

    Action space:
        ``Box(-1, 1, (2,), float32)``: velocity of the hand along x and y, in units of `max_hand_speed`, for 1/50 s.
        mink solves for the joints, one control step ahead of the actual hand, within the limits of joints and drives.
        Beyond its reach the hand goes as far as it can, and ``info["ik_residual"]`` says how much of the displacement
        is missing, m.

    Everything else is as in `TabletopEnv`.

    Version history:
        v0: first version.
    """

    def __init__(self, *arguments: Any, control: str = "hand", **named: Any) -> None:
        """Build the scene; see `TabletopEnv` for the arguments."""
        super().__init__(*arguments, control=control, **named)
