"""FastAPI dependencies and path parameters that the routes share."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import Depends, Path
from starlette.requests import HTTPConnection

from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.studio import Studio


async def _get_studio(connection: HTTPConnection) -> Studio:
    studio: Studio = connection.app.state.studio
    return studio


TheStudio = Annotated[Studio, Depends(_get_studio)]
SessionId = Annotated[str, Path(max_length=64)]
Number = Annotated[int, Path(ge=0, le=LIMITS.answers)]
Json = dict[str, Any]
