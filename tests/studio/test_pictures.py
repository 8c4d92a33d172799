"""Every view in light, in dark and on a phone: nothing sticks out, and everything can be read.

With the folder in SIGNIMIT_PICTURES, e.g. ``SIGNIMIT_PICTURES=docs/images``, the pictures are kept there as
``studio-VIEW-LOOK.png``.
"""

from __future__ import annotations

import io
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

FOLDER = os.environ.get("SIGNIMIT_PICTURES")
DEVICES: dict[str, dict[str, Any]] = {
    "desk": {"viewport": {"width": 1280, "height": 860}},
    "phone": {"viewport": {"width": 390, "height": 844}, "touch": True},
}
LOOKS = {"desk": ("light", "dark"), "phone": ("light",)}
READY = {
    "teach": ".thumb .scene",
    "ask": ".verdict",
    "look": "#look-figures details[open] img" if FOLDER else "#matrix-told",
    "keep": ".sessions .here",
}
PAIRS = (
    ("ink", "card"),
    ("ink", "page"),
    ("quiet", "card"),
    ("quiet", "page"),
    ("accent", "card"),
    ("accent", "soft"),
    ("on-accent", "accent"),
    ("bad", "bad-soft"),
    ("pad-ink", "pad"),
)
NAMES = sorted({name for pair in PAIRS for name in pair})
COLOUR = """(names) => {
  const probe = document.body.appendChild(document.createElement("i"));
  const told = names.map((name) => {
    probe.style.color = `var(--${name})`;
    return [name, getComputedStyle(probe).color];
  });
  probe.remove();
  return Object.fromEntries(told);
}"""
AA = 4.5  # WCAG 2.2, contrast of text
COLOURS = 255  # of a picture that is kept


@pytest.mark.parametrize("device", DEVICES)
def test_every_view_fits_its_window_and_can_be_read(device: str, visit: Any, new_session: Callable[..., str]) -> None:
    visitor = visit(**DEVICES[device])
    visitor.open("teach", new_session(12 if FOLDER else 2))
    for look in LOOKS[device]:
        visitor.page.emulate_media(color_scheme=look)
        colours = {name: channels(told) for name, told in visitor.page.evaluate(COLOUR, NAMES).items()}
        for one, other in PAIRS:
            assert contrast(colours[one], colours[other]) >= AA, (look, one, other)
    for view, ready in READY.items():
        visitor.page.locator(f"#tab-{view}").click()
        if view == "ask":
            visitor.page.locator("#ask-for-it").click()
        visitor.page.locator(ready.split()[0]).first.scroll_into_view_if_needed()  # pictures wait to be seen
        visitor.page.locator(ready).first.wait_for()
        visitor.page.evaluate("() => scrollTo(0, 0)")
        assert visitor.page.evaluate("() => document.documentElement.scrollWidth - innerWidth") == 0, view
        for look in LOOKS[device] if FOLDER else ():
            visitor.page.emulate_media(color_scheme=look)
            keep(visitor.page, f"studio-{view}-{device if device == 'phone' else look}.png")


def test_no_view_has_a_serious_fault_for_screen_readers(visit: Any, new_session: Callable[..., str]) -> None:
    axe = pytest.importorskip("axe_playwright_python.base", reason="needs axe-playwright-python (signimit[test])")
    visitor = visit(viewport={"width": 1280, "height": 860})
    visitor.open("teach", new_session(2))
    visitor.page.evaluate(axe.AXE_SCRIPT)
    for view, ready in READY.items():
        visitor.page.locator(f"#tab-{view}").click()
        if view == "ask":
            visitor.page.locator("#ask-for-it").click()
        visitor.page.locator(ready).first.wait_for()
        found = visitor.page.evaluate("async () => (await axe.run()).violations")
        assert [fault["help"] for fault in found if fault["impact"] in ("serious", "critical")] == [], view


def channels(colour: str) -> list[int]:
    """Return red, green and blue of a colour as the browser writes it."""
    return [int(part) for part in colour.removeprefix("rgb(").removesuffix(")").split(",")]


def contrast(one: list[int], other: list[int]) -> float:
    """Return the contrast ratio of two colours (WCAG 2.2)."""
    shares = np.array([one, other]) / 255
    linear = np.where(shares <= 0.04045, shares / 12.92, ((shares + 0.055) / 1.055) ** 2.4)
    dark, light = sorted(linear @ [0.2126, 0.7152, 0.0722])
    return float((light + 0.05) / (dark + 0.05))


def keep(page: Any, name: str) -> None:
    """Keep a picture of the window."""
    if "ask" in name:
        page.wait_for_timeout(2000)  # so long the arm draws
    picture = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
    few = picture.quantize(COLOURS, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    few.save(Path(str(FOLDER)) / name, optimize=True)
