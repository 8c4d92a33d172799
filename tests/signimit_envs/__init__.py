"""Tests of the environments, the arm, sessions, films, recordings, commands and the studio."""
