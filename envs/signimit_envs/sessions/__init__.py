"""Sessions as in the paper's section III, on the physics."""
