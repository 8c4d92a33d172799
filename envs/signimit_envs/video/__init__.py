"""Pictures and films of the scene."""
