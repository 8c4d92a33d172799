"""A part of the studio."""
