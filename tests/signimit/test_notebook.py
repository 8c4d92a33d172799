"""What notebooks show: figures that a parser takes, names as they were given, text that cannot become markup."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import signimit as si
from signimit.shape_names import guess_shape


def circling(rounds: float, way: int = 1, corners: int = 0) -> np.ndarray:
    """A hand, shape (240, 2), that circles the origin or draws a polygon about it."""
    angle = way * 2 * np.pi * rounds * np.linspace(0, 1, 240) + np.pi / 2
    path = np.column_stack([np.cos(angle), np.sin(angle)])
    if corners:
        ring = np.pi / 2 + way * 2 * np.pi * np.arange(round(corners * rounds) + 1) / corners
        at = np.linspace(0, len(ring) - 1, 240)
        path = np.column_stack([np.interp(at, np.arange(len(ring)), f(ring)) for f in (np.cos, np.sin)])
    return np.asarray(0.1 * path)


@pytest.fixture(scope="module")
def demonstrations() -> si.DemonstrationSet:
    rng, shown = np.random.default_rng(0), []
    signs = [[(0, 2), (0, 0), (1, 0)], [(0, 2), (1, 0), (2, 2)], [(0, 2), (2, 2), (0, 0)], [(0, 0), (0, 2), (2, 0)]]
    for focus, movement in [(0, 0), (0, 1), (1, 0), (1, 1)] * 2:
        objects = np.array([[-0.15, 0.0], [0.15, 0.05]]) + rng.uniform(-0.03, 0.03, (2, 2))
        hand = objects[focus] + (circling(2) if movement == 0 else circling(2, -1, corners=3))
        said = [rng.normal(0, 0.05, (3, 2)) + signs[focus], rng.normal(0, 0.05, (3, 2)) + signs[2 + movement]]
        shown.append(si.Demonstration(signs=said, objects=objects, hand=hand, times=np.linspace(0, 6, 240)))
    return si.DemonstrationSet(shown)


@pytest.fixture(scope="module")
def model(demonstrations: si.DemonstrationSet) -> si.ImitationModel:
    return si.learn(demonstrations)


def parsed(shown: str) -> ElementTree.Element:
    """The figure as a parser of XML takes it, with the entity of HTML that is used."""
    return ElementTree.fromstring(shown.replace("&emsp;", " "))


@pytest.mark.parametrize(
    ("path", "name"),
    [
        (circling(2), "like a circle, counter-clockwise, twice"),
        (circling(1, -1), "like a circle, clockwise"),
        (circling(2, -1, corners=3), "like a triangle pointing up, clockwise, twice"),
        (-circling(1, corners=3), "like a triangle pointing down, counter-clockwise"),
        (circling(1, corners=4), "like a square, counter-clockwise"),
    ],
)
def test_a_shape_that_is_clear_is_named(path: np.ndarray, name: str) -> None:
    assert guess_shape([path], [np.linspace(0, 6, 240)]) == name


def test_a_scribble_and_drawings_that_differ_have_no_name() -> None:
    times = np.linspace(0, 6, 240)
    scribble = np.cumsum(np.random.default_rng(3).normal(0, 0.02, (240, 2)), axis=0)
    assert guess_shape([scribble], [times]) == ""
    assert guess_shape([circling(2), circling(2, corners=3)], [times] * 2) == ""


def test_movements_are_named_by_their_shapes_and_by_people(model: si.ImitationModel, tmp_path: Path) -> None:
    assert model.movement_names == (
        "like a circle, counter-clockwise, twice",
        "like a triangle pointing up, clockwise, twice",
    )
    named = model.with_names(movement_names=["stir", None], object_names=["cup", "plate"])
    assert named.names.request(0, 1) == "movement 1 (stir) about the plate object"
    assert "cup" in named.summary()
    named.save(tmp_path / "model.npz")
    again = si.ImitationModel.load(tmp_path / "model.npz")
    assert again.movement_names == ("stir", "like a triangle pointing up, clockwise, twice")
    assert again.summary() == named.summary()
    np.testing.assert_array_equal(again.labels, model.labels)


@pytest.mark.parametrize(
    ("names", "complaint"),
    [
        (["cup"], "expected 2 names, found 1"),
        (["cup", "cup"], "expected a name that no other has"),
        (["cup", "a\nb"], "expected one line of 1 to 40 characters"),
    ],
)
def test_names_that_cannot_be_printed_or_told_apart_are_refused(
    model: si.ImitationModel, names: list[str], complaint: str
) -> None:
    with pytest.raises(si.InvalidInputError, match=complaint):
        model.with_names(object_names=names)


def test_demonstrations_model_and_response_are_drawn(model: si.ImitationModel) -> None:
    shown = parsed(model.demonstrations._repr_html_())
    assert [caption.text for caption in shown.iter("figcaption")] == [str(t + 1) for t in range(8)]
    captions = [caption.text for caption in parsed(model._repr_html_()).iter("figcaption")]
    assert captions[:2] == [
        "movement 1 (like a circle, counter-clockwise, twice), 4×",
        "movement 2 (like a triangle pointing up, clockwise, twice), 4×",
    ]
    assert sum("object" in str(caption) for caption in captions) == 2
    one = model.demonstrations[0]
    answer = model.respond(one.signs, one.objects)
    assert "about the red object, confidence" in "".join(parsed(answer._repr_html_()).itertext())


def test_a_name_cannot_become_markup(model: si.ImitationModel) -> None:
    named = model.with_names(movement_names=["<script>1", None], object_names=["<b>", '"&'])
    one = replace(named, demonstrations=named.demonstrations).demonstrations[0]
    for text in (
        named._repr_html_(),
        named.demonstrations._repr_html_(),
        named.respond(one.signs, one.objects)._repr_html_(),
    ):
        assert "<script" not in text
        assert "<b>&" not in text
        assert "&lt;" in text
        parsed(text)


def test_a_repr_fits_on_a_line(model: si.ImitationModel) -> None:
    one = model.demonstrations[0]
    for thing in (model, model.demonstrations, one, model.respond(one.signs, one.objects), model.names):
        assert len(repr(thing)) <= 200
        assert "\n" not in repr(thing)
