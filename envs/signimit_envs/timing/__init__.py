"""Times of this machine, as ratios."""
