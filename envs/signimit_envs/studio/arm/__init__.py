"""The arm of the studio: physics in real time, the camera on it, and the pages that watch."""
