"""Two-dimensional parts of a film's frames: captions, cards, labels, and signs as they are drawn."""

from __future__ import annotations

import functools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from signimit import paths

PAPER, INK, FAINT, MARK = (250, 249, 246), (27, 27, 27), (200, 198, 192), (230, 159, 0)  # red, green, blue
Signs = Sequence[NDArray[np.float64]]


def draw_signs(size: tuple[int, int], signs: Signs, complete: Signs) -> NDArray[np.uint8]:
    """Draw signs one below the other.

    Args:
        size: Width and height, pixels.
        signs: The signs as far as they are drawn, each (T, 2), y up, any unit.
        complete: The complete signs; each is scaled to fill its part of the picture.

    Returns:
        Shape (height, width, 3).
    """
    width, height = size
    image = Image.new("RGB", size, PAPER)
    draw = ImageDraw.Draw(image)
    share = height // max(1, len(complete))
    for word, whole in enumerate(complete):
        top = word * share
        draw.rectangle((12, top + 12, width - 12, top + share - 12), outline=FAINT, width=2)
        draw.text((22, top + 18), f"sign {word + 1}", INK, font(18))
        if word < len(signs):
            draw_sign(draw, (width / 2, top + share / 2 + 8), min(width, share) * 0.30, signs[word], whole)
    return np.asarray(image)


def draw_sign(
    draw: ImageDraw.ImageDraw,
    centre: tuple[float, float],
    half_size: float,
    sign: NDArray[np.float64],
    whole: NDArray[np.float64],
) -> None:
    """Draw part of a sign, scaled so that the whole sign fills a square about ``centre``, pixels."""
    scale = half_size / max(paths.half_size(whole), 1e-12)
    places = (sign - paths.box_centre(whole)) * (scale, -scale) + centre
    pen = max(2, round(half_size / 14))
    flat = [(float(x), float(y)) for x, y in places]
    if len(flat) > 1:
        draw.line(flat, INK, pen, joint="curve")
    for x, y in (flat[0], flat[-1]):
        draw.ellipse((x - pen / 2, y - pen / 2, x + pen / 2, y + pen / 2), INK)
    if len(sign) < len(whole):
        x, y = flat[-1]
        draw.ellipse((x - 2 * pen, y - 2 * pen, x + 2 * pen, y + 2 * pen), MARK)


def draw_caption(size: tuple[int, int], phase: str, caption: str) -> NDArray[np.uint8]:
    """Draw a caption, with the phase's letter in a disc before it, shape (height, width, 3)."""
    width, height = size
    image = Image.new("RGB", size, INK)
    draw = ImageDraw.Draw(image)
    left = 24.0
    if phase:
        radius, middle = height * 0.3, height / 2
        draw.ellipse((left, middle - radius, left + 2 * radius, middle + radius), MARK)
        draw.text((left + radius, middle), phase, INK, font(round(height * 0.4)), anchor="mm")
        left += 2 * radius + 18
    text = fitting_font(caption, width - left - 20, round(height * 0.4))
    draw.text((left, height / 2), caption, PAPER, text, anchor="lm")
    return np.asarray(image)


def draw_card(size: tuple[int, int], lines: Sequence[str]) -> NDArray[np.uint8]:
    """Draw a card: lines of text on an empty page, the first as a heading, shape (height, width, 3)."""
    image = Image.new("RGB", size, PAPER)
    draw = ImageDraw.Draw(image)
    step = min(40, (size[1] - 80) // max(1, len(lines)))
    longest = max(lines[1:], key=font(23).getlength, default="")
    letters = fitting_font(longest, size[0] - 120, 23)  # one size for all lines under the heading
    for number, line in enumerate(lines):
        draw.text((60, 50 + number * step), line, INK, letters if number else fitting_font(line, size[0] - 120, 27))
    return np.asarray(image)


def draw_label(picture: NDArray[np.uint8], lines: Sequence[str], signs: Signs, framed: bool) -> NDArray[np.uint8]:
    """Write lines and small signs across the top of a picture, (height, width, 3); ``framed`` adds a thick frame."""
    image = Image.fromarray(picture)
    draw = ImageDraw.Draw(image)
    width, height = image.size
    band = 26 + 20 * (len(lines) - 1)
    draw.rectangle((0, 0, width, band), INK)
    for number, line in enumerate(lines):
        draw.text((10, 13 + 20 * number), line, PAPER if number == 0 else MARK, font(16 if number == 0 else 14), "lm")
    box = 40
    for word, sign in enumerate(signs):
        left = width - (len(signs) - word) * (box + 6)
        draw.rectangle((left, 4, left + box, 4 + box), PAPER)
        draw_sign(draw, (left + box / 2, 4 + box / 2), box * 0.38, sign, sign)
    draw.rectangle((0, 0, width - 1, height - 1), outline=MARK if framed else FAINT, width=5 if framed else 1)
    return np.asarray(image)


@functools.cache
def font(size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    """Return Pillow's own font in a size, pixels."""
    return ImageFont.load_default(size)


def fitting_font(text: str, width: float, size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    """Return the font in the largest size, from 8 to ``size``, in which a text fits ``width`` pixels."""
    while size > 8 and font(size).getlength(text) > width:
        size -= 1
    return font(size)
