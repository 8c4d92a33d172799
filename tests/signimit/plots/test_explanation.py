"""The figure of the reasons shows every demonstration, every meaning and every doubt."""

import dataclasses

import numpy as np
import pytest

pytest.importorskip("matplotlib", reason="figures need matplotlib")

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from signimit import ImitationModel, InvalidInputError, learn
from signimit.benchmark.studies.conditions import compose_study_session, study_condition
from signimit.learners.base import Asked, Belief
from signimit.lexicon import Sign
from signimit.plots.explanation import draw_explanation

SESSION = compose_study_session(study_condition(3, 2, 1), 1)


@pytest.fixture(scope="module")
def model() -> ImitationModel:
    return learn(SESSION.demonstrations, policy="knn")


def doubting(model: ImitationModel, number: int) -> ImitationModel:
    """The same model, in doubt about the object and the movement of one demonstration."""

    def mixed(belief: NDArray[np.float64]) -> NDArray[np.float64]:
        changed = belief.copy()
        changed[number] = 0.0
        changed[number, :2] = 0.6, 0.4
        return changed

    belief = model.understanding.belief
    assert belief is not None
    focus, movement, orders = belief
    doubtful = Belief(mixed(focus), mixed(movement), orders)
    return dataclasses.replace(model, understanding=model.understanding._replace(belief=doubtful))


def panels(figure: Figure) -> list[Axes]:
    return [axes for part in figure.subfigs for axes in part.axes]


def texts(axes: Axes) -> list[str]:
    return [t.get_text() for t in axes.texts]


def test_bars_of_all_demonstrations_are_as_high_as_one(model: ImitationModel) -> None:
    for panel in panels(draw_explanation(model))[:2]:
        tops: dict[float, float] = {}
        for bar in panel.patches:
            tops[round(bar.get_x(), 3)] = tops.get(round(bar.get_x(), 3), 0.0) + bar.get_height()  # type: ignore[attr-defined]
        assert len(tops) == len(SESSION.demonstrations)
        assert list(tops.values()) == pytest.approx([1.0] * len(tops))


def test_what_is_in_doubt_has_a_mark_and_the_distance_of_the_objects(model: ImitationModel) -> None:
    assert not any("?" in text for panel in panels(draw_explanation(model))[:2] for text in texts(panel))
    upper, lower = panels(draw_explanation(doubting(model, 2)))[:2]
    apart = np.linalg.norm(np.diff(SESSION.demonstrations[2].objects, axis=0))
    assert texts(upper) == [f"?\n{100 * apart:.0f} cm"]
    assert texts(lower) == ["?"]


def test_the_lexicon_shows_every_stroke_once(model: ImitationModel) -> None:
    lexicon = panels(draw_explanation(model))[2:-1]
    count, columns = len(SESSION.demonstrations), 3
    focus, movement = lexicon[:columns], lexicon[columns : 2 * columns]
    assert sum(len(panel.lines) for panel in focus) == sum(len(panel.lines) for panel in movement) == count
    assert [panel.get_title() for panel in focus] == ["red, 3 times", "green, 3 times", ""]


def test_every_word_order_has_a_bar_the_chosen_one_of_no_length(model: ImitationModel) -> None:
    last = panels(draw_explanation(model))[-1]
    lengths = [bar.get_width() for bar in last.patches]  # type: ignore[attr-defined]
    assert lengths == [0.0, pytest.approx(model.explain().word_orders[1][1])]


def test_a_method_without_probabilities_has_no_picture() -> None:
    model = learn(SESSION.demonstrations, SESSION.prototypes, method="paper", policy="knn")
    with pytest.raises(InvalidInputError, match='"joint" has'):
        draw_explanation(model)


def beside_the_point(model: ImitationModel, number: int) -> ImitationModel:
    """The same model, where one demonstration shows none of the movements."""
    known = model.understanding
    belief = known.belief
    assert belief is not None
    labels, focus, movement = known.labels.copy(), known.focus.copy(), belief.movement_probability.copy()
    labels[number] = focus[number] = -1
    movement[number] = np.eye(movement.shape[1])[-1]
    trust = np.ones(len(labels))
    trust[number] = 0.01
    belief = belief._replace(movement_probability=movement)
    changed = known._replace(
        labels=labels, focus=focus, belief=belief, asked=Asked(known.labels, known.focus), trust=trust
    )
    return dataclasses.replace(model, understanding=changed)


def test_a_demonstration_of_nothing_comes_last_with_a_mark_and_is_about_none(model: ImitationModel) -> None:
    changed = beside_the_point(model, 0)
    upper, lower = panels(draw_explanation(changed))[:2]
    assert [tick.get_text() for tick in lower.get_xticklabels()][-1] == "1"
    assert texts(lower) == ["!"]
    for panel in (upper, lower):
        legend = panel.get_legend()
        assert legend is not None
        assert [entry.get_text() for entry in legend.get_texts()][-1] == "none"
        count = len(SESSION.demonstrations)
        assert panel.patches[-1].get_height() == 1.0  # type: ignore[attr-defined]
        assert sum(bar.get_height() for bar in panel.patches[-count:]) == pytest.approx(1.0, abs=0.05)  # type: ignore[attr-defined]


def test_its_words_are_in_the_lexicon_its_path_is_not(model: ImitationModel) -> None:
    lexicon = panels(draw_explanation(beside_the_point(model, 0)))[2:-1]
    count = len(SESSION.demonstrations)
    words, movements = lexicon[:6], lexicon[6:9]
    assert sum(len(panel.lines) for panel in words) == 2 * count
    assert sum(len(panel.lines) - 1 for panel in movements) == count - 1  # one line is the cross


def test_two_ways_of_writing_are_counted_apart(model: ImitationModel) -> None:
    red = np.flatnonzero(model.focus == 0)
    lexicon = (
        Sign("focus", 0, tuple(red[:2].tolist())),
        Sign("focus", 0, tuple(red[2:].tolist())),
        *(sign for sign in model.lexicon if (sign.role, sign.meaning) != ("focus", 0)),
    )
    written = dataclasses.replace(model)
    written.__dict__["lexicon"] = lexicon
    panel = panels(draw_explanation(written))[2]
    assert panel.get_title() == "red, 2 + 1 times"
    assert [line.get_linestyle() for line in panel.lines] == ["-", "-", "--"]
