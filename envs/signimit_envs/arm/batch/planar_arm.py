"""Forward kinematics of many planar arms, without the simulator.

Arrays have their components first and the B arms last, so that every operation runs along the arms.
"""

from __future__ import annotations

from typing import NamedTuple, Self

import mujoco
import numpy as np
from numpy.typing import NDArray

from signimit_envs.arm.scene import home_posture

Array = NDArray[np.float64]


class PlanarArm(NamedTuple):
    """A chain of n links in a plane, each turned about its beginning and pointing along y at angle 0.

    Attributes:
        base: Position of the first joint, shape (2, 1), m, table frame.
        lengths: Lengths of the links, shape (n, 1), m.
        lower: Lower limits of the joint angles, shape (n, 1), rad.
        upper: Upper limits of the joint angles, shape (n, 1), rad.
        home: Joint angles of the posture that it prefers, shape (n, 1), rad.
    """

    base: Array
    lengths: Array
    lower: Array
    upper: Array
    home: Array

    @classmethod
    def from_model(cls, model: mujoco.MjModel) -> Self:
        """Read the arm of the scene, whose hand is the site ``hand``."""
        bodies = model.jnt_bodyid
        offsets = np.vstack([model.body_pos[bodies[1:]], model.site("hand").pos])
        base = model.body_pos[bodies[0]] + model.body_pos[model.body_parentid[bodies[0]]]
        lower, upper = model.jnt_range.T
        columns = (base[:2], offsets[:, 1], lower, upper, home_posture(model))
        return cls(*(np.array(column, dtype=np.float64)[:, None] for column in columns))

    def reaches(self, joints: Array) -> Array:
        """Return the vectors from each joint to the hand.

        Args:
            joints: Joint angles, shape (n, B), rad.

        Returns:
            Vectors, shape (2, n, B), m, table frame. A joint's share of the hand's Jacobian is its vector, turned by a
            quarter counter-clockwise.
        """
        angles = np.add.accumulate(joints, axis=0)
        reaches = np.empty((2, *joints.shape))
        np.multiply(np.sin(angles), -self.lengths, out=reaches[0])
        np.multiply(np.cos(angles), self.lengths, out=reaches[1])
        for joint in range(len(joints) - 2, -1, -1):
            reaches[:, joint] += reaches[:, joint + 1]
        return reaches

    def hands(self, joints: Array) -> Array:
        """Return the positions of the hands, shape (2, B), m, table frame, given joint angles of shape (n, B), rad."""
        hands: Array = self.base + self.reaches(joints)[:, 0]
        return hands
