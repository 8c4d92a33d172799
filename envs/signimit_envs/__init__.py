"""Gymnasium environments in which instructions are unlabelled motion.

Importing this package registers ``signimit/Tabletop-v0`` and ``signimit/TabletopHand-v0``.
"""

import gymnasium as _gym

from signimit_envs.arm.batch import HandTracks as HandTracks
from signimit_envs.arm.batch import reproduce_many as reproduce_many
from signimit_envs.arm.scene import CONTROL_RATE as CONTROL_RATE
from signimit_envs.exceptions import RenderingError as RenderingError
from signimit_envs.sessions.reproduction import HandTrack as HandTrack
from signimit_envs.sessions.reproduction import reproduce as reproduce
from signimit_envs.tabletop.env import TabletopEnv as TabletopEnv
from signimit_envs.tabletop_hand import TabletopHandEnv as TabletopHandEnv
from signimit_envs.video.record_mp4 import RecordMp4 as RecordMp4

EPISODE_SECONDS = 12
ENV_IDS = ("signimit/Tabletop-v0", "signimit/TabletopHand-v0")

for _id, _env in zip(ENV_IDS, ("tabletop:TabletopEnv", "tabletop_hand:TabletopHandEnv"), strict=True):
    _gym.register(id=_id, entry_point=f"signimit_envs.{_env}", max_episode_steps=EPISODE_SECONDS * CONTROL_RATE)
