"""Reports of imports of strokes: which file was read, what was repaired in it, and which drawings were left out."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, NamedTuple

from signimit.exceptions import FileFormatError

READ, REPAIRED, LEFT_OUT, NOT_A_DRAWING = "read", "repaired", "left out", "not a drawing"


class StrokeImportWarning(UserWarning):
    """Drawings were repaired, or left out, where a reader of strokes returns no report."""


class Finding(NamedTuple):
    """Something in a drawing that was read otherwise than it stands there.

    Attributes:
        where: File and drawing.
        what: What was found and done, one phrase for all of its kind.
        number: How many of them there are, e.g. points.
        kind: ``"repaired"``, or ``"assumed"`` if the file merely does not say it.
    """

    where: str
    what: str
    number: int = 1
    kind: Literal["repaired", "assumed"] = "repaired"


class FileReport(NamedTuple):
    """What became of one file.

    Attributes:
        path: The file.
        format: Format it was read as; none if it is no drawing.
        drawings: How many drawings were read, the repaired ones among them.
        findings: What was repaired or assumed.
        left_out: For each drawing that could not be read, the error that says why; or one for the whole file.
        includes: Other files that were read for this one.
        passed_over: Why the file was not read at all; empty if it was.
    """

    path: Path
    format: str | None
    drawings: int = 0
    findings: Sequence[Finding] = ()
    left_out: Sequence[FileFormatError] = ()
    includes: Sequence[Path] = ()
    passed_over: str = ""

    @property
    def repaired(self) -> int:
        """How many drawings, of those that were read, were repaired."""
        places = {finding.where for finding in self.findings if finding.kind == "repaired"}
        return min(len(places), self.drawings)

    @property
    def status(self) -> str:
        """One of read, repaired, left out (wholly or in part), or why it was passed over."""
        return self.passed_over or (LEFT_OUT if self.left_out else REPAIRED if self.repaired else READ)


@dataclass(frozen=True)
class ImportReport:
    """What became of each file of an import.

    Attributes:
        files: One report for each file, in the order in which they were met.
    """

    files: tuple[FileReport, ...]

    @property
    def left_out(self) -> tuple[FileFormatError, ...]:
        """Why drawings, or whole files, were left out, an error for each."""
        return tuple(error for file in self.files for error in file.left_out)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What was repaired or assumed in all files."""
        return tuple(finding for file in self.files for finding in file.findings)

    @property
    def flawless(self) -> bool:
        """Whether nothing was repaired or left out."""
        return not any(file.repaired or file.left_out for file in self.files)

    def summary(self) -> str:
        """Say how many drawings were read, repaired and left out, and name the first that was left out, or repaired."""
        drawings, repaired = (sum(getattr(f, name) for f in self.files) for name in ("drawings", "repaired"))
        sentence = f"drawings: {drawings} read, {repaired} of them repaired, {len(self.left_out)} left out"
        if self.left_out:
            return f"{sentence}; the first: {self.left_out[0]}"
        first = next((f"; the first: {f.where}: {f.what}" for f in self.findings if f.kind == "repaired"), "")
        return f"{sentence}{first}."

    def table(self) -> str:
        """Return how many files and drawings were read, repaired, left out or passed over, and below it why."""
        files, drawings = Counter(file.status for file in self.files), Counter[str]()
        for file in self.files:
            drawings[READ] += file.drawings - file.repaired
            drawings[REPAIRED] += file.repaired
            drawings[LEFT_OUT] += len(file.left_out)
        rows = list(dict.fromkeys((READ, REPAIRED, LEFT_OUT, *sorted(files))))
        width = max(map(len, rows))
        lines = [f"{'':{width}}  files  drawings"]
        lines += [f"{row:{width}}  {files[row]:5}  {drawings[row]:8}" for row in rows]
        counts, places = Counter[tuple[str, str]](), defaultdict[tuple[str, str], set[str]](set)
        for finding in self.findings:
            counts[finding.kind, finding.what] += finding.number
            places[finding.kind, finding.what].add(finding.where)
        for (kind, what), number in counts.most_common():
            lines.append(f"{kind}: {what} ({number} in {len(places[kind, what])} places)")
        return "\n".join([*lines, *(f"left out: {error}" for error in self.left_out)])
