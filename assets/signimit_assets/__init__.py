"""Files of the project: the MJCF scene and the built-in strokes. Imports nothing."""
