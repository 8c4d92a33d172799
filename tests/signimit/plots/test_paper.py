"""Figures show what they are given, sorted by movement."""

from __future__ import annotations

import io
import subprocess
import sys

import numpy as np
import pytest

import signimit as si

pytest.importorskip("matplotlib", reason="figures need signimit[scripts]")
from matplotlib.colors import LogNorm
from matplotlib.text import Annotation

from signimit.plots import paper as figures  # needs matplotlib

LABELS = np.array([1, 0, 1, 0])
FOCUS = np.array([0, 1, 2, 0])


def demonstration_set() -> si.DemonstrationSet:
    rng = np.random.default_rng(0)
    demos = [
        si.Demonstration(
            signs=(rng.normal(size=(9, 2)), rng.normal(size=(7, 2))),
            objects=rng.normal(size=(3, 2)) * 0.1,
            hand=rng.normal(size=(20, 2)).cumsum(axis=0) * 0.01,
            times=np.linspace(0.0, 0.38, 20),
        )
        for _ in range(4)
    ]
    return si.DemonstrationSet(demos)


def test_figure_4_has_a_column_a_demonstration_and_a_row_a_sign_and_object() -> None:
    figure = figures.draw_demonstrations(demonstration_set(), LABELS, FOCUS)
    titles = [panel.get_title().splitlines()[0] for panel in figure.axes[:4]]
    assert len(figure.axes) == 4 * (2 + 3)
    assert titles == ["4", "2", "1", "3"]  # counted from 1, by movement, then by object


def test_what_shows_no_movement_comes_last_and_no_panel_of_it_is_framed() -> None:
    labels, focus = np.array([1, -1, 1, 0]), np.array([0, -1, 2, 0])
    figure = figures.draw_demonstrations(demonstration_set(), labels, focus)
    titles = [panel.get_title() for panel in figure.axes[:4]]
    assert titles == ["4\nmovement 1", "1\nmovement 2", "3\nmovement 2", "2\nno movement"]
    framed = [max(s.get_linewidth() for s in panel.spines.values()) > 2 for panel in figure.axes]
    assert [sum(framed[column::4]) for column in range(4)] == [1, 1, 1, 0]
    gamma = np.random.default_rng(0).random((4, 4))
    panel = figures.draw_maximum_similarity(gamma, labels).axes[0]
    assert np.asarray(panel.images[0].get_array())[0, 3] == gamma[3, 1]


def test_figure_5_shows_each_pair_of_frames_on_one_scale() -> None:
    gamma = np.random.default_rng(0).random((4, 4, 3, 3))
    images = [a.images[0] for a in figures.draw_similarities(gamma, LABELS).axes if a.images]
    assert len(images) == 9
    assert len({image.get_clim() for image in images}) == 1
    assert all(isinstance(image.norm, LogNorm) for image in images)
    shown = np.asarray(images[1].get_array())  # t from red, k from green
    assert shown[0, 2] == gamma[1, 0, 0, 1]  # rows and columns come in the order 2, 4, 1, 3
    assert (np.diag(shown) == 0).all()


def test_figure_6_parts_the_movements() -> None:
    gamma = np.random.default_rng(0).random((4, 4))
    panel = figures.draw_maximum_similarity(gamma, LABELS).axes[0]
    assert np.asarray(panel.images[0].get_array())[0, 1] == gamma[1, 3]
    assert float(np.asarray(panel.lines[0].get_ydata()).flat[0]) == 1.5


def test_figure_7_frames_what_was_never_demonstrated_and_counts_what_was_obeyed() -> None:
    path = np.cumsum(np.full((5, 2), 0.01), axis=0)
    pairs = [(m, f) for m in range(2) for f in range(2)]
    figure = figures.draw_reproductions(
        {p: [path, path] for p in pairs}, {p: [True, p == (0, 0)] for p in pairs}, ["up", "down"], frozenset([(1, 1)])
    )
    notes = [panel.get_title(loc="left") for panel in figure.axes]
    assert notes == ["2 of 2 obeyed", "1 of 2 obeyed", "1 of 2 obeyed", "never demonstrated, 1 of 2 obeyed"]
    assert figure.axes[0].get_ylabel() == "up"


def test_figure_7_cuts_no_path_off_and_tells_starts_directions_and_failures_apart() -> None:
    far = np.column_stack([np.linspace(0.1, 0.9, 20), np.linspace(0.0, -0.5, 20)])
    resting = np.full((5, 2), 0.1)
    pairs = [(0, 0), (0, 1)]
    figure = figures.draw_reproductions(
        {p: [far, resting] for p in pairs}, {p: [True, False] for p in pairs}, ["up"], frozenset()
    )
    for panel in figure.axes:
        left, right = panel.get_xlim()
        low, high = panel.get_ylim()
        assert left < 0.0 < 0.9 < right
        assert low < -0.5 < 0.1 < high
        styles = [line.get_linestyle() for line in panel.lines if len(np.atleast_1d(line.get_xdata())) > 1]
        assert len(set(styles)) == 2
        (arrow,) = panel.texts  # none on a hand that rests
        assert isinstance(arrow, Annotation)
        ahead = np.subtract(arrow.xy, arrow.xyann)
        assert ahead @ (far[-1] - far[0]) > 0
        assert [line.get_marker() for line in panel.lines].count("x") == 1
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()][:3] == ["start 1", "start 2", "where the hand starts"]


def test_memberships_have_a_panel_a_demonstration() -> None:
    history = si.group_movements(np.array([[0, 9, 1, 1], [9, 0, 1, 1], [1, 1, 0, 9], [1, 1, 9, 0.0]])).history
    figure = figures.draw_memberships(history, [0, 0, 1, 1])
    assert [panel.get_title() for panel in figure.axes][:2] == [
        "demonstration 1 (movement 1)",
        "demonstration 2 (movement 1)",
    ]
    (legend,) = figure.legends
    named = [text.get_text().split(" (")[0] for text in legend.get_texts()]
    assert named == ["movement 1", "movement 2", "the other groups"]


def test_the_same_figure_gives_the_same_bytes() -> None:
    def drawn() -> bytes:
        file = io.BytesIO()
        figures.draw_maximum_similarity(np.eye(4), LABELS).savefig(file, metadata={"Software": None})
        return file.getvalue()

    assert drawn() == drawn()


def test_importing_signimit_does_not_import_matplotlib() -> None:
    code = "import sys, signimit; sys.exit('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
