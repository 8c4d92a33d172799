"""Errors of `signimit_envs` that a caller can react to."""

from __future__ import annotations

from signimit import SignimitError


class RenderingError(SignimitError, RuntimeError):
    """Pictures cannot be drawn on this machine.

    Attributes:
        reason: What is missing.
        remedy: What to do about it.
    """

    def __init__(self, reason: str, remedy: str) -> None:
        """Keep both facts."""
        self.reason, self.remedy = reason, remedy
        super().__init__(reason, remedy)

    def __str__(self) -> str:
        """Return the sentence, with what to do."""
        return f"Cannot render: {self.reason}. {self.remedy}"
