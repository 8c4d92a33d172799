"""Cards with the signs of an utterance, for observations that are pictures; ink shows the direction of drawing."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

PAPER, FIRST_INK, LAST_INK = (250, 249, 246), (20, 20, 20), (230, 120, 0)
_OVERSAMPLING = 4  # drawn four times as large, then reduced, to smooth the lines
_MARGIN, _PEN = 0.14, 0.09  # shares of a card's side


def draw_sign_cards(signs: Sequence[NDArray[np.float64]], size: tuple[int, int]) -> NDArray[np.uint8]:
    """Draw signs side by side in the order they were made, each from black at its beginning to orange at its end.

    Args:
        signs: Normalised signs, each (T, 2) within [-1, 1], y up.
        size: Width and height, pixels.

    Returns:
        Shape (height, width, 3).
    """
    width, height = (side * _OVERSAMPLING for side in size)
    image = Image.new("RGB", (width, height), PAPER)
    draw = ImageDraw.Draw(image)
    share = width / len(signs)
    side = min(share, height)
    for word, sign in enumerate(signs):
        places = np.array([(word + 0.5) * share, height / 2]) + sign * [1, -1] * (0.5 - _MARGIN) * side
        pen = max(1, round(_PEN * side))
        inks = np.linspace(FIRST_INK, LAST_INK, len(places) - 1).round().astype(int).tolist()
        for (red, green, blue), start, (x, y) in zip(inks, places[:-1].tolist(), places[1:].tolist(), strict=True):
            draw.line([tuple(start), (x, y)], (red, green, blue), pen)
            draw.ellipse((x - pen / 2, y - pen / 2, x + pen / 2, y + pen / 2), (red, green, blue))
        if word:
            draw.line([(word * share, 0.15 * height), (word * share, 0.85 * height)], (200, 198, 192), _OVERSAMPLING)
    return np.array(image.reduce(_OVERSAMPLING))
