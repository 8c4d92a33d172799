"""A session that plays itself: whatever the page shows at any moment is of one demonstration."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from signimit_envs.studio.web.serving import StudioPlan, running_studio

DEMONSTRATIONS = 3
TOLD = " The robot is told nothing of this."
RECORD = """
window.seen = new Set();
const text = (place) => document.querySelector(place)?.textContent ?? "";
const look = () => {
  if (text("#caption") && location.hash.startsWith("#teach")) {
    const card = [...document.querySelectorAll("#belief h3")].map((h) => h.textContent);
    const number = (card.find((title) => title.startsWith("Demonstration")) ?? "");
    seen.add(JSON.stringify([text("#caption"), text("#teach-prompt"), text("#teach-count"), number]));
  }
  requestAnimationFrame(look);
};
requestAnimationFrame(look);
"""


def test_caption_prompt_and_belief_are_of_the_same_demonstration_at_every_moment(
    visit: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for pause in ("_FIRST_PAUSE", "_PAUSE"):
        monkeypatch.setattr(f"signimit_envs.studio.demo.{pause}", 0.4)
    with running_studio(StudioPlan(folder=tmp_path, demo=True, seed=7)) as address:
        visitor = visit(address=address)
        visitor.page.add_init_script(RECORD)
        visitor.open()
        visitor.page.wait_for_function("(most) => seen.size >= most", arg=DEMONSTRATIONS)  # a busy page may skip some
        seen = visitor.page.evaluate("[...seen].map((one) => JSON.parse(one))")
        visitor.page.close()
    for caption, prompt, count, card in seen:
        assert caption == prompt + TOLD
        assert count == f"{card}, by built-in people"
    assert len({card for *_, card in seen}) == len(seen)
