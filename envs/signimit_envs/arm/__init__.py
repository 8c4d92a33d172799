"""The simulated planar arm (paper, section II-F).

====================== ================================================================================
``scene``              the MuJoCo scene, every constant of table and arm, and the action of a velocity
``arm``                `Arm`: state and control steps of one arm
``inverse_kinematics`` `HandController`: hand velocities to joint velocities, by mink
``batch``              many arms at once, in closed form
====================== ================================================================================
"""
