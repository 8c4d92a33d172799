"""Records, a line of JSON each, that a kill cannot harm: at worst it takes with it what was under way."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

from signimit.exceptions import FileFormatError

Record = dict[str, Any]


def append_record(path: Path, record: Record) -> None:
    """Append a line in one write, and see it to the disk."""
    path.parent.mkdir(parents=True, exist_ok=True)
    line = json.dumps(record) + "\n"
    with path.open("ab") as file:
        file.write(line.encode())
        file.flush()
        os.fsync(file.fileno())


def read_records(path: Path) -> list[Record]:
    """Read all whole lines; a torn last one, all that a kill can leave, is cut off.

    Raises:
        FileFormatError: If another line is not a JSON object; the file is left as it is.
    """
    if not path.exists():
        return []
    text = path.read_bytes()
    whole = text[: text.rfind(b"\n") + 1]
    records = [_parse(line, f"{path}: line {number}") for number, line in enumerate(whole.splitlines(), 1)]
    if len(whole) < len(text):
        os.truncate(path, len(whole))
    return records


def _parse(line: bytes, where: str) -> Record:
    try:
        record = json.loads(line)
    except ValueError:
        record = None
    if not isinstance(record, dict):
        raise FileFormatError(where, "a JSON object", f"{line[:40].decode(errors='replace')!r}")
    return record
