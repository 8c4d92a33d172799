"""Many reproductions at once: policies called together, inverse kinematics in closed form, physics on all threads.

====================== =========================================================================================
``reproduction``       `reproduce_many`: the loop, one control step of all hands at a time
``policy_batch``       `PolicyBatch`: policies that move several hands are called once
``inverse_kinematics`` `ManyHandsController`: the problem that `HandController` gives to mink, for all arms
``box_least_squares``  its solution
``planar_arm``         forward kinematics
``physics``            the arm without the scenery, in `mujoco.batch`
====================== =========================================================================================
"""

from signimit_envs.arm.batch.reproduction import HandTracks as HandTracks
from signimit_envs.arm.batch.reproduction import reproduce_many as reproduce_many
