"""Gymnasium environments in which instructions are unlabelled motion.

Importing this package registers ``signimit/Tabletop-v0`` and ``signimit/TabletopHand-v0``.

================= =======================================================================================
``tabletop``      the environments: actions, observations, rewards, success, reset options, languages
``tabletop_hand`` the environment whose actions are velocities of the hand
``arm``           the simulated arm: scene, constants, inverse kinematics; ``arm.batch`` many arms at once
``sessions``      sessions of the paper on the simulated arm, their scores and reports
``video``         pictures and films of the scene
``recording``     episodes with their physics states, replayed exactly, in several file formats
``studio``        the web page on which a user teaches and commands the arm
``robustness``    what is tried to break the loaders and writers: damaged files, killed writers, full disks
``timing``        how long learning, obeying and the environments take
``cli``           the commands
``mujoco_import`` the first import of MuJoCo, which must not fail where only pictures would
================= =======================================================================================
"""

import gymnasium as _gym

from signimit_envs import mujoco_import as mujoco_import  # before all that imports MuJoCo
from signimit_envs.arm.batch import HandTracks as HandTracks
from signimit_envs.arm.batch import reproduce_many as reproduce_many
from signimit_envs.arm.scene import CONTROL_RATE as CONTROL_RATE
from signimit_envs.exceptions import RenderingError as RenderingError
from signimit_envs.sessions.episode import Episode as Episode
from signimit_envs.sessions.episode import run_episode as run_episode
from signimit_envs.sessions.reproduction import HandTrack as HandTrack
from signimit_envs.sessions.reproduction import reproduce as reproduce
from signimit_envs.tabletop.env import TabletopEnv as TabletopEnv
from signimit_envs.tabletop_hand import TabletopHandEnv as TabletopHandEnv
from signimit_envs.video.record_mp4 import RecordMp4 as RecordMp4

__all__ = [
    "CONTROL_RATE",
    "ENV_IDS",
    "EPISODE_SECONDS",
    "Episode",
    "HandTrack",
    "HandTracks",
    "RecordMp4",
    "RenderingError",
    "TabletopEnv",
    "TabletopHandEnv",
    "reproduce",
    "reproduce_many",
    "run_episode",
]

EPISODE_SECONDS = 12  # simulated time until an episode is truncated
ENV_IDS = ("signimit/Tabletop-v0", "signimit/TabletopHand-v0")

for _id, _env in zip(ENV_IDS, ("tabletop:TabletopEnv", "tabletop_hand:TabletopHandEnv"), strict=True):
    _gym.register(id=_id, entry_point=f"signimit_envs.{_env}", max_episode_steps=EPISODE_SECONDS * CONTROL_RATE)
