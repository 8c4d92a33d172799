"""Files of the project: the MJCF scene with its texture, and the page of the studio. Imports nothing."""
