"""Processes that sessions are spread over, and that stop without a word when the user does.

A terminal interrupts every process that runs in it. The one that waits for the others says what there is to say: a
traceback of each of them, from wherever it was, would bury that.
"""

from __future__ import annotations

import multiprocessing
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing.synchronize import Event
from types import TracebackType
from typing import Any, ParamSpec, TypeVar

_Arguments = ParamSpec("_Arguments")
_Result = TypeVar("_Result")
_stopping: list[Event] = []  # of a worker: set once nobody waits for its results


class SessionProcesses(ProcessPoolExecutor):
    """Pool of fresh processes; a block that is left by an error or an interrupt does not wait for what is under way."""

    def __init__(self, workers: int, initialise: Callable[..., None] | None = None, *arguments: object) -> None:
        """Start processes, which call a function first, if there is one."""
        context = multiprocessing.get_context("spawn")
        self._stop = context.Event()
        super().__init__(workers, context, _begin, (self._stop, initialise, arguments))
        with _ignored_interrupts():  # a process ignores from its first moment on what its parent ignores
            for _ in range(workers):  # one is started for each task while none is idle
                super().submit(_wake)

    def submit(
        self, fn: Callable[_Arguments, _Result], /, *args: _Arguments.args, **kwargs: _Arguments.kwargs
    ) -> Future[_Result]:
        """Schedule a call."""
        return super().submit(_interruptible, fn, args, kwargs)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """Wait for all calls, or, if the block was left otherwise than by its end, only for those under way to stop."""
        if kind is not None:
            self._stop.set()
        self.shutdown(cancel_futures=kind is not None)


@contextmanager
def _ignored_interrupts() -> Iterator[None]:
    if threading.current_thread() is not threading.main_thread():
        yield  # signals are not its to handle
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _begin(stop: Event, initialise: Callable[..., None] | None, arguments: tuple[object, ...]) -> None:
    _stopping.append(stop)
    if initialise is not None:
        initialise(*arguments)


def _interruptible(call: Callable[..., Any], args: tuple[Any, ...], kwargs: dict[str, Any]) -> Any:
    """Call a function, which alone is interrupted: what moves results from process to process must not break off."""
    if _stopping[0].is_set():
        raise KeyboardInterrupt
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        return call(*args, **kwargs)
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def _wake() -> None:
    """Do nothing: it is a task that a process starts for."""
