"""Model files: those of version 0.1.0, and those that are not what they say."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit import FileFormatError, ImitationModel, UnknownNameError, group_movements, learn, make_policy
from signimit.io.archive import read_archive, write_archive
from signimit.teaching.composition import compose_demonstrations
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit.teaching.people import synthetic_library

Array = NDArray[np.float64]
FOLDER = Path(__file__).parents[2] / "fixtures" / "0.1.0" / "models"
OLD_MODELS = sorted([*FOLDER.glob("joint*.npz"), *FOLDER.glob("paper*.npz")])


@pytest.fixture(scope="module")
def model() -> ImitationModel:
    rng = np.random.default_rng(0)
    labels = (*PAPER_LANGUAGE.focus_signs, *PAPER_LANGUAGE.movement_signs)
    signs, movements = (synthetic_library(names, rng=rng) for names in (labels, PAPER_LANGUAGE.movements))
    return learn(compose_demonstrations(PAPER_LANGUAGE, signs, movements, rng)[0])


@pytest.mark.parametrize("path", OLD_MODELS, ids=lambda path: path.stem)
def test_a_model_of_version_0_1_0_loads_and_is_written_with_the_same_arrays(path: Path, tmp_path: Path) -> None:
    ImitationModel.load(path).save(tmp_path / "again.npz")
    with np.load(path) as old, np.load(tmp_path / "again.npz") as new:
        assert sorted(new.files) == sorted(old.files)
        for name in old.files:
            np.testing.assert_array_equal(new[name], old[name])


@pytest.mark.parametrize("name", ["focus_probability", "movement_probability", "word_order_evidence"])
@pytest.mark.parametrize("change", [lambda a: a[:1], lambda a: a.astype(str)], ids=["cut", "text"])
def test_a_model_whose_reasons_are_broken_is_refused_when_it_is_loaded(
    model: ImitationModel, tmp_path: Path, name: str, change: object
) -> None:
    model.save(tmp_path / "model.npz")
    with np.load(tmp_path / "model.npz") as file:
        arrays = dict(file)
    arrays[f"diagnostics__{name}"] = change(arrays[f"diagnostics__{name}"])  # type: ignore[operator]
    np.savez(tmp_path / "broken.npz", **arrays)
    with pytest.raises(FileFormatError, match=name.replace("_", " ")):
        ImitationModel.load(tmp_path / "broken.npz")


def test_a_model_without_any_possible_word_order_is_refused(model: ImitationModel, tmp_path: Path) -> None:
    model.save(tmp_path / "model.npz")
    with np.load(tmp_path / "model.npz") as file:
        arrays = dict(file)
    arrays["diagnostics__word_order_evidence"][:] = -np.inf
    np.savez(tmp_path / "broken.npz", **arrays)
    with pytest.raises(FileFormatError, match="word order evidence: expected a number of at least one word order"):
        ImitationModel.load(tmp_path / "broken.npz")


@pytest.mark.parametrize("path", OLD_MODELS, ids=lambda path: path.stem)
def test_a_model_of_version_0_1_0_trusts_everybody_and_has_a_sign_for_each_meaning(path: Path) -> None:
    old = ImitationModel.load(path)
    assert old.trust.tolist() == [1.0] * len(old.labels)
    asked = old.understanding.requests
    np.testing.assert_array_equal(asked.movement, old.labels)
    np.testing.assert_array_equal(asked.focus, old.focus)
    meanings = {("movement", m) for m in old.labels.tolist()} | {("focus", f) for f in old.focus.tolist()}
    assert {(sign.role, sign.meaning) for sign in old.lexicon} == meanings
    assert np.isfinite(old.landmarks).all()


@pytest.mark.parametrize("path", sorted(FOLDER.glob("joint*.npz")), ids=lambda path: path.stem)
def test_a_model_of_version_0_1_0_goes_on_as_if_learned_anew(path: Path, tmp_path: Path) -> None:
    old = ImitationModel.load(path)
    later = old.observe(old.demonstrations[0])
    batch = learn(later.demonstrations, policy=old.policy_kind)
    np.testing.assert_array_equal(later.labels, batch.labels)
    np.testing.assert_array_equal(later.focus, batch.focus)
    assert later.trust.tobytes() == batch.trust.tobytes()
    later.save(tmp_path / "later.npz")
    assert ImitationModel.load(tmp_path / "later.npz").trust.tobytes() == later.trust.tobytes()


ONE = np.eye(12)[0]


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"labels": lambda a: a - 2 * ONE * (a + 1)}, "labels: expected whole numbers from -1 to 11, found [-"),
        ({"diagnostics__sign_distances": lambda a: a - 5}, "sign distances: expected numbers of at least 0, found -5."),
        ({"labels": lambda a: -1 + 0 * a}, "labels: expected movements numbered without gaps, found [-1"),
        ({"labels": lambda a: 2 * a}, "labels: expected movements numbered without gaps"),
        (
            {"focus": lambda a: a - ONE * (a + 1)},
            "focus: expected -1 where the label is -1, and nowhere else, found [-1",
        ),
        ({"focus": lambda a: a - ONE * (a + 2)}, "focus: expected whole numbers from -1 to 2, found [-2"),
        ({"asked_movement": lambda a: a + 3}, "asked movement: expected whole numbers from 0 to 2"),
        (
            {"asked_movement": lambda a: a - ONE * (a + 1)},
            "asked movement: expected whole numbers from 0 to 2, found [-1",
        ),
        ({"asked_movement": lambda a: a[:5]}, "asked movement: expected numbers of shape (12,), found shape (5,)"),
        ({"asked_focus": lambda a: a + 0.5}, "asked focus: expected whole numbers"),
        ({"asked_focus": lambda a: a - 9}, "asked focus: expected whole numbers from 0 to 2"),
        ({"trust": lambda a: a + 2}, "trust: expected probabilities from 0 to 1"),
        ({"trust": lambda a: a - 1.5}, "trust: expected probabilities from 0 to 1"),
        ({"trust": lambda a: a * np.nan}, "trust: expected"),
        ({"trust": lambda a: a.astype(str)}, "trust: expected numbers"),
        ({"trust": lambda a: a[:3]}, "trust: expected numbers of shape (12,), found shape (3,)"),
        ({"diagnostics__drawings": lambda a: a[:3]}, "drawings: expected numbers of shape (12, 12)"),
        ({"diagnostics__offsets": lambda a: np.full_like(a, np.inf)}, "offsets: expected finite numbers"),
    ],
)
def test_a_model_file_that_lies_about_what_was_asked_or_trusted_is_told_in_a_sentence(
    model: ImitationModel, tmp_path: Path, changes: dict[str, Callable[[Array], Array]], sentence: str
) -> None:
    path = tmp_path / "m.npz"
    model.save(path)
    arrays, meta = read_archive(path, "imitation model", 1)
    arrays |= {name: change(arrays[name]) for name, change in changes.items()}
    write_archive(path, "imitation model", 1, arrays, meta)
    with pytest.raises(FileFormatError) as caught:
        ImitationModel.load(path)
    assert str(caught.value).startswith(str(path))
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_names_that_are_no_names_are_refused_in_a_sentence(model: ImitationModel) -> None:
    path, times = np.array([[0.0, 0.0], [0.1, 0.0], [0.1, 0.1]]), np.arange(3) * 0.1
    for ask in (
        lambda: make_policy([path], [times], kind=["knn"]),  # type: ignore[arg-type]
        lambda: group_movements(np.ones((2, 2)), method=["paper"], rng=0),  # type: ignore[arg-type]
        lambda: model.policy(np.array([0, 1])),  # type: ignore[arg-type]
    ):
        with pytest.raises(UnknownNameError, match="known are"):
            ask()
