"""The origin of a recording as plain files: the environment as JSON, the model as MJCF with its assets."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from signimit.exceptions import FileFormatError
from signimit_envs.recording.origin import RecordingOrigin

HEADER, MODEL = "recording.json", "model.xml"
_MAX_FILES = 100
_NOT_IN_HEADER = ("model_xml", "assets")


def write_origin(folder: Path, origin: RecordingOrigin, header: dict[str, Any]) -> None:
    """Write ``recording.json`` with the header and the environment, ``model.xml`` and what that names, beside it."""
    meta = {name: value for name, value in origin.to_meta().items() if name not in _NOT_IN_HEADER}
    text = json.dumps({**header, "origin": {**meta, "assets": sorted(origin.assets)}}, indent=1)
    (folder / HEADER).write_text(text + "\n", encoding="utf-8")
    (folder / MODEL).write_bytes(origin.model_xml.encode("utf-8"))
    for name, data in origin.assets.items():
        (folder / name).write_bytes(data)


def read_origin(folder: Path, kind: str, version: int) -> tuple[RecordingOrigin, dict[str, Any]]:
    """Read what `write_origin` wrote.

    Returns:
        The origin, and the header.

    Raises:
        FileFormatError: If something is missing, or it is of another kind or newer than ``version``.
    """
    where = os.fspath(folder / HEADER)
    try:
        header = json.loads((folder / HEADER).read_bytes())
        found, number = header["kind"], int(header["version"])
        if found != kind or number > version:
            raise FileFormatError(where, f"a {kind} of version <= {version}", f"{found} version {number}")
        meta = dict(header["origin"])
        names = [str(name) for name in meta.pop("assets")]
        xml = (folder / MODEL).read_bytes().decode("utf-8")
    except FileFormatError:
        raise
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise FileFormatError(where, f"a whole {kind} of signimit", f"{error!r:.120}") from None
    for name in names:
        if name != Path(name).name or name in (HEADER, MODEL) or len(names) > _MAX_FILES:
            raise FileFormatError(where, "assets beside it", f"{name!r:.80}")
    origin = RecordingOrigin.from_meta({**meta, "model_xml": xml, "assets": {}}, where)
    try:
        assets = {name: (folder / name).read_bytes() for name in names}
    except OSError as error:
        raise FileFormatError(where, f"the asset {error.filename}", f"{error.strerror}") from None
    return RecordingOrigin(**{**vars(origin), "assets": assets}), header
