"""The card of a film says what a model understood."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="films need the simulator")

from signimit import Names
from signimit.inference import WordOrder
from signimit_envs.video.storyboard import show_card


@pytest.mark.parametrize(
    ("labels", "told"),
    [([0, 1, 0], []), ([0, 1, -1, 0, -1], ["    none of them in demonstrations 3, 5"])],
)
def test_the_card_names_the_demonstrations_of_each_movement_and_of_none(labels: list[int], told: list[str]) -> None:
    found = np.array(labels)
    movements = [SimpleNamespace(members=tuple(np.flatnonzero(found == m).tolist())) for m in range(2)]
    model = SimpleNamespace(labels=found, movements=movements, word_order=WordOrder(0, 1), names=Names())
    card = next(show_card(SimpleNamespace(model=model))).card  # type: ignore[arg-type]
    first = ", ".join(str(t + 1) for t in movements[0].members)
    assert list(card[3:-3]) == [
        f"    movement 1, in demonstrations {first}",
        "    movement 2, in demonstrations 2",
        *told,
    ]
