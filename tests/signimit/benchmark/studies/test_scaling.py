"""Growth is measured in processes of their own."""

import pytest

from signimit.benchmark.studies import scaling
from signimit.benchmark.studies.scaling import compose_many, measure_growth


def test_as_many_demonstrations_are_composed_as_were_asked_for() -> None:
    assert [len(compose_many(count, 0)) for count in (3, 12, 13)] == [3, 12, 13]


def test_a_step_that_would_take_too_long_is_not_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(scaling, "STEPS", ("distances of drawings",))
    found = list(measure_growth((2, 3), seconds=0.0))
    assert [(m.demonstrations, m.code) for m in found] == [(2, "numba"), (2, "numpy")]
    assert all(m.seconds > 0 and m.megabytes >= 0 for m in found)
