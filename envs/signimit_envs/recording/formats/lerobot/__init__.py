"""LeRobot data sets, version 3, written and read with pyarrow alone.

================== ==========================================================
``layout``         which files there are, and the types of what is in them
``metadata``       features, statistics, episodes and tasks
``frames``         tables of frames, and videos
``recordings``     recordings as such data sets
``demonstrations`` demonstrations as such data sets
================== ==========================================================
"""
