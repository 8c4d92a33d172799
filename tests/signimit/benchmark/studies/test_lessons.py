"""Lessons: who asks well understands sooner, and what is asked is answered truthfully."""

from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("sklearn", reason="the study's tables need scikit-learn")

from signimit.benchmark.studies.asking import STRATEGIES, Lesson, Question, ask_the_least_shown, run_lessons
from signimit.benchmark.studies.conditions import study_condition
from signimit.benchmark.studies.tables import LessonRow, demonstrations_needed, tabulate_lessons
from signimit.demonstrations import DemonstrationSet
from signimit.inference import WordOrder
from signimit.learners.base import Asked
from signimit.learning import learn
from signimit.teaching.languages import Request

CONDITION = study_condition(3, 2, 1)


def test_a_lesson_begins_with_every_sign_once() -> None:
    lesson = Lesson(study_condition(5, 3, 1), 4)
    assert len(lesson.requests) == 5
    assert {r.movement for r in lesson.requests} == set(range(5))
    assert {r.focus for r in lesson.requests} == set(range(3))


@pytest.mark.parametrize("name", STRATEGIES)
def test_every_strategy_asks_for_something_that_can_be_shown(name: str) -> None:
    lesson = Lesson(CONDITION, 1)
    model = learn(DemonstrationSet(lesson.demonstrations), policy="knn")
    scenes = lesson.scenes(3)
    question = STRATEGIES[name](lesson, model, scenes)
    assert question.request in lesson.language.requests
    assert any(np.array_equal(question.objects, scene) for scene in scenes)
    lesson.show(question)
    assert lesson.requests[-1] == question.request
    assert len(lesson.demonstrations) == 4


def test_the_least_shown_pair_is_counted_by_what_was_asked_for() -> None:
    lesson = Lesson(CONDITION, 1)
    model = SimpleNamespace(
        movements=(None, None),
        labels=np.array([0, -1, 1]),
        focus=np.array([0, -1, 0]),
        word_order=WordOrder(lesson.language.focus_word, lesson.language.movement_word),
        understanding=SimpleNamespace(requests=Asked(np.array([0, 0, 1]), np.array([0, 1, 0]))),
    )
    lesson.requests[:3] = [Request(0, 0), Request(0, 1), Request(1, 0)]
    assert ask_the_least_shown(lesson, model, lesson.scenes(2)).request == Request(1, 1)  # type: ignore[arg-type]


def test_copied_signs_mean_what_they_meant_whatever_the_word_order() -> None:
    for seed in (0, 1):
        lesson = Lesson(CONDITION, seed)
        lesson.requests[:2] = [Request(0, 1), Request(2, 0)]
        copied = [0, 0]
        copied[lesson.language.movement_word] = 1
        assert lesson.meaning(copied) == Request(2, 1)


def test_a_model_of_every_pair_understands_what_it_is_asked() -> None:
    lesson = Lesson(CONDITION, 3)
    for request in lesson.language.requests * 2:
        lesson.show(Question(request, lesson.scenes(1)[0]))
    assert lesson.accuracy(learn(DemonstrationSet(lesson.demonstrations), policy="knn")) == 1.0


def test_all_strategies_start_from_the_same_demonstrations() -> None:
    record = run_lessons(study_condition(2, 2, 1), 0)
    curves = list(record["curves"].values())
    assert record["first"] == 2
    assert len({curve[0] for curve in curves}) == 1
    assert {len(curve) for curve in curves} == {7}


def test_curves_are_averaged_and_need_so_many_demonstrations() -> None:
    records = [
        {"cell": "c", "seed": seed, "first": 3, "curves": {"a": curve, "b": [0.5, 0.5, 0.5]}}
        for seed, curve in enumerate(([0.5, 1.0, 1.0], [0.5, 0.8, 1.0]))
    ]
    rows = tabulate_lessons(records)
    half = 1.96 * 0.1  # of two values 0.2 apart: deviation 0.1 * sqrt(2), over sqrt(2)
    assert rows[1] == LessonRow("c", "a", 4, 2, 0.9, round(0.9 - half, 4), 1.0)
    assert demonstrations_needed(rows, 0.9) == [("c", "a", 4), ("c", "b", None)]
    assert demonstrations_needed(rows, 0.5) == [("c", "a", 3), ("c", "b", 3)]
