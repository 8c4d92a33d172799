"""Tests of the studio's server: a package, so that the studio that they share ends with them."""
