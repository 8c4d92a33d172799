"""One demonstration after another leads to what all at once lead to."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from signimit import DemonstrationSet, ImitationModel, InvalidInputError, UnknownNameError, learn
from signimit.teaching.composition import compose_demonstrations
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit.teaching.people import synthetic_library


def session(seed: int) -> DemonstrationSet:
    rng, language = np.random.default_rng(seed), PAPER_LANGUAGE
    signs = synthetic_library((*language.focus_signs, *language.movement_signs), samples=6, rng=rng)
    movements = synthetic_library(language.movements, samples=10, rng=rng)
    return compose_demonstrations(language, signs, movements, rng)[0]


@pytest.mark.parametrize("seed", [0, 1])
def test_after_twelve_observations_all_is_as_if_learned_at_once(seed: int) -> None:
    demos = session(seed)
    model = learn(DemonstrationSet(demos[:1]))
    for demonstration in demos[1:]:
        model = model.observe(demonstration)
    batch = learn(demos)
    np.testing.assert_array_equal(model.labels, batch.labels)
    np.testing.assert_array_equal(model.focus, batch.focus)
    assert model.word_order == batch.word_order
    for name in ("distances", "sign_distances", "place_evidence"):
        np.testing.assert_allclose(model.diagnostics[name], batch.diagnostics[name], rtol=1e-3, atol=2e-3)


def test_observing_leaves_the_old_model_as_it_was_and_goes_on_from_a_file(tmp_path: Path) -> None:
    demos = session(2)
    model = learn(DemonstrationSet(demos[:8]))
    model.save(tmp_path / "model.npz")
    more = ImitationModel.load(tmp_path / "model.npz").observe(demos[8])
    assert (len(model.labels), len(more.labels)) == (8, 9)
    np.testing.assert_array_equal(more.labels, model.observe(demos[8]).labels)
    assert "9 demonstrations show" in str(more.explain())


def test_policies_are_kept_where_neither_members_nor_foci_changed() -> None:
    demos = session(2)
    model = learn(DemonstrationSet(demos[:8]), policy="knn")
    old = [model.policy(m) for m in range(len(model.movements))]
    more = model.observe(demos[8])
    joined = int(more.labels[8])
    for m, movement in enumerate(more.movements):
        same = [n for n, other in enumerate(model.movements) if other.members == movement.members]
        assert (more.policy(m) in old) == (m != joined)
        assert all(more.policy(m) is old[n] for n in same)
    np.testing.assert_array_equal(more.focus[:8], model.focus)


def test_what_does_not_fit_is_refused() -> None:
    demos = session(2)
    model = learn(DemonstrationSet(demos[:3]))
    with pytest.raises(InvalidInputError, match="demonstration 3"):
        model.observe(replace(demos[3], signs=demos[3].signs[:1]))
    paper = learn(DemonstrationSet(demos[:3]), prototypes=demos[4].signs, method="paper")
    with pytest.raises(InvalidInputError, match="one demonstration at a time: joint, found 'paper'"):
        paper.observe(demos[3])
    with pytest.raises(InvalidInputError, match="probabilities"):
        paper.explain()
    bare = replace(model, understanding=model.understanding._replace(evidence=None))
    with pytest.raises(InvalidInputError, match="diagnostics: expected distances"):
        bare.observe(demos[3])


@pytest.mark.parametrize("least", [-0.1, 1.1, float("nan"), "0.5", None, [0.1, 0.2]])
def test_what_is_no_probability_is_refused(least: Any) -> None:
    demos = session(2)
    with pytest.raises(InvalidInputError, match="least: expected"):
        learn(demos[:2]).respond_if_sure(demos[0].signs, demos[0].objects, least)


def test_a_method_that_is_no_name_is_refused() -> None:
    names: Any = ["joint"]
    with pytest.raises(UnknownNameError, match="Unknown method"):
        learn(session(2)[:2], method=names)
