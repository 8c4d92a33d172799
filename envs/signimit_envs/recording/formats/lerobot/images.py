"""Images as LeRobot keeps them in tables: PNG, which loses nothing."""

from __future__ import annotations

import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image

IMAGE = "image"
"""LeRobot's name of the type."""


def png_from_image(image: NDArray[np.uint8]) -> bytes:
    """Compress an image, shape (height, width, 3)."""
    buffer = io.BytesIO()
    Image.fromarray(image).save(buffer, "PNG", compress_level=1)
    return buffer.getvalue()


def image_from_png(data: bytes) -> NDArray[np.uint8]:
    """Undo `png_from_image`.

    Raises:
        OSError: If it is no whole PNG.
    """
    with Image.open(io.BytesIO(data), formats=["PNG"]) as image:
        return np.array(image, dtype=np.uint8)
