"""Learning as a whole: what is understood and answered, that labels never help, and files of models."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from signimit import (
    Demonstration,
    DemonstrationSet,
    FileFormatError,
    ImitationModel,
    InvalidInputError,
    Stroke,
    StrokeLibrary,
    UnknownNameError,
    WordOrder,
    learn,
)
from signimit.grouping import canonical_labels
from signimit.io.archive import read_archive, write_archive
from signimit.teaching.composition import GroundTruth, compose_demonstrations, compose_prototypes, compose_utterance
from signimit.teaching.languages import PAPER_LANGUAGE, Language
from signimit.teaching.people import SIGN_LABELS, synthetic_library
from signimit.teaching.stroke_sampler import StrokeSampler

Array = NDArray[np.float64]
CORNERS: dict[str, list[list[float]]] = {
    "bar": [[0, 0], [0, 4]], "hook": [[0, 3], [2, 3], [2, 0]], "wedge": [[0, 3], [1, 0], [2, 3]],
    "dash": [[0, 0], [4, 0]], "step": [[0, 0], [1, 0], [1, 2], [3, 2]], "roof": [[0, 0], [2, 3], [4, 0]],
    "circle": [[np.cos(a), np.sin(a)] for a in np.linspace(0, 2 * np.pi, 40)],
    "clockwise": [[np.cos(a), -np.sin(a)] for a in np.linspace(0, 2 * np.pi, 40)],
    "triangle": [[1, -0.6], [0, 1], [-1, -0.6], [1, -0.6]],
}  # fmt: skip
LANGUAGE = Language(
    focus_signs=("bar", "hook", "wedge"), movement_signs=("dash", "step", "roof"),
    movements=("circle", "triangle", "clockwise"), prototypes=("bar", "step", "roof"),
)  # fmt: skip
SWAPPED = Language(
    focus_signs=LANGUAGE.focus_signs, movement_signs=LANGUAGE.movement_signs, movements=LANGUAGE.movements,
    prototypes=LANGUAGE.prototypes, focus_word=1, movement_word=0,
)  # fmt: skip
SCENE = np.array([[-0.1, 0.05], [0.1, 0.1], [0.05, -0.1]])


def drawn(corners: Sequence[Sequence[float]], rng: np.random.Generator) -> Stroke:
    """Draw through corners by a hand that is not quite steady."""
    points = np.asarray(corners, dtype=np.float64)
    length = np.concatenate([[0.0], np.hypot(*np.diff(points, axis=0).T).cumsum()])
    ticks = np.linspace(0.0, length[-1], 60)
    line = np.column_stack([np.interp(ticks, length, points[:, d]) for d in (0, 1)])
    return Stroke(line @ (np.eye(2) + rng.normal(0, 0.04, (2, 2))), ticks / length[-1] * 2.0)


def library(seed: int) -> StrokeLibrary:
    rng = np.random.default_rng(seed)
    labels = [label for label in CORNERS for _ in range(14)]
    return StrokeLibrary(tuple(drawn(CORNERS[x], rng) for x in labels), tuple(labels), ("somebody",) * len(labels))


class Session:
    """What was shown, and apart from it the truth and new utterances."""

    def __init__(self, language: Language, seed: int = 2) -> None:
        self.language, self.rng = language, np.random.default_rng(seed)
        self.deck = StrokeSampler(library(seed))
        self.prototypes = compose_prototypes(language, self.deck, self.rng)
        self.demonstrations, self.truth = compose_demonstrations(language, self.deck, library(seed + 100), self.rng)

    def learn(self, method: str = "paper", policy: str = "knn", rng: int = 0) -> ImitationModel:
        return learn(self.demonstrations, self.prototypes, method=method, policy=policy, rng=rng)

    def say(self, movement: int, focus: int) -> tuple[Array, ...]:
        return compose_utterance(self.language, self.deck, movement, focus, self.rng)


@pytest.fixture(scope="module")
def session() -> Session:
    return Session(LANGUAGE)


@pytest.fixture(scope="module")
def model(session: Session) -> ImitationModel:
    return session.learn()


def understood(model: ImitationModel, truth: GroundTruth) -> bool:
    return model.labels.tolist() == canonical_labels(truth.movement).tolist() and bool(
        (model.focus == truth.focus).all()
    )


def bytes_of(model: ImitationModel) -> list[bytes]:
    arrays = [model.labels, model.focus, np.array(model.word_order), *model.diagnostics.values()]
    return [np.ascontiguousarray(a).tobytes() for a in arrays]


def test_movements_foci_and_word_order_are_found(session: Session, model: ImitationModel) -> None:
    assert understood(model, session.truth)
    assert model.word_order == WordOrder(focus=0, movement=1)
    assert len(model.movements) == 3


def test_the_word_order_is_found_when_it_is_swapped() -> None:
    session = Session(SWAPPED)
    assert session.learn().word_order == WordOrder(focus=1, movement=0)


@pytest.mark.parametrize("language", [LANGUAGE, SWAPPED], ids=["focus first", "movement first"])
def test_every_pair_is_understood_also_those_never_shown(language: Language) -> None:
    session = Session(language)
    model = session.learn()
    name = {int(m): int(label) for m, label in zip(session.truth.movement, model.labels, strict=True)}
    for movement, focus in language.requests:
        response = model.respond(session.say(movement, focus), SCENE)
        assert (response.movement, response.focus) == (name[movement], focus)
        assert 0.0 < response.confidence <= 1.0
    assert language.held_back


def test_an_unseen_pair_of_synthetic_people_is_understood() -> None:
    for seed in range(6):
        rng = np.random.default_rng(seed)
        deck = StrokeSampler(synthetic_library(SIGN_LABELS, samples=12, rng=rng))
        prototypes = compose_prototypes(PAPER_LANGUAGE, deck, rng)
        movements = synthetic_library(PAPER_LANGUAGE.movements, samples=9, rng=rng)
        demonstrations, truth = compose_demonstrations(PAPER_LANGUAGE, deck, movements, rng)
        model = learn(demonstrations, prototypes, method="paper", policy="knn", rng=seed)
        if understood(model, truth):
            break
    assert understood(model, truth), "not one of six sessions was grouped right"
    name = {int(m): int(label) for m, label in zip(truth.movement, model.labels, strict=True)}
    for movement, focus in PAPER_LANGUAGE.held_back:
        response = model.respond(compose_utterance(PAPER_LANGUAGE, deck, movement, focus, rng), SCENE)
        assert (response.movement, response.focus) == (name[movement], focus)


def test_swapping_only_the_sign_for_the_object_moves_the_answer_there(session: Session, model: ImitationModel) -> None:
    first, second = (model.respond(session.say(0, focus), SCENE) for focus in (0, 1))
    assert first.movement == second.movement
    hand = np.array([0.02, 0.03])
    np.testing.assert_allclose(first.policy(hand), second.policy(hand - SCENE[0] + SCENE[1]), atol=1e-12)


def test_moving_the_objects_moves_the_policy_with_them(session: Session, model: ImitationModel) -> None:
    words, shift, hands = session.say(0, 1), np.array([0.03, -0.02]), SCENE + 0.02
    here, there = model.respond(words, SCENE), model.respond(words, SCENE + shift)
    np.testing.assert_allclose(there.policy(hands + shift), here.policy(hands), atol=1e-9)
    assert here.policy(hands).shape == (3, 2)
    assert here.policy(hands[0]).shape == (2,)


def test_a_doubtful_answer_is_declined_and_a_sure_one_given(session: Session, model: ImitationModel) -> None:
    signs = session.say(0, 1)
    sure = model.respond(signs, SCENE).confidence
    given = model.respond_if_sure(signs, SCENE, sure)
    assert given is not None
    assert given[:2] == model.respond(signs, SCENE)[:2]
    assert model.respond_if_sure(signs, SCENE, np.nextafter(sure, 1.0)) is None
    for nonsense in (-0.1, 1.5, float("nan")):
        with pytest.raises(InvalidInputError, match="least: expected"):
            model.respond_if_sure(signs, SCENE, nonsense)


def test_a_query_is_made_of_signs_that_were_seen_and_asks_for_what_the_model_believes(session: Session) -> None:
    model = session.learn(method="joint")
    query = model.most_informative([SCENE, 2 * SCENE])
    for word, t in enumerate(query.copied):
        assert np.array_equal(query.signs[word], session.demonstrations[t].signs[word])
    assert query.scene == 1
    response = model.respond(query.signs, SCENE)
    assert (response.movement, response.focus) == (query.movement, query.focus)
    with pytest.raises(InvalidInputError, match="scenes: expected numbers of shape"):
        model.most_informative(SCENE)
    with pytest.raises(InvalidInputError, match="scenes: expected at least one"):
        model.most_informative(np.empty((0, 3, 2)))


def test_a_movement_is_its_members_seen_from_their_objects(session: Session, model: ImitationModel) -> None:
    for movement in model.movements:
        for t, path, times in zip(*movement, strict=True):
            shown = session.demonstrations[t]
            np.testing.assert_array_equal(model.landmarks[t], shown.objects[model.focus[t]])
            np.testing.assert_array_equal(path, shown.hand - model.landmarks[t])
            np.testing.assert_array_equal(times, shown.times)
    assert sorted(t for movement in model.movements for t in movement.members) == list(range(12))


def test_the_truth_changes_nothing(session: Session, model: ImitationModel) -> None:
    again = Session(LANGUAGE)
    scrambled = GroundTruth(LANGUAGE, again.truth.movement[::-1], again.truth.focus[::-1], again.truth.templates[::-1])
    assert scrambled.movement.tolist() != session.truth.movement.tolist()
    assert bytes_of(again.learn()) == bytes_of(model)
    assert not any(hasattr(d, "__dict__") and set(vars(d)) - {"signs", "objects", "hand", "times"}
                   for d in session.demonstrations)  # fmt: skip


def test_demonstrations_in_another_order_are_understood_alike(session: Session, model: ImitationModel) -> None:
    order = np.random.default_rng(1).permutation(12)
    shuffled = DemonstrationSet([session.demonstrations[int(t)] for t in order])
    other = learn(shuffled, session.prototypes, method="paper", policy="knn")
    assert other.labels.tolist() == canonical_labels(model.labels[order]).tolist()
    assert other.focus.tolist() == model.focus[order].tolist()
    assert other.word_order == model.word_order


def test_the_same_seed_gives_the_same_bytes(session: Session, model: ImitationModel, tmp_path: Path) -> None:
    again = session.learn()
    model.save(tmp_path / "a.npz")
    again.save(tmp_path / "b.npz")
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()
    assert bytes_of(session.learn(rng=5)) != bytes_of(model)


def test_inputs_are_not_written_to_and_models_cannot_be(session: Session, model: ImitationModel) -> None:
    before = [d.hand.tobytes() for d in session.demonstrations]
    words = [w.copy() for w in session.say(0, 0)]
    for w in words:
        w.setflags(write=False)
    model.respond(words, SCENE)
    assert [d.hand.tobytes() for d in session.demonstrations] == before
    with pytest.raises(TypeError, match="item assignment"):
        model.diagnostics["distances"] = model.focus  # type: ignore[index]
    for array in (model.labels, model.focus, model.landmarks, *model.diagnostics.values()):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0


@pytest.mark.parametrize("method", ["paper", "paper-literal"])
def test_a_model_answers_the_same_after_a_file(session: Session, tmp_path: Path, method: str) -> None:
    model = session.learn(method)
    model.save(tmp_path / "m.npz")
    again = ImitationModel.load(tmp_path / "m.npz")
    assert bytes_of(again) == bytes_of(model)
    assert again.summary() == model.summary()
    assert (again.method, again.policy_kind) == (method, "knn")
    words = session.say(1, 1)
    a, b = model.respond(words, SCENE), again.respond(words, SCENE)
    assert a[:2] == b[:2]
    assert a.confidence == b.confidence
    assert a.policy(SCENE).tobytes() == b.policy(SCENE).tobytes()
    with pytest.raises(ValueError, match="read-only"):
        again.diagnostics["distances"][...] = 0
    again.save(tmp_path / "again.npz")
    assert (tmp_path / "again.npz").read_bytes() == (tmp_path / "m.npz").read_bytes()


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"labels": None}, "expected an entry 'labels', found none."),
        ({"labels": np.zeros(3)}, "labels: expected numbers of shape (12,), found shape (3,)."),
        ({"labels": np.full(12, 0.5)}, "labels: expected whole numbers, found"),
        ({"labels": np.full(12, 1)}, "labels: expected movements numbered without gaps, found"),
        ({"labels": np.full(12, 12)}, "labels: expected whole numbers from -1 to 11, found"),
        ({"focus": np.full(12, 3)}, "focus: expected whole numbers from -1 to 2, found"),
        ({"focus": np.full(12, np.nan)}, "focus: expected finite numbers, found nan"),
        ({"word_order": np.array([0, 2])}, "word order: expected whole numbers from 0 to 1, found [0, 2]."),
        ({"diagnostics__sign_points": None}, "expected an entry 'sign_points', found none."),
        ({"diagnostics__sign_points": np.zeros((12, 2, 9))}, "sign points: expected numbers of shape (12, 2, 3)"),
        ({"prototypes": None}, "prototypes: expected strokes"),
        ({"prototypes": np.zeros((180, 2))}, "prototype 0: expected points that move, found 60 points in one place."),
        ({"prototype_offsets": np.array([0, 7])}, "offsets of prototypes: expected whole numbers rising from 0 to 180"),
        ({"prototype_offsets": None}, "expected an entry 'prototype_offsets', found none."),
        ({"demonstrations__hand": None}, "expected an array 'hand', found none."),
        ({"demonstrations__objects": np.zeros((12, 3, 3))}, "objects: expected numbers of shape (n, n, 2), found"),
    ],
)
def test_a_model_file_that_lies_is_told_with_its_name_and_field(
    model: ImitationModel, tmp_path: Path, changes: dict[str, Any], sentence: str
) -> None:
    path = tmp_path / "m.npz"
    model.save(path)
    arrays, meta = read_archive(path, "imitation model", 1)
    arrays |= changes
    write_archive(path, "imitation model", 1, {k: v for k, v in arrays.items() if v is not None}, meta)
    with pytest.raises(FileFormatError) as caught:
        ImitationModel.load(path)
    assert str(caught.value).startswith(str(path))
    assert sentence in str(caught.value)


@pytest.mark.parametrize(
    ("meta", "sentence"),
    [
        ({"policy": "knn"}, "expected an entry 'method', found none."),
        ({"policy": "knn", "method": "guess"}, "expected a known method, found 'guess'."),
        ({"policy": "guess", "method": "paper"}, "expected a known policy kind, found 'guess'."),
    ],
)
def test_a_model_file_of_unknown_making_is_told(
    model: ImitationModel, tmp_path: Path, meta: dict[str, str], sentence: str
) -> None:
    path = tmp_path / "m.npz"
    model.save(path)
    write_archive(path, "imitation model", 1, read_archive(path, "imitation model", 1).arrays, meta)
    with pytest.raises(FileFormatError) as caught:
        ImitationModel.load(path)
    assert str(caught.value) == f"{path}: {sentence}"


def test_a_file_of_another_kind_is_not_a_model(session: Session, tmp_path: Path) -> None:
    session.demonstrations.save(tmp_path / "d.npz")
    with pytest.raises(
        FileFormatError, match="expected a signimit imitation model file of version <= 1, found demonst"
    ):
        ImitationModel.load(tmp_path / "d.npz")


@pytest.mark.parametrize("count", [1, 2])
def test_hardly_any_demonstrations_still_give_a_model(session: Session, count: int) -> None:
    model = learn(session.demonstrations[:count], session.prototypes, method="paper", policy="knn")
    response = model.respond(session.say(0, 0), SCENE)
    assert np.isfinite(response.policy(SCENE)).all()
    assert "demonstration" in model.summary()


def test_a_single_object_is_always_the_focus(session: Session) -> None:
    one = [Demonstration(d.signs, d.objects[:1], d.hand, d.times) for d in session.demonstrations]
    model = learn(DemonstrationSet(one), session.prototypes, method="paper", policy="knn")
    assert not model.focus.any()
    assert model.respond(session.say(0, 0), SCENE[:1]).focus == 0


def test_the_same_demonstration_twice_is_no_trouble(session: Session) -> None:
    twice = DemonstrationSet([*session.demonstrations, session.demonstrations[0]])
    model = learn(twice, session.prototypes, method="paper", policy="knn")
    assert model.labels[12] == model.labels[0]
    assert all(np.isfinite(a).all() for a in model.diagnostics.values())


def test_nothing_but_one_demonstration_again_and_again_is_one_movement(session: Session) -> None:
    same = DemonstrationSet([session.demonstrations[0]] * 5)
    model = learn(same, session.prototypes, method="paper", policy="knn")
    assert np.isfinite(model.respond(session.say(0, 0), SCENE).policy(SCENE)).all()


def test_objects_on_top_of_each_other_are_no_trouble(session: Session) -> None:
    stacked = [Demonstration(d.signs, d.objects[[0, 0, 0]], d.hand, d.times) for d in session.demonstrations]
    model = learn(DemonstrationSet(stacked), session.prototypes, method="paper", policy="knn")
    assert np.isfinite(model.respond(session.say(0, 0), SCENE[[0, 0, 0]]).policy(SCENE)).all()


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"demonstrations": [1, 2]}, "demonstrations: expected a DemonstrationSet, found list."),
        (
            {"prototypes": None},
            'prototypes: expected strokes (the paper takes the signs "7", "8" and "9"), found none.',
        ),
        ({"prototypes": []}, "prototypes: expected at least one, found none."),
        ({"prototypes": 3}, "prototypes: expected a list, found int."),
        ({"prototypes": [[[0, 0]]]}, "prototype 0: expected at least 2 points, found 1."),
        ({"prototypes": ["7"]}, "prototype 0: expected numbers of shape (n, 2), found <U1 values."),
        ({"rng": -1}, "rng: expected a numpy Generator or a seed, 0 or more, found -1."),
    ],
)
def test_what_cannot_be_learned_from_is_told(session: Session, changes: dict[str, Any], sentence: str) -> None:
    arguments = {"demonstrations": session.demonstrations, "prototypes": session.prototypes, "method": "paper"}
    with pytest.raises(InvalidInputError) as caught:
        learn(**(arguments | changes))
    assert str(caught.value) == sentence


@pytest.mark.parametrize(("name", "what"), [("method", "method"), ("policy", "policy kind")])
def test_unknown_names_are_told_with_the_known_ones(session: Session, name: str, what: str) -> None:
    arguments: dict[str, Any] = {"method": "paper", "policy": "knn"} | {name: "guess"}
    with pytest.raises(UnknownNameError, match=f"Unknown {what} 'guess'; known are "):
        learn(session.demonstrations, session.prototypes, **arguments)


@pytest.mark.parametrize(
    ("signs", "objects", "sentence"),
    [
        ([[[0, 0], [1, 1]]], SCENE, "signs: expected 2 as in the demonstrations, found 1."),
        ([], SCENE, "signs: expected at least one, found none."),
        (None, SCENE, "signs: expected a list, found NoneType."),
        ([[[0, 0], [1, 1]], [[0, 0]]], SCENE, "sign 1: expected at least 2 points, found 1."),
        (
            [[[0, 0], [1, 1]], [[0, 0], [0, np.nan]]],
            SCENE,
            "sign 1: expected finite numbers, found nan at index (1, 1).",
        ),
        ([[[0, 0], [1, 1]]] * 2, SCENE[:2], "objects: expected numbers of shape (3, 2), found shape (2, 2)."),
        ([[[0, 0], [1, 1]]] * 2, SCENE * 1j, "objects: expected numbers of shape (3, 2), found complex128 values."),
    ],
)
def test_what_cannot_be_answered_is_told(model: ImitationModel, signs: Any, objects: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        model.respond(signs, objects)
    assert str(caught.value) == sentence


def test_a_movement_that_does_not_exist_is_told(model: ImitationModel) -> None:
    with pytest.raises(UnknownNameError, match="Unknown movement 3; known are 0, 1, 2"):
        model.policy(3)
    with pytest.raises(UnknownNameError, match="Unknown movement -1"):
        model.policy(-1)
