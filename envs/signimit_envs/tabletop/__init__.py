"""The tabletop environment, and what its observations, actions, rewards and options are."""

from signimit_envs.tabletop.env import TabletopEnv as TabletopEnv
