"""The simulated arm: scene, constants, and differential inverse kinematics (paper, section II-F)."""
