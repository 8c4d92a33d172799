"""Mailboxes of the pages that watch: the newest frame that each has time for, and all messages."""

from __future__ import annotations

import asyncio
import json
import threading
from collections import deque
from typing import Any

_MOST_NEWS = 100  # messages not yet sent to a page; one that is so far behind gets the latest only


class Viewer:
    """Mailbox of a page. Any thread may put something in; the page's own event loop takes it out."""

    def __init__(self) -> None:
        """Start empty, in the running event loop."""
        self._loop = asyncio.get_running_loop()
        self._something = asyncio.Event()
        self._frame: bytes | None = None
        self._news: deque[str] = deque(maxlen=_MOST_NEWS)
        self.watching = False

    def put_frame(self, frame: bytes) -> None:
        """Offer a frame; one that was not sent yet is dropped."""
        self._frame = frame
        self._wake()

    def put_news(self, text: str) -> None:
        """Offer a message."""
        self._news.append(text)
        self._wake()

    async def take(self) -> str | bytes:
        """Wait for something to send, news first."""
        while True:
            if self._news:
                return self._news.popleft()
            frame, self._frame = self._frame, None
            if frame is not None:
                return frame
            self._something.clear()
            if not self._news and self._frame is None:
                await self._something.wait()

    def _wake(self) -> None:
        try:
            self._loop.call_soon_threadsafe(self._something.set)
        except RuntimeError:  # the loop ended; so will the page
            return


class Viewers:
    """The mailboxes of all pages."""

    def __init__(self) -> None:
        """Start without pages."""
        self._all: set[Viewer] = set()
        self._lock = threading.Lock()
        self._standing: str | None = None

    def __len__(self) -> int:
        """Return the number of pages."""
        return len(self._all)

    @property
    def watching(self) -> bool:
        """Whether a page wants frames."""
        return any(viewer.watching for viewer in self._listed())

    def add(self, viewer: Viewer) -> None:
        """Add a page."""
        with self._lock:
            self._all.add(viewer)
        if self._standing is not None:
            viewer.put_news(self._standing)

    def remove(self, viewer: Viewer) -> None:
        """Remove a page; may be called again."""
        with self._lock:
            self._all.discard(viewer)

    def publish(self, frame: bytes) -> None:
        """Offer a frame to all pages that watch."""
        for viewer in self._listed():
            if viewer.watching:
                viewer.put_frame(frame)

    def tell(self, news: dict[str, Any], standing: bool = False) -> None:
        """Send all pages a message; a standing one is also the first that new pages get."""
        text = json.dumps(news)
        if standing:
            self._standing = text
        for viewer in self._listed():
            viewer.put_news(text)

    def forget(self) -> None:
        """Send new pages no standing message any more."""
        self._standing = None

    def _listed(self) -> list[Viewer]:
        with self._lock:
            return list(self._all)
