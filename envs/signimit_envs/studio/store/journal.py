"""A file that only grows: one line of JSON for each thing that happened, on the disk before anybody hears of it.

A process that is killed while it writes leaves at most one line without an end; whoever opens the file next
cuts it off.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from signimit.exceptions import FileFormatError

MAX_BYTES = 512 * 2**20  # a journal that is larger is not ours


def append_line(path: Path, value: Mapping[str, Any]) -> None:
    """Add a line and wait until it is on the disk.

    Raises:
        OSError: If it cannot be written; what is there then counts as cut off.
        ValueError: If the value has a number that JSON cannot say.
    """
    line = json.dumps(value, separators=(",", ":"), allow_nan=False).encode() + b"\n"
    with open(path, "ab") as file:
        whole = file.tell()
        try:
            file.write(line)
            file.flush()
            os.fsync(file.fileno())
        except OSError:  # a full disk: half a line must not spoil the next one
            os.truncate(path, whole)
            raise


def mend(path: Path) -> None:
    """Cut off a last line that has no end."""
    with open(path, "r+b") as file:
        size = file.seek(0, os.SEEK_END)
        end = size
        while end:
            start = max(0, end - 2**16)
            file.seek(start)
            cut = file.read(end - start).rfind(b"\n")
            if cut >= 0:
                end = start + cut + 1
                break
            end = start
        if end < size:
            file.truncate(end)


def read_lines(path: Path) -> Iterator[dict[str, Any]]:
    """Read all whole lines.

    Raises:
        FileFormatError: Names the file and the line that is not ours.
        OSError: If there is no such file.
    """
    if path.stat().st_size > MAX_BYTES:
        raise FileFormatError(str(path), f"at most {MAX_BYTES} bytes", f"{path.stat().st_size}")
    with open(path, "rb") as file:
        for number, line in enumerate(file, 1):
            if not line.endswith(b"\n"):
                return
            try:
                value = json.loads(line)
            except (ValueError, RecursionError):
                value = None
            if not isinstance(value, dict):
                raise FileFormatError(f"{path}: line {number}", "a JSON object", f"{line[:40]!r}")
            yield value
