"""Running the studio on this machine."""

from __future__ import annotations

import functools
import secrets
import socket
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from signimit.exceptions import InvalidInputError, MissingDependencyError

LOCAL = "127.0.0.1"
_EVERYWHERE = ("0.0.0.0", "::", "")


@dataclass(frozen=True, kw_only=True)
class StudioPlan:
    """What is served, and where.

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
        InvalidInputError: If the address is not ours, or another studio uses the folder.
    """
    try:
        import uvicorn
        import websockets  # noqa: F401 -- uvicorn would go on without it, and without a socket
    except ImportError as error:
        raise MissingDependencyError(error.name or "uvicorn", "studio", "The studio") from None
    from signimit_envs.studio.demo import play_session
    from signimit_envs.studio.guard import Guard
    from signimit_envs.studio.limits import LIMITS
    from signimit_envs.studio.studio import Studio
    from signimit_envs.studio.web import create_app

    with _listen(plan.host, plan.port) as listener:
        port, token = listener.getsockname()[1], secrets.token_urlsafe(24)
        hosts = frozenset(f"{name}:{port}" for name in (LOCAL, "localhost", plan.host))
        play = functools.partial(play_session, seed=plan.seed) if plan.demo else None
        app = create_app(Studio(plan.folder, plan.seed), play)
        guard = Guard(app, token, hosts, any_address=plan.host != LOCAL)
        announce(f"http://{LOCAL if plan.host in _EVERYWHERE else plan.host}:{port}/{token}/")
        config = uvicorn.Config(
            guard,
            log_level="warning",
            access_log=False,
            server_header=False,
            ws="websockets-sansio",
            ws_max_size=4 * LIMITS.message,
            ws_per_message_deflate=False,
            timeout_graceful_shutdown=2,
        )
        uvicorn.Server(config).run(sockets=[listener])


def _listen(host: str, port: int) -> socket.socket:
    try:
        family = socket.AF_INET6 if ":" in host else socket.AF_INET
        listener = socket.create_server((host, port), family=family)
    except (OSError, OverflowError) as error:
        raise InvalidInputError(
            "address", "one of this machine's, with a free port", f"{host}:{port} ({error})"
        ) from None
    return listener
