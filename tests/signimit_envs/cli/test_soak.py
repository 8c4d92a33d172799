"""The soak steps every scenario, and notices what is not sound."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from signimit_envs import RenderingError, TabletopEnv
from signimit_envs.cli import main, soak
from signimit_envs.recording.replay import Divergence
from signimit_envs.video.backend import choose_backend


def table(said: str) -> dict[str, list[str]]:
    """Return the cells of a Markdown table by the first."""
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in said.splitlines()[2:]]
    return {row[0]: row[1:] for row in rows}


def test_a_short_run_of_all_scenarios_is_sound(capsys: pytest.CaptureFixture[str]) -> None:
    main(["soak", "--steps", "3200", "--pixels", "0", "--seed", "3"])
    rows = table(capsys.readouterr().out)
    assert rows.keys() == soak.SCENARIOS.keys()
    assert all(int(row[0]) == 400 for row in rows.values())
    assert all(row[-1] == "" for row in rows.values())
    refused, blow_ups = ([int(row[number]) for name, row in rows.items() if "intent" in name] for number in (2, 3))
    assert min(refused) > 0
    assert min(blow_ups) > 0


def test_a_short_run_with_pictures_is_sound(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    try:
        choose_backend()
    except RenderingError as error:
        pytest.skip(str(error))
    names = ("pixels with bad intent", "recorder, pixels", "vector, pixels, SameStep")  # renderers take time to open
    monkeypatch.setattr(soak, "PIXEL_SCENARIOS", {name: soak.PIXEL_SCENARIOS[name] for name in names})
    monkeypatch.setattr(soak, "_VECTOR", 2)
    main(["soak", "--steps", "0", "--pixels", "60"])
    rows = table(capsys.readouterr().out)
    assert tuple(rows) == names
    assert all(row[-1] == "" for row in rows.values())


@pytest.mark.parametrize("scenario", ["joint control at random", "hand control with bad intent", "vector, SameStep"])
@pytest.mark.parametrize("value", [np.nan, 1e6])
def test_an_observation_out_of_its_space_is_noticed(
    scenario: str, value: float, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    step = TabletopEnv.step

    def unsound(self: TabletopEnv, action: Any) -> Any:
        observation, *rest = step(self, action)
        return {**observation, "joints": np.full(3, value)}, *rest

    monkeypatch.setattr(TabletopEnv, "step", unsound)
    monkeypatch.setattr(soak, "SCENARIOS", {scenario: soak.SCENARIOS[scenario]})
    with pytest.raises(SystemExit) as stop:
        main(["soak", "--steps", "50", "--pixels", "0"])
    assert stop.value.code == 1
    assert "ArithmeticError: an observation is not in its space" in capsys.readouterr().out


def test_what_diverges_grows_or_is_not_refused_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(0)
    with monkeypatch.context() as patch:
        patch.setattr(soak, "find_divergence", lambda *recorded: Divergence(1, 0.5))
        diverged = soak.soak("a", soak.SCENARIOS["recorder"], 1801, rng)
    assert "a replay diverges" in diverged.problem
    with monkeypatch.context() as patch:
        sizes = iter((100.0, 200.0))
        patch.setattr(soak, "_memory", lambda: next(sizes))
        assert soak.soak("a", soak.SCENARIOS["vector, Disabled"], 20, rng).problem == "grew by more than 32 MiB"
    with monkeypatch.context() as patch:
        patch.setattr(soak, "_impossible_actions", lambda size: [np.zeros(size)] * 7)
        taken = soak.soak("a", soak.SCENARIOS["joint control with bad intent"], 9999, rng)
    assert "an action was taken that cannot be" in taken.problem
    with monkeypatch.context() as patch:
        reset = TabletopEnv.reset
        patch.setattr(TabletopEnv, "reset", lambda self, **given: 1 / 0 if given["options"] else reset(self, **given))
        assert "ZeroDivisionError" in soak.soak("a", soak.SCENARIOS["joint control with bad intent"], 9999, rng).problem
