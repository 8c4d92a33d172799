"""Model files: those of version 0.1.0, and those that are not what they say."""

from pathlib import Path

import numpy as np
import pytest

from signimit import FileFormatError, ImitationModel, UnknownNameError, group_movements, learn, make_policy
from signimit.teaching.composition import compose_demonstrations
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit.teaching.people import synthetic_library

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


def test_names_that_are_no_names_are_refused_in_a_sentence(model: ImitationModel) -> None:
    path, times = np.array([[0.0, 0.0], [0.1, 0.0], [0.1, 0.1]]), np.arange(3) * 0.1
    for ask in (
        lambda: make_policy([path], [times], kind=["knn"]),  # type: ignore[arg-type]
        lambda: group_movements(np.ones((2, 2)), method=["paper"], rng=0),  # type: ignore[arg-type]
        lambda: model.policy(np.array([0, 1])),  # type: ignore[arg-type]
    ):
        with pytest.raises(UnknownNameError, match="known are"):
            ask()
