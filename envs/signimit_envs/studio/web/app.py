"""The web application: the page's files, the routes, and a code and a sentence for each kind of error."""

from __future__ import annotations

import asyncio
import contextlib
import functools
import logging
from collections.abc import AsyncIterator, Callable, Coroutine
from contextlib import asynccontextmanager
from importlib import resources
from typing import Any

import signimit_assets
from signimit import __version__
from signimit.exceptions import MissingDependencyError, SignimitError
from signimit_envs.exceptions import RenderingError

try:
    from fastapi import FastAPI, Request, Response
    from fastapi.exceptions import RequestValidationError
    from fastapi.responses import JSONResponse
    from starlette.exceptions import HTTPException
except ImportError:
    raise MissingDependencyError("fastapi", "studio", "The studio") from None

from signimit_envs.arm.scene import OBJECT_NAMES, TABLE, WORKSPACE
from signimit_envs.studio.arm.camera import OPENGL_PATIENCE, object_colours, picture_mapping
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.open_session import NotFoundError, StaleRevisionError
from signimit_envs.studio.page.exports import FORMATS
from signimit_envs.studio.page.prompts import FREE, LANGUAGES
from signimit_envs.studio.studio import BusyError, Studio
from signimit_envs.studio.web.messages import describe_errors, printable
from signimit_envs.studio.web.routes import ask as ask_routes
from signimit_envs.studio.web.routes import keep as keep_routes
from signimit_envs.studio.web.routes import look as look_routes
from signimit_envs.studio.web.routes import teach as teach_routes

MEDIA_TYPES = {
    ".html": "text/html",
    ".js": "text/javascript",
    ".css": "text/css",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".ico": "image/x-icon",
    ".webmanifest": "application/manifest+json",
}
_LOOKING = ["GET", "HEAD"]  # what checks whether an address is there asks for its head
Play = Callable[[Studio], Coroutine[Any, Any, None]]
_log = logging.getLogger(__name__)


def create_app(studio: Studio, play: Play | None = None) -> FastAPI:
    """Make the application, without the guard; it starts the studio and closes it.

    Args:
        studio: What it serves.
        play: Plays on the page by itself, once the studio is open; nothing if left out.
    """

    async def run_play(play: Play) -> None:
        try:
            await play(studio)
        except (SignimitError, OSError):  # the session that plays was changed or removed
            _log.exception("the session that plays itself ended")

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        studio.start()
        playing = None if play is None else asyncio.create_task(run_play(play))
        try:
            yield
        finally:
            if playing is not None:
                playing.cancel()
                with contextlib.suppress(asyncio.CancelledError):
                    await playing
            await asyncio.to_thread(studio.close)

    app = FastAPI(
        title="signimit studio",
        version=__version__,
        docs_url=None,  # its page would fetch a script from elsewhere
        redoc_url=None,
        lifespan=lifespan,
        exception_handlers=_HANDLERS,
    )
    app.state.studio = studio
    for part in (teach_routes, ask_routes, look_routes, keep_routes):
        app.include_router(part.routes)

    @app.get("/api/studio", tags=["studio"])
    async def about() -> dict[str, Any]:
        why_not = await asyncio.to_thread(studio.camera.unavailable_reason, OPENGL_PATIENCE)
        return {**_facts(), "can_draw": not why_not, "why_not": why_not, "demo": studio.demo}

    @app.get("/api/health", tags=["studio"])
    async def health() -> dict[str, Any]:
        state = studio.arm.state
        told = {name: getattr(state, name) for name in ("time", "clock", "lost")}
        return {**told, "frames": studio.camera.frames, "viewers": len(studio.viewers)}

    _serve_page(app)
    return app


@functools.cache
def _facts() -> dict[str, Any]:
    return {
        "version": __version__,
        "picture": picture_mapping(),
        "table": TABLE.tolist(),
        "workspace": WORKSPACE.tolist(),
        "objects": list(OBJECT_NAMES),
        "colours": object_colours(),
        "languages": [*LANGUAGES, FREE],
        "limits": {name: getattr(LIMITS, name) for name in LIMITS.__dataclass_fields__},
        "exports": list(FORMATS),
    }


def _serve_page(app: FastAPI) -> None:
    """Serve the files of the page, which are known by name beforehand."""
    folder = resources.files(signimit_assets) / "studio"
    files = {file.name: file for file in folder.iterdir()} if folder.is_dir() else {}
    types = {name: MEDIA_TYPES.get("." + name.rpartition(".")[2]) for name in files}

    @app.api_route("/", methods=_LOOKING, include_in_schema=False)
    async def page() -> Response:
        return await page_file("index.html")

    @app.api_route("/{name}", methods=_LOOKING, include_in_schema=False)
    async def page_file(name: str) -> Response:
        media_type = types.get(name)
        if media_type is None:
            raise NotFoundError("There is no such page.")
        return Response(files[name].read_bytes(), media_type=media_type)


def _error_response(status: int, sentence: str, **more: Any) -> JSONResponse:
    plain = printable(sentence)
    _log.warning("refused with %d: %s", status, plain)
    return JSONResponse({"error": plain, **more}, status)


async def _handle_known_error(request: Request, error: Exception) -> Response:
    """Answer with the code of the error's kind; its text is a sentence already."""
    codes = (status for kind, status in _CODES.items() if isinstance(error, kind))
    more = {"revision": error.latest} if isinstance(error, StaleRevisionError) else {}
    return _error_response(next(codes), str(error), **more)


async def _handle_os_error(request: Request, error: Exception) -> Response:
    reason = getattr(error, "strerror", None) or "the disk failed"
    return _error_response(507, f"The studio could not keep this: {reason}.")


async def _handle_unexpected_error(request: Request, error: Exception) -> Response:
    return _error_response(500, "The studio failed; its log says how.")


async def _handle_http_error(request: Request, error: Exception) -> Response:
    status, detail = getattr(error, "status_code", 500), getattr(error, "detail", "It failed")
    return _error_response(status, f"{detail}.")


async def _handle_validation_error(request: Request, error: Exception) -> Response:
    errors = error.errors() if isinstance(error, RequestValidationError) else ()
    status = 400 if any(one["type"] == "json_invalid" for one in errors) else 422
    return _error_response(status, describe_errors(errors))


_CODES: dict[type[Exception], int] = {  # of an error's kinds the first counts
    StaleRevisionError: 409,
    RenderingError: 503,
    NotFoundError: 404,
    BusyError: 429,
    SignimitError: 422,
}
_HANDLERS: dict[int | type[Exception], Callable[[Request, Any], Coroutine[Any, Any, Response]]] = {
    **dict.fromkeys(_CODES, _handle_known_error),
    OSError: _handle_os_error,
    HTTPException: _handle_http_error,
    RequestValidationError: _handle_validation_error,
    Exception: _handle_unexpected_error,
}
