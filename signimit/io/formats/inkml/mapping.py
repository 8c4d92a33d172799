"""Mappings of channels onto the canvas (InkML 1.1, section 6): identity, affine, and products of these."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from signimit.exceptions import FileFormatError
from signimit.io.formats.inkml.document import InkDocument
from signimit.io.formats.xmlfile import local_name
from signimit.validation import LARGEST

Values = Mapping[str, NDArray[np.float64]]
_USED = {"X", "Y", "T"}
_MOST_MAPPINGS = 100


class AffineMapping(NamedTuple):
    """Target channels as sums of source channels: ``target = matrix @ source + offset``.

    Attributes:
        sources: Names of the n channels that are mapped.
        targets: Names of the m channels that come out.
        matrix: Shape (m, n).
        offset: Shape (m,).
    """

    sources: tuple[str, ...]
    targets: tuple[str, ...]
    matrix: NDArray[np.float64]
    offset: NDArray[np.float64]


def map_channels(mappings: Sequence[AffineMapping], values: Values) -> dict[str, NDArray[np.float64]]:
    """Return the channels on the canvas, each of shape (T,); those that nothing maps stay as they are.

    Raises:
        FileFormatError: If a mapping needs a channel that is not there.
    """
    mapped = dict(values)
    for mapping in mappings:
        missing = [name for name in mapping.sources if name not in values]
        if missing:
            raise FileFormatError("canvasTransform", f"channels {', '.join(values)}", ", ".join(missing))
        columns = np.stack([values[name] for name in mapping.sources])
        rows = mapping.matrix @ columns + mapping.offset[:, None]
        mapped |= dict(zip(mapping.targets, rows, strict=True))
    return mapped


def read_mappings(element: Element, document: InkDocument) -> list[AffineMapping]:
    """Read a ``<mapping>``; what it leaves as it is, and what it does to channels other than X, Y and T, is left out.

    Raises:
        FileFormatError: If X, Y or T are mapped by a table or by MathML, or a matrix does not fit its channels.
    """
    found, waiting = list[AffineMapping](), [element]
    for _ in range(_MOST_MAPPINGS):
        if not waiting:
            return found
        mapping = waiting.pop(0)
        if reference := mapping.get("mappingRef"):
            mapping = document.find(reference, ("mapping",), "canvasTransform")
        kinds = {local_name(child): child for child in mapping}
        matrix = kinds.get("affine", kinds.get("matrix"))
        kind = mapping.get("type", "product" if "mapping" in kinds else "affine" if matrix is not None else "unknown")
        binds = [child for child in mapping if local_name(child) == "bind"]
        targets = tuple(name for bind in binds if (name := bind.get("target")))
        if kind == "product":
            waiting += [child for child in mapping if local_name(child) == "mapping"]
        elif kind == "affine" and matrix is not None:
            sources = tuple(name for bind in binds if (name := bind.get("source")))
            found.append(_read_affine(matrix, sources, targets))
        elif kind not in ("identity", "unknown") and (not targets or _USED & set(targets)):
            expected = "a mapping of X, Y and T of type identity, affine or product"
            raise FileFormatError("canvasTransform", expected, repr(kind))
    raise FileFormatError("canvasTransform", f"at most {_MOST_MAPPINGS} mappings", "more")


def _read_affine(element: Element, sources: tuple[str, ...], targets: tuple[str, ...]) -> AffineMapping:
    """Read a matrix: a row a target, a column a source, and perhaps one more of offsets."""
    text = (element.text or "").strip().rstrip(",")
    try:
        matrix = np.array([[float(word) for word in row.split()] for row in text.split(",")], dtype=np.float64)
        rows, columns = matrix.shape
        targets = targets or ("X", "Y", "Z")[:rows]
        sources = sources or (targets if columns in (rows, rows + 1) else ())
        if (
            len(targets) != rows
            or not sources
            or columns - len(sources) not in (0, 1)
            or not (np.abs(matrix) <= LARGEST).all()
        ):
            raise ValueError
    except ValueError:
        expected = f"a matrix with a row for each target and a column for each source of {', '.join(sources) or 'X, Y'}"
        raise FileFormatError("canvasTransform: affine", expected, repr(text[:60])) from None
    offset = matrix[:, -1] if columns > len(sources) else np.zeros(rows)
    return AffineMapping(sources, targets, matrix[:, : len(sources)], offset)
