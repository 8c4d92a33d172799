"""Old name of `signimit_envs.arm.batch`, which the README of version 0.1.0 told users to import."""

from signimit_envs.arm.batch import HandTracks as HandTracks
from signimit_envs.arm.batch import reproduce_many as reproduce_many
