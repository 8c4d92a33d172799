"""What can be wrong with the simulated world."""

from __future__ import annotations

from signimit import SignimitError


class RenderingError(SignimitError, RuntimeError):
    """There is no way to draw a picture here.

    Attributes:
        reason: What is missing.
        remedy: What to do about it.
    """

    def __init__(self, reason: str, remedy: str) -> None:
        """Keep both facts and make the sentence."""
        self.reason, self.remedy = reason, remedy
        super().__init__(f"Cannot render: {reason}. {remedy}")
