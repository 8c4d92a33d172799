"""Serving the studio: listener, address with a token, and the server in this thread or another."""

from __future__ import annotations

import functools
import secrets
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from signimit.exceptions import InvalidInputError, MissingDependencyError

if TYPE_CHECKING:
    import uvicorn

LOCAL = "127.0.0.1"
_EVERYWHERE = ("0.0.0.0", "::", "")


@dataclass(frozen=True, kw_only=True)
class StudioPlan:
    """Settings of a served studio.

    Attributes:
        folder: Where sessions are kept.
        host: Address to listen on.
        port: Port; 0 for any that is free.
        seed: Decides what happens in new sessions.
        demo: Play a whole session by itself.
    """

    folder: Path
    host: str = LOCAL
    port: int = 0
    seed: int = 0
    demo: bool = False


def serve_studio(plan: StudioPlan, announce: Callable[[str], object]) -> None:
    """Serve the studio until it is interrupted.

    Args:
        plan: What and where.
        announce: Told the address of the page, token and all, as soon as it can be opened.

    Raises:
        MissingDependencyError: If the extra ``studio`` is not installed.
        InvalidInputError: If the address is none of this machine, or another studio uses the folder.
    """
    with _listen(plan.host, plan.port) as listener:
        server, address = _make_server(plan, listener)
        announce(address)
        server.run(sockets=[listener])


@contextmanager
def running_studio(plan: StudioPlan) -> Iterator[str]:
    """Serve the studio in a thread, and give its address.

    Raises:
        MissingDependencyError: If the extra ``studio`` is not installed.
        InvalidInputError: If the address is none of this machine, or another studio uses the folder.
    """
    with _listen(plan.host, plan.port) as listener:
        server, address = _make_server(plan, listener)
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]}, name="studio")
        thread.start()
        try:
            yield address
        finally:
            server.should_exit = True
            thread.join()


def _make_server(plan: StudioPlan, listener: socket.socket) -> tuple[uvicorn.Server, str]:
    """Make the server of a studio, and its address."""
    try:
        import uvicorn
        import websockets  # noqa: F401 -- uvicorn would go on without it, and without a socket
    except ImportError as error:
        raise MissingDependencyError(error.name or "uvicorn", "studio", "The studio") from None
    from signimit_envs.studio.demo import play_session
    from signimit_envs.studio.limits import LIMITS
    from signimit_envs.studio.studio import Studio
    from signimit_envs.studio.web.app import create_app
    from signimit_envs.studio.web.connections import HttpConnection, SocketConnection
    from signimit_envs.studio.web.guard import Guard

    port, token = listener.getsockname()[1], secrets.token_urlsafe(24)
    play = functools.partial(play_session, seed=plan.seed) if plan.demo else None
    app = create_app(Studio(plan.folder, plan.seed), play)
    hosts = frozenset(f"{name}:{port}" for name in (LOCAL, "localhost", plan.host))
    config = uvicorn.Config(
        Guard(app, token, hosts, any_address=plan.host != LOCAL),
        log_level="warning",
        access_log=False,
        server_header=False,
        http=HttpConnection,
        ws=SocketConnection,
        ws_max_size=4 * LIMITS.message,
        ws_per_message_deflate=False,
        timeout_graceful_shutdown=2,
    )
    name = LOCAL if plan.host in _EVERYWHERE else plan.host
    return uvicorn.Server(config), f"http://{f'[{name}]' if ':' in name else name}:{port}/{token}/"


def _listen(host: str, port: int) -> socket.socket:
    try:
        family = socket.AF_INET6 if ":" in host else socket.AF_INET
        listener = socket.create_server((host, port), family=family)
    except (OSError, OverflowError) as error:
        raise InvalidInputError(
            "address", "one of this machine's, with a free port", f"{host}:{port} ({error})"
        ) from None
    return listener
