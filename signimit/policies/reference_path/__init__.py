"""The path that the demonstrations of one movement share."""
