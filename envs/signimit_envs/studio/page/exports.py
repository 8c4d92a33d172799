"""Export and import of a session: its model, demonstration sets, stroke libraries, InkML and CSV.

A stroke file holds each demonstration as W signs, then the objects' places as a "stroke" with the label `PLACES`, then
the hand's path. So the strokes are found under their labels, and nothing is lost.
"""

from __future__ import annotations

import csv
import io
import itertools
import tempfile
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.formats.inkml import read_inkml, write_inkml
from signimit.io.formats.pen_recording import SAMPLE_TIME
from signimit.io.safe_files import replaced_file
from signimit.learning import ImitationModel
from signimit.strokes import Stroke, StrokeLibrary
from signimit.teaching.languages import Language
from signimit_envs.arm.scene import OBJECT_COUNTS
from signimit_envs.studio.limits import LIMITS
from signimit_envs.studio.page.prompts import sign_labels
from signimit_envs.studio.store.events import DrawnDemonstration

WORDS = 2
PLACES = "objects"
_MOST_STROKES = LIMITS.demonstrations * (WORDS + 2)
_MOST_TAGS = 50 * _MOST_STROKES  # a trace has about ten
_COLUMNS = ("stroke", "label", "writer", "x", "y", "t")
Demonstrations = Sequence[DrawnDemonstration]


class Lesson(NamedTuple):
    """What a session has to export.

    Attributes:
        shown: The demonstrations.
        language: Language of their prompts; none for made-up signs.
        model: What was learned from them; none if nothing could be.
    """

    shown: Demonstrations
    language: Language | None
    model: ImitationModel | None


class ExportFormat(NamedTuple):
    """A file format of a session.

    Attributes:
        media_type: What a browser is told.
        write: Writes a lesson to a path.
        read: Reads the demonstrations from a path.
    """

    media_type: str
    write: Callable[[Lesson, Path], None]
    read: Callable[[Path], list[DrawnDemonstration]]


def export_bytes(name: str, lesson: Lesson) -> bytes:
    """Return a lesson as the bytes of a file.

    Raises:
        InvalidInputError: If there are no demonstrations, or the model is wanted and there is none.
    """
    if not lesson.shown:
        raise InvalidInputError("session", "at least one demonstration", "none")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        FORMATS[name].write(lesson, path)
        return path.read_bytes()


def import_bytes(name: str, content: bytes) -> tuple[DrawnDemonstration, ...]:
    """Return the demonstrations in the bytes of a file.

    Raises:
        FileFormatError: If it is no such file.
        InvalidInputError: If there is more in it than the studio takes.
    """
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        path.write_bytes(content)
        _refuse_bombs(path)
        try:
            shown = FORMATS[name].read(path)
        except FileFormatError as error:  # the page knows the file by another name than the server
            raise FileFormatError(error.where.replace(str(path), "the file"), error.expected, error.found) from None
    _check_sizes(shown)
    _ = DemonstrationSet(one.demonstration for one in shown)  # all have as many objects as the first, or it says so
    return tuple(shown)


def to_library(shown: Demonstrations, language: Language | None) -> StrokeLibrary:
    """Put demonstrations into a stroke library, objects and all."""
    strokes, labels = [], []
    for one in shown:
        places = Stroke(one.objects, np.arange(len(one.objects), dtype=np.float64))
        strokes += [*one.signs, places, one.hand]
        if language is None or one.prompt is None:
            labels += [*(f"sign {word + 1}" for word in range(WORDS)), PLACES, "movement"]
        else:
            labels += [*sign_labels(language, one.prompt), PLACES, language.movements[one.prompt.movement]]
    writers = [one.by for one in shown for _ in range(WORDS + 2)]
    return StrokeLibrary(tuple(strokes), tuple(labels), tuple(writers), "signimit studio")


def from_library(library: StrokeLibrary) -> list[DrawnDemonstration]:
    """Take demonstrations out of a stroke library that `to_library` made.

    Raises:
        FileFormatError: If it was made otherwise.
    """
    size = WORDS + 2
    count, rest = divmod(len(library), size)
    if not count or rest or any(label != PLACES for label in library.labels[WORDS::size]):
        expected = f"{WORDS} signs, the objects' places as a stroke {PLACES!r}, and a hand, again and again"
        raise FileFormatError("strokes", expected, f"{len(library)} strokes in another order")
    found = []
    for first in range(0, len(library), size):
        *signs, places, hand = library.strokes[first : first + size]
        found.append(DrawnDemonstration(tuple(signs), places.points, hand, None, library.writers[first]))
    return found


def _write_model(lesson: Lesson, path: Path) -> None:
    if lesson.model is None:
        raise InvalidInputError("session", "demonstrations that can be learned from", "others")
    lesson.model.save(path)


def _drawn(demonstrations: DemonstrationSet) -> list[DrawnDemonstration]:
    """Take demonstrations of a set; signs have no times in it, and are taken to be sampled every 10 ms."""
    return [
        DrawnDemonstration(
            tuple(Stroke(sign, SAMPLE_TIME * np.arange(len(sign), dtype=np.float64)) for sign in one.signs),
            one.objects,
            Stroke(one.hand, one.times - one.times[0]),
            None,
            "imported",
        )
        for one in demonstrations
    ]


def _write_csv(lesson: Lesson, path: Path) -> None:
    text = io.StringIO()
    writer = csv.writer(text)
    writer.writerow(_COLUMNS)
    library = to_library(lesson.shown, lesson.language)
    for number, (stroke, label, by) in enumerate(zip(library, library.labels, library.writers, strict=True)):
        points, times = stroke.points.tolist(), stroke.times.tolist()
        writer.writerows(
            (number, label, by, repr(x), repr(y), repr(t)) for (x, y), t in zip(points, times, strict=True)
        )
    with replaced_file(path) as file:
        file.write(text.getvalue().encode())


def _read_csv(path: Path) -> list[DrawnDemonstration]:
    try:
        rows = csv.reader(io.StringIO(path.read_bytes().decode("utf-8-sig")), strict=True)
        header = tuple(next(rows, ()))
        if header != _COLUMNS:
            raise FileFormatError(f"{path}: line 1", ",".join(_COLUMNS), ",".join(header)[:60])
        return from_library(_library_from_rows(rows, str(path)))
    except (UnicodeDecodeError, csv.Error) as error:
        raise FileFormatError(str(path), "comma-separated text", str(error)[:60]) from None


def _library_from_rows(rows: Iterator[list[str]], where: str) -> StrokeLibrary:
    strokes, labels, writers = list[Stroke](), list[str](), list[str]()
    for number, group in itertools.groupby((row for row in rows if row), key=lambda row: row[0]):
        table = list(itertools.islice(group, LIMITS.points + 1))
        if len(table) > LIMITS.points:
            raise InvalidInputError(f"stroke {number[:20]}", f"at most {LIMITS.points} points", "more")
        if len(strokes) >= _MOST_STROKES:
            raise InvalidInputError("the file", f"at most {_MOST_STROKES} strokes", "more")
        try:
            numbers = np.array([[float(value) for value in row[3:]] for row in table])
            strokes.append(Stroke(numbers[:, :2], numbers[:, 2]))
            labels.append(table[0][1])
            writers.append(table[0][2])
        except (ValueError, IndexError) as error:
            expected = "points that move, times that increase, six columns"
            raise FileFormatError(f"{where}: stroke {number[:20]}", expected, str(error)[:80]) from None
    return StrokeLibrary(tuple(strokes), tuple(labels), tuple(writers))


def _refuse_bombs(path: Path) -> None:
    """Refuse a file that takes far more memory to read than a session."""
    if path.suffix in (".inkml", ".csv"):
        content = path.read_bytes()
        if len(content) > LIMITS.text:
            raise InvalidInputError(
                "the file", f"at most {LIMITS.text} bytes; an archive may be larger", f"{len(content)}"
            )
        if path.suffix == ".inkml" and content.count(b"<") > _MOST_TAGS:
            raise InvalidInputError("the file", f"at most {_MOST_TAGS} tags", "more")
    if path.suffix != ".npz" or not zipfile.is_zipfile(path):
        return
    try:
        with zipfile.ZipFile(path) as archive:
            size = sum(info.file_size for info in archive.infolist())
    except (zipfile.BadZipFile, ValueError, NotImplementedError, OSError):  # of names and versions, too
        raise FileFormatError(str(path), "a whole archive", "a broken one") from None
    if size > LIMITS.unpacked:
        raise InvalidInputError("the file", f"at most {LIMITS.unpacked} bytes unpacked", f"{size}")


def _check_sizes(shown: Demonstrations) -> None:
    """Refuse demonstrations that the page could not have sent.

    Raises:
        InvalidInputError: Names the demonstration and the limit.
    """
    if len(shown) > LIMITS.demonstrations:
        raise InvalidInputError("the file", f"at most {LIMITS.demonstrations} demonstrations", f"{len(shown)}")
    for number, one in enumerate(shown, 1):
        where = f"demonstration {number}"
        if len(one.objects) not in OBJECT_COUNTS or len(one.signs) != WORDS:
            expected = f"{WORDS} signs and {OBJECT_COUNTS[0]} to {OBJECT_COUNTS[-1]} objects"
            raise InvalidInputError(where, expected, f"{len(one.signs)} and {len(one.objects)}")
        strokes = (*one.signs, one.hand)
        if max(len(stroke) for stroke in strokes) > LIMITS.points:
            raise InvalidInputError(where, f"at most {LIMITS.points} points in a stroke", "more")
        if max(np.abs(stroke.points).max() for stroke in strokes) > LIMITS.coordinate:
            raise InvalidInputError(where, f"coordinates up to {LIMITS.coordinate:g}", "larger ones")
        if max(np.abs(one.objects).max(), np.abs(one.hand.points).max()) > LIMITS.reach:
            raise InvalidInputError(where, f"objects and hand within {LIMITS.reach} m of the table's middle", "others")


FORMATS: Mapping[str, ExportFormat] = MappingProxyType(
    {
        "model.npz": ExportFormat(
            "application/octet-stream", _write_model, lambda path: _drawn(ImitationModel.load(path).demonstrations)
        ),
        "demonstrations.npz": ExportFormat(
            "application/octet-stream",
            lambda lesson, path: DemonstrationSet(one.demonstration for one in lesson.shown).save(path),
            lambda path: _drawn(DemonstrationSet.load(path)),
        ),
        "strokes.npz": ExportFormat(
            "application/octet-stream",
            lambda lesson, path: to_library(lesson.shown, lesson.language).save(path),
            lambda path: from_library(StrokeLibrary.load(path)),
        ),
        "strokes.inkml": ExportFormat(
            "application/inkml+xml",
            lambda lesson, path: write_inkml(path, to_library(lesson.shown, lesson.language)),
            lambda path: from_library(read_inkml(path, strict=True)),
        ),
        "strokes.csv": ExportFormat("text/csv", _write_csv, _read_csv),
    }
)
"""Formats of export and import, by the name of the file."""
