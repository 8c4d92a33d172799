"""Verdicts, intervals and calibration, worked by hand."""

import numpy as np
import pytest

pytest.importorskip("sklearn", reason="the study needs scikit-learn")

from signimit import WordOrder, learn
from signimit.benchmark.studies.cells import Cell, compose_session
from signimit.benchmark.studies.methods import Answer
from signimit.benchmark.studies.scoring import calibrate, confidences, judge


def test_a_verdict_does_not_care_how_movements_are_numbered() -> None:
    truth = compose_session(Cell(movements=2, objects=2, repetitions=1), 0).truth
    right = Answer(1 - truth.movement, truth.focus.copy(), WordOrder(0, 1))
    assert judge(right, truth).all
    assert judge(right._replace(labels=np.zeros(4, dtype=np.int64)), truth) == (False, True, True)
    assert judge(right._replace(focus=1 - truth.focus), truth) == (True, False, True)
    assert judge(right._replace(order=WordOrder(1, 0)), truth) == (True, True, False)


def test_calibration_of_four_commands_by_hand() -> None:
    found = calibrate([0.95, 0.95, 0.55, 1.0], [1, 0, 1, 1])
    np.testing.assert_allclose(found.confidence, [0.55, 2.9 / 3])
    np.testing.assert_allclose(found.accuracy, [1, 2 / 3])
    assert found.counts.tolist() == [1, 3]
    assert found.error == pytest.approx((0.45 + 3 * 0.3) / 4)
    np.testing.assert_allclose(found.coverage, [0.25, 0.5, 0.75, 1])
    np.testing.assert_allclose(found.risk, [0, 0, 1 / 3, 1 / 4])


def test_every_command_has_a_confidence_and_a_verdict() -> None:
    session = compose_session(Cell(movements=2, objects=2, repetitions=2), 1)
    asked = confidences(learn(session.demonstrations, policy="knn"), session)
    assert len(asked) == 4
    assert all(0 < sure <= 1 for sure, _ in asked)
    assert sum(right for _, right in asked) == 4
