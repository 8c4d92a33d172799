"""Reading and writing demonstrations and recordings by the name of a file format."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from signimit import demonstrations as demonstration_files
from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import FileFormatError, InvalidInputError, UnknownNameError
from signimit.io.formats.csv_demonstrations import HANDS, read_csv_demonstrations, write_csv_demonstrations
from signimit_envs.recording.episodes import Recording
from signimit_envs.recording.formats.csv_recordings import STEPS, read_csv_recording, write_csv_recording
from signimit_envs.recording.formats.lerobot.demonstrations import (
    read_lerobot_demonstrations,
    write_lerobot_demonstrations,
)
from signimit_envs.recording.formats.lerobot.layout import INFO
from signimit_envs.recording.formats.lerobot.recordings import read_lerobot_recording, write_lerobot_recording
from signimit_envs.recording.formats.minari_demonstrations import (
    read_minari_demonstrations,
    write_minari_demonstrations,
)
from signimit_envs.recording.formats.minari_recordings import read_minari_recording, write_minari_recording
from signimit_envs.recording.formats.minari_store import MARKER, dataset_folder
from signimit_envs.recording.storage import load_recording, save_recording

Data = Recording | DemonstrationSet
MINARI_PREFIX = "minari:"
"""Prefix of the name of a data set in Minari's folder, e.g. ``minari:signimit/obey-v0``."""


class Format(NamedTuple):
    """A file format.

    Attributes:
        read_recording: Reads a recording from a file or folder.
        read_demonstrations: Reads demonstrations from a file or folder.
        write_recording: Writes a recording; the last argument says whether to replace one.
        write_demonstrations: Writes demonstrations; the last argument says whether to replace some.
        markers: Files of which a folder of this format has one.
    """

    read_recording: Callable[[str], Recording]
    read_demonstrations: Callable[[str], DemonstrationSet]
    write_recording: Callable[[str, Recording, bool], object]
    write_demonstrations: Callable[[str, DemonstrationSet, bool], object]
    markers: tuple[str, ...] = ()


def _save_recording(path: str, recording: Recording, overwrite: bool) -> None:
    check_vacant_file(path, overwrite)
    save_recording(path, recording)


def _save_demonstrations(path: str, demonstrations: DemonstrationSet, overwrite: bool) -> None:
    check_vacant_file(path, overwrite)
    demonstrations.save(path)


FORMATS = {
    "npz": Format(load_recording, DemonstrationSet.load, _save_recording, _save_demonstrations),
    "csv": Format(
        read_csv_recording,
        read_csv_demonstrations,
        write_csv_recording,
        write_csv_demonstrations,
        (STEPS, HANDS),
    ),
    "minari": Format(
        read_minari_recording,
        read_minari_demonstrations,
        write_minari_recording,
        write_minari_demonstrations,
        (MARKER,),
    ),
    "lerobot": Format(
        read_lerobot_recording,
        read_lerobot_demonstrations,
        write_lerobot_recording,
        write_lerobot_demonstrations,
        (INFO,),
    ),
}


def check_vacant_file(path: str | os.PathLike[str], overwrite: bool) -> None:
    """Check that a path is vacant, or a file that may be replaced.

    Raises:
        InvalidInputError: If it is taken.
    """
    place = Path(path)
    if os.path.lexists(place) and not (overwrite and place.is_file()):
        raise InvalidInputError(str(place), "nothing of that name yet (overwrite replaces a file)", "something")


def read_data(place: str | os.PathLike[str]) -> Data:
    """Read demonstrations or a recording in any of `FORMATS`.

    Args:
        place: A ``.npz`` file, a folder, or ``minari:`` and the name of a data set.

    Raises:
        FileNotFoundError: If there is no such file, folder or data set.
        FileFormatError: If it is none of signimit's formats, or half written.
        MissingDependencyError: If the format needs a package that is not installed.
    """
    name = detect_format(place)
    where = os.fspath(place)
    if where.startswith(MINARI_PREFIX):
        folder = dataset_folder(where.removeprefix(MINARI_PREFIX))
        folder.stat()
        where = os.fspath(folder)
    if name == "csv":
        found = (Path(where) / HANDS).is_file()
        return read_csv_demonstrations(where) if found else read_csv_recording(where)
    try:
        return FORMATS[name].read_recording(where)
    except FileFormatError as error:
        if not error.found.startswith(f"{demonstration_files.KIND} version"):
            raise
        return FORMATS[name].read_demonstrations(where)


def read_recording(place: str | os.PathLike[str]) -> Recording:
    """Read a recording in any format; see `read_data`.

    Raises:
        FileFormatError: Also if it holds demonstrations, which have no physics to replay.
    """
    data = read_data(place)
    if isinstance(data, DemonstrationSet):
        raise FileFormatError(os.fspath(place), "recorded episodes", "demonstrations, which hold no physics")
    return data


def write_data(place: str | os.PathLike[str], data: Data, name: str, overwrite: bool = False) -> None:
    """Write demonstrations or a recording, whole or not at all.

    Args:
        place: A file for ``npz``, a folder for ``csv`` and ``lerobot``, the name of a data set for ``minari``, with or
            without ``minari:``.
        data: Demonstrations or a recording.
        name: One of `FORMATS`.
        overwrite: Replace an existing data set of the same format.

    Raises:
        UnknownNameError: If there is no such format.
        InvalidInputError: If the name is taken, or the format cannot hold the data.
        MissingDependencyError: If the format needs a package that is not installed.
    """
    if name not in FORMATS:
        raise UnknownNameError("format", name, FORMATS)
    where = os.fspath(place).removeprefix(MINARI_PREFIX) if name == "minari" else os.fspath(place)
    if isinstance(data, Recording):
        FORMATS[name].write_recording(where, data, overwrite)
    else:
        FORMATS[name].write_demonstrations(where, data, overwrite)


def detect_format(place: str | os.PathLike[str]) -> str:
    """Return the name in `FORMATS` of the format of a file, folder or data set.

    Raises:
        FileNotFoundError: If there is no such file or folder.
        FileFormatError: If it is a folder of another format.
    """
    if os.fspath(place).startswith(MINARI_PREFIX):
        return "minari"
    where = Path(place)
    where.stat()
    if not where.is_dir():
        return "npz"
    for name, known in FORMATS.items():
        if any((where / marker).is_file() for marker in known.markers):
            return name
    markers = ", ".join(marker for known in FORMATS.values() for marker in known.markers)
    raise FileFormatError(str(where), f"a whole data set, with one of {markers}", "none of these")
