"""InkML documents, written and read."""

from collections.abc import Callable
from pathlib import Path

import pytest

from signimit import StrokeLibrary
from signimit.io.formats import read_inkml

HEAD = '<?xml version="1.0"?>\n<ink xmlns="http://www.w3.org/2003/InkML">\n'


@pytest.fixture
def read(tmp_path: Path) -> Callable[..., StrokeLibrary]:
    """Read a document with this body, from a file called house.inkml, strictly unless told otherwise."""

    def read_body(body: str, strict: bool = True) -> StrokeLibrary:
        path = tmp_path / "house.inkml"
        path.write_text(f"{HEAD}{body}</ink>", encoding="utf-8")
        return read_inkml(path, strict=strict)

    return read_body
