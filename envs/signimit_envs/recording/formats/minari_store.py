"""Minari's folders of data sets: written whole or not at all, read without running the code that they name."""

from __future__ import annotations

import errno
import importlib
import json
import os
import shutil
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import mujoco

from signimit.exceptions import FileFormatError, InvalidInputError, MissingDependencyError
from signimit.io.archive import MAX_BYTES, MAX_RATIO
from signimit.io.safe_files import check_vacant, whole_folder

if TYPE_CHECKING:
    from minari import MinariDataset
    from minari.data_collector import EpisodeBuffer

MARKER = "data/metadata.json"
_OUR_KEY = "signimit"  # of the header in the metadata
_ROOT = "MINARI_DATASETS_PATH"  # environment variable with the folder of all data sets
_OVERHEAD = 2**17  # bytes of HDF5's own in an episode, at most
_REQUIREMENTS = ["signimit", f"mujoco=={mujoco.__version__}"]


def import_minari() -> Any:
    """Import Minari.

    Raises:
        MissingDependencyError: If it is not installed.
    """
    try:
        importlib.import_module("h5py")  # Minari's storage, which it does not require itself
        import minari
    except ImportError:
        raise MissingDependencyError("minari", "minari", "A Minari data set") from None
    return minari


def create_dataset(
    dataset_id: str, buffers: Sequence[EpisodeBuffer], header: dict[str, Any], overwrite: bool, **arguments: Any
) -> Path:
    """Create a data set in Minari's folder, whole or not at all.

    Args:
        dataset_id: Name of the data set, ``namespace/name-v0``.
        buffers: The episodes.
        header: Signimit's own metadata in JSON types, read back by `open_dataset`.
        overwrite: Replace a data set of that name.
        **arguments: Further arguments of `minari.create_dataset_from_buffers`.

    Returns:
        The folder of the data set.

    Raises:
        InvalidInputError: If the name is not Minari's kind of name, or is taken.
        MissingDependencyError: If Minari is not installed.
    """
    minari = import_minari()
    try:
        namespace = minari.dataset.minari_dataset.parse_dataset_id(dataset_id)[0]
    except (ValueError, TypeError):
        raise InvalidInputError("Minari data set", "a name like signimit/obey-v0", repr(dataset_id)) from None
    place = dataset_folder(dataset_id)
    check_vacant(place, MARKER, overwrite)
    if namespace is not None and namespace not in minari.namespace.list_local_namespaces():
        minari.namespace.create_namespace(namespace)
    with whole_folder(place, MARKER, overwrite) as draft, _disk_errors(draft, buffers):
        with _datasets_in(draft / "root"), warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # that there is no author, no permalink and so on
            dataset = minari.create_dataset_from_buffers(
                dataset_id, list(buffers), requirements=_REQUIREMENTS, jpeg_encoding=False, **arguments
            )
            dataset.storage.update_metadata({_OUR_KEY: header})
            os.rename(dataset_folder(dataset_id) / "data", draft / "data")
        shutil.rmtree(draft / "root")
    return place


def open_dataset(place: str | os.PathLike[str], kind: str, version: int) -> tuple[MinariDataset, dict[str, Any]]:
    """Open a data set that signimit wrote.

    Args:
        place: Folder of the data set.
        kind: Kind of data that it must hold.
        version: Newest version of that kind that the caller reads.

    Returns:
        The data set, and the header of `create_dataset`.

    Raises:
        FileFormatError: If it is half written, of another version of Minari, or not signimit's.
        MissingDependencyError: If Minari is not installed.
    """
    minari = import_minari()
    try:
        metadata = json.loads((Path(place) / MARKER).read_bytes())
        header = metadata[_OUR_KEY]
        found, number = header["kind"], int(header["version"])
        # Without these Minari would make the environment that the file names, and so run foreign code.
        _ = metadata["observation_space"], metadata["action_space"]
    except (OSError, ValueError, KeyError, TypeError, OverflowError, RecursionError) as error:
        expected = f"a whole Minari data set with a {kind} of signimit"
        raise FileFormatError(os.fspath(place), expected, _reason(error)) from None
    if found != kind or number > version:
        expected = f"a Minari data set with a {kind} of signimit, version <= {version}"
        raise FileFormatError(os.fspath(place), expected, f"{found} version {number}")
    with minari_errors(place):
        _refuse_bombs(Path(place) / "data" / "main_data.hdf5", int(metadata["total_episodes"]))
        return minari.MinariDataset(Path(place) / "data"), header


def _refuse_bombs(path: Path, episodes: int) -> None:
    """Refuse a file that promises more episodes or numbers than its bytes can tell."""
    h5py = importlib.import_module("h5py")
    sizes: list[int] = []
    with h5py.File(path, "r") as file:
        if not 0 <= episodes <= len(file):
            raise FileFormatError(str(path), f"{episodes} episodes, as its metadata says", f"{len(file)}")
        file.visititems(lambda name, item: sizes.append(item.nbytes if isinstance(item, h5py.Dataset) else 0))
    most = min(MAX_BYTES, MAX_RATIO * path.stat().st_size)
    if sum(sizes) > most:
        raise FileFormatError(str(path), f"at most {most} bytes unpacked", f"{sum(sizes)}")


@contextmanager
def _disk_errors(draft: Path, buffers: Sequence[EpisodeBuffer]) -> Iterator[None]:
    """Raise an `OSError` where the disk is full: HDF5 says so in ways of its own, so that is looked at beforehand."""
    needed = _OVERHEAD * (1 + len(buffers)) + sum(_bytes_of(vars(buffer)) for buffer in buffers)
    if shutil.disk_usage(draft).free < needed:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(draft))
    try:
        yield
    except RuntimeError as error:
        raise OSError(errno.EIO, os.strerror(errno.EIO), str(draft)) from error


def _bytes_of(value: Any) -> int:
    """Return the size of the arrays in a nested dict."""
    return sum(map(_bytes_of, value.values())) if isinstance(value, dict) else getattr(value, "nbytes", 0)


@contextmanager
def minari_errors(place: str | os.PathLike[str]) -> Iterator[None]:
    """Raise a `FileFormatError` for any error of Minari or HDF5 in a broken data set."""
    try:
        yield
    except InvalidInputError as error:
        raise FileFormatError(f"{place}: {error.where}", error.expected, error.found) from None
    except Exception as error:  # Minari and HDF5 fail on damaged files in many ways
        raise FileFormatError(os.fspath(place), "a whole Minari data set", _reason(error)) from None


def dataset_folder(dataset_id: str) -> Path:
    """Return the folder of a data set in Minari's folder, existing or not.

    Raises:
        MissingDependencyError: If Minari is not installed.
    """
    import_minari()
    from minari.storage.datasets_root_dir import get_dataset_path

    return Path(get_dataset_path(dataset_id))


def _reason(error: Exception) -> str:
    """Return type and message of an error in one short line."""
    return f"{type(error).__name__}: {' '.join(str(error).split())[:120]}"


@contextmanager
def _datasets_in(root: Path) -> Iterator[None]:
    """Context in which Minari's folder is another one; only the environment variable can say so."""
    before = os.environ.get(_ROOT)
    os.environ[_ROOT] = str(root)
    try:
        yield
    finally:
        if before is None:
            del os.environ[_ROOT]
        else:
            os.environ[_ROOT] = before
