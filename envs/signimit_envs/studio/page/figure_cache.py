"""Pictures that were made already: the latest of them are kept."""

from __future__ import annotations

from collections.abc import Callable, Hashable

_MOST = 24  # figures of a fifth of a megabyte


class Album:
    """Keeps the bytes of the latest pictures by what they show; for any thread, as each access is one operation."""

    def __init__(self, most: int = _MOST) -> None:
        """Begin with no picture; of more than ``most`` the oldest ones go."""
        self._most = most
        self._pages: dict[Hashable, bytes] = {}

    def find(self, shown: Hashable) -> bytes | None:
        """Return the picture that shows something, if it is kept."""
        return self._pages.get(shown)

    def fill(self, shown: Hashable, make: Callable[[], bytes]) -> bytes:
        """Return the picture that shows something; make and keep it if there is none. For one thread at a time."""
        found = self.find(shown)
        if found is None:
            found = self._pages[shown] = make()
            for oldest in list(self._pages)[: -self._most]:
                del self._pages[oldest]
        return found
