"""Statements of UNIPEN text: a keyword in the first column, and what follows up to the next one."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path, PureWindowsPath
from typing import NamedTuple

from signimit.exceptions import FileFormatError
from signimit.io.formats.import_report import Finding
from signimit.io.formats.textfile import MAX_BYTES, read_any_text

MOST_STATEMENTS = 2_000_000
MOST_INCLUDES = 1000
DEEPEST_INCLUDE = 20
_KEYWORD = re.compile(r"^\.([A-Z][A-Z0-9_]*)(?=\s|$)", re.MULTILINE)
_DRAWS = frozenset({"PEN_DOWN", "SEGMENT"})
_FIRST = re.compile(
    r"\.(?:VERSION|INCLUDE|COMMENT|DATA_|KEYWORD|RESERVE|HIERARCHY|COORD|ALPHABET|LEXICON|SETUP|PAD|DATE|WRITER_|[XY]_|"
    r"[HV]_LINE|POINTS_PER_|START_|SEGMENT|PEN_|STYLE|COUNTRY|HAND|AGE|SEX|SKILL)"
)


class Statement(NamedTuple):
    """One statement.

    Attributes:
        keyword: Without its dot, e.g. ``"SEGMENT"``.
        body: All that follows, of any number of lines; the first one begins on the keyword's own line.
        path: File in which it stands.
        line: Number of the keyword's line.
    """

    keyword: str
    body: str
    path: str
    line: int

    @property
    def where(self) -> str:
        """File and line, for errors."""
        return f"{self.path}: line {self.line}"


def is_unipen(text: str) -> bool:
    """Tell whether a whole text is UNIPEN with drawings: it begins with a keyword, and has segments or pen data."""
    return bool(_FIRST.match(text.lstrip())) and any(found[1] in _DRAWS for found in _KEYWORD.finditer(text))


@dataclass
class StatementReader:
    """Reader of the statements of a file and of those that it includes.

    An included file is looked for in the folder of the file that names it, in that of the first file, and, as data set
    train_r01_v07 is laid out, in a folder ``include`` beside a folder ``data`` that holds the first file. What is
    outside these folders is not read, wherever a name or a link points.

    Attributes:
        path: The first file.
        findings: What was passed over.
        included: Files that were read.
    """

    path: str
    findings: list[Finding] = field(default_factory=list)
    included: list[Path] = field(default_factory=list)
    _counts: Counter[str] = field(default_factory=Counter)
    _open: list[Path] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Find the folders that may be read."""
        folder = Path(self.path).resolve().parent
        beside = (f.parent / "include" for f in (folder, *folder.parents) if f.name == "data")
        self._folders = [folder, *(f for f in beside if f.is_dir())]
        self._open.append(Path(self.path).resolve())

    def read(self, text: str, path: str | None = None) -> Iterator[Statement]:
        """Go through the statements of a text, and of what it includes at the place where it does.

        Raises:
            FileFormatError: If there is more to read than any file of this format can mean.
        """
        path = path or self.path
        self._count("characters", MAX_BYTES, len(text))
        if "\r" in text:
            text = text.replace("\r\n", "\n").replace("\r", "\n")
        starts = chain(_KEYWORD.finditer(text), (None,))
        found, line, counted = next(starts), 1, 0
        while found is not None:
            self._count("statements", MOST_STATEMENTS)
            line += text.count("\n", counted, found.start())
            counted, following = found.start(), next(starts)
            end = len(text) if following is None else following.start()
            statement = Statement(found[1], text[found.end() : end], path, line)
            if found[1] == "INCLUDE":
                yield from self._read_included(statement)
            else:
                yield statement
            found = following

    def _count(self, what: str, most: int, number: int = 1) -> None:
        self._counts[what] += number
        if self._counts[what] > most:
            raise FileFormatError(self.path, f"at most {most} {what}, with those of included files", "more")

    def _read_included(self, statement: Statement) -> Iterator[Statement]:
        """Go through the statements of an included file, or note why it is passed over."""
        self._count(".INCLUDE statements", MOST_INCLUDES)
        name = statement.body.strip().partition("\n")[0].strip(' "').replace("\\", "/")
        target = self._find(name, Path(statement.path))
        if isinstance(target, Finding):
            self.findings.append(target._replace(where=statement.where))
            return
        if len(self._open) > DEEPEST_INCLUDE:
            raise FileFormatError(statement.where, f"files that include each other {DEEPEST_INCLUDE} deep", "deeper")
        document = read_any_text(target)
        self.findings += document.findings
        self.included.append(target)
        self._open.append(target)
        yield from self.read(document.text, os.fspath(target))
        self._open.pop()

    def _find(self, name: str, including: Path) -> Path | Finding:
        """Return the file that is meant, or what keeps it from being read."""
        outside = Finding(self.path, ".INCLUDE of a file outside the folder, which is not read")
        if not name or not name.isprintable() or ".." in name.split("/") or PureWindowsPath(name).anchor:
            return outside
        try:
            targets = [(folder / name).resolve() for folder in (including.resolve().parent, *self._folders)]
            inside = [t for t in targets if any(t.is_relative_to(folder) for folder in self._folders)]
            found = next((target for target in inside if target.is_file()), None)
        except OSError:  # a name that no file can have
            return outside
        if found is None:
            return Finding(self.path, ".INCLUDE of a file that is not there", 1, "assumed") if inside else outside
        loop = Finding(self.path, ".INCLUDE of a file by itself, which is passed over")
        return loop if found in self._open else found
