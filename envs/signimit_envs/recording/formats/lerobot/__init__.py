"""LeRobot's data set layout, version 3, with pyarrow alone."""
