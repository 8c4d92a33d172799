"""How long things take on this machine: as ratios within one run wherever there is a plainer way to compare with."""
