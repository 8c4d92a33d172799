"""Demonstrations: exactly what the imitator may see, checked where it comes in, the same after a file."""

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from signimit import Demonstration, DemonstrationSet, FileFormatError, InvalidInputError
from signimit.io.archive import write_archive

SIGN = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
HAND = np.array([[0.0, 0.0], [0.1, 0.0], [0.1, 0.1], [0.0, 0.1]])
OBJECTS = np.array([[0.1, 0.2], [-0.1, 0.0]])
WHOLE: dict[str, Any] = {"signs": (SIGN, 2 * SIGN[:2]), "objects": OBJECTS, "hand": HAND, "times": np.arange(4.0)}


def demonstration(**changes: Any) -> Demonstration:
    return Demonstration(**(WHOLE | changes))


@pytest.fixture
def demonstrations() -> DemonstrationSet:
    return DemonstrationSet([demonstration(), demonstration(hand=HAND[:3], times=np.arange(3.0) / 7)])


def test_nothing_but_signs_objects_hand_and_times_can_be_seen() -> None:
    assert [f.name for f in dataclasses.fields(Demonstration)] == ["signs", "objects", "hand", "times"]
    assert [f.name for f in dataclasses.fields(DemonstrationSet)] == ["demonstrations", "object_names"]


def test_nothing_can_be_hung_on_a_demonstration() -> None:
    with pytest.raises(dataclasses.FrozenInstanceError):
        demonstration().label = "circle"  # type: ignore[attr-defined]
    with pytest.raises(ValueError, match="read-only"):
        demonstration().objects[0, 0] = 1.0


def test_inputs_are_copied() -> None:
    hand = HAND.copy()
    made = demonstration(hand=hand)
    hand[:] = 7.0
    assert made.hand.tolist() == HAND.tolist()


def test_lists_and_read_only_arrays_will_do() -> None:
    hand = HAND.copy()
    hand.setflags(write=False)
    made = demonstration(signs=[SIGN.tolist()], objects=OBJECTS.tolist(), hand=hand, times=[0, 1, 2, 3])
    assert made.signs[0].tolist() == SIGN.tolist()


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"signs": ()}, "signs: expected at least one, found none."),
        ({"signs": "45"}, "signs: expected a list, found str."),
        ({"signs": None}, "signs: expected a list, found NoneType."),
        ({"signs": (SIGN, SIGN[:1])}, "sign 1: expected at least 2 points, found 1."),
        ({"signs": (SIGN, SIGN * 0)}, "sign 1: expected points that move, found 3 points in one place."),
        ({"signs": SIGN}, "sign 0: expected numbers of shape (n, 2), found shape (2,)."),
        ({"signs": (SIGN * 1j,)}, "sign 0: expected numbers of shape (n, 2), found complex128 values."),
        ({"objects": []}, "objects: expected numbers of shape (n, 2), found shape (0,)."),
        ({"objects": np.zeros((0, 2))}, "objects: expected at least one position, found none."),
        ({"objects": [0.1, 0.2]}, "objects: expected numbers of shape (n, 2), found shape (2,)."),
        ({"hand": np.ones((4, 2))}, "hand: expected points that move, found 4 points in one place."),
        ({"hand": np.full((4, 2), np.nan)}, "hand: expected finite numbers, found nan at index (0, 0)."),
        ({"hand": np.ones((4, 3))}, "hand: expected numbers of shape (n, 2), found shape (4, 3)."),
        ({"hand": [[0, 0], [1]]}, "hand: expected numbers of shape (n, 2), found list that is not such an array."),
        ({"hand": [[0, 0], [1, 0], [2, 0], [501, 0]]}, "hand: expected numbers within 500, found 501 at index (3, 0)."),
        ({"objects": [[0.1, 1e9]]}, "objects: expected numbers within 500, found 1e+09 at index (0, 1)."),
        ({"hand": 1e-11 * np.eye(4)[:, :2]}, "hand: expected points that move, found 4 points in one place."),
        ({"times": [0.0, 1.0, 1.0, 2.0]}, "times: expected strictly increasing seconds, found 1 then 1 at index 1."),
        ({"times": np.arange(3.0)}, "times: expected numbers of shape (4,), found shape (3,)."),
        ({"times": ["a", "b", "c", "d"]}, "times: expected numbers of shape (4,), found <U1 values."),
    ],
)
def test_a_bad_demonstration_names_its_field(changes: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        demonstration(**changes)
    assert str(caught.value) == sentence


@pytest.mark.parametrize(
    ("items", "sentence"),
    [
        ([], "demonstration set: expected at least one, found none."),
        (5, "demonstration set: expected a list, found int."),
        ([WHOLE], "demonstration 0: expected a Demonstration, found dict."),
        ([demonstration(), demonstration(signs=[SIGN])],
         "demonstration 1: signs: expected 2 as in demonstration 0, found 1."),
        ([demonstration(), demonstration(objects=OBJECTS[:1])],
         "demonstration 1: objects: expected 2 as in demonstration 0, found 1."),
    ],
)  # fmt: skip
def test_a_set_is_of_one_language_and_one_number_of_objects(items: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        DemonstrationSet(items)
    assert str(caught.value) == sentence


def test_a_set_is_a_sequence_with_arrays(demonstrations: DemonstrationSet) -> None:
    assert len(demonstrations) == 2
    assert list(demonstrations)[1] is demonstrations[1]
    assert isinstance(demonstrations[:1], DemonstrationSet)
    assert demonstrations.objects.shape == (2, 2, 2)
    assert [p.shape for p in demonstrations.paths] == [(4, 2), (3, 2)]
    assert [t.shape for t in demonstrations.times] == [(4,), (3,)]
    assert [len(u) for u in demonstrations.signs] == [2, 2]


def test_a_set_comes_back_from_its_file(demonstrations: DemonstrationSet, tmp_path: Path) -> None:
    demonstrations.save(tmp_path / "d.npz")
    again = DemonstrationSet.load(tmp_path / "d.npz")
    for a, b in zip(again, demonstrations, strict=True):
        for field in ("objects", "hand", "times"):
            assert getattr(a, field).tobytes() == getattr(b, field).tobytes()
        assert [s.tobytes() for s in a.signs] == [s.tobytes() for s in b.signs]
    again.save(tmp_path / "again.npz")
    assert (tmp_path / "again.npz").read_bytes() == (tmp_path / "d.npz").read_bytes()


def test_a_file_that_version_0_1_wrote_is_read() -> None:
    (only,) = DemonstrationSet.load(Path(__file__).parent / "data" / "demonstrations-1.npz")
    assert [s.tolist() for s in only.signs] == [[[0, 0], [0, 1]]]
    assert only.objects.tolist() == [[1, 2]]
    assert only.hand.tolist() == [[0, 0], [0.5, 0], [0.5, 0.25]]
    assert only.times.tolist() == [0, 0.5, 1]


def test_the_file_holds_nothing_but_what_may_be_seen(demonstrations: DemonstrationSet) -> None:
    assert sorted(demonstrations.to_arrays()) == ["hand", "hand_offsets", "objects", "sign_offsets", "signs", "times"]


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"objects": None}, "expected an array 'objects', found none."),
        ({"sign_offsets": None}, "expected an array 'sign_offsets', found none."),
        ({"objects": np.zeros((3, 2, 2))}, "demonstrations: expected objects and signs for 2 hands, found 3 and 4."),
        ({"objects": np.zeros((2, 4))}, "objects: expected numbers of shape (n, n, 2), found shape (2, 4)."),
        ({"objects": np.zeros((2, 0, 2))}, "demonstration 0: objects: expected at least one position, found none."),
        ({"hand": np.zeros((7, 2))}, "demonstration 0: hand: expected points that move, found 4 points in one place."),
        (
            {"times": np.array([0, 1, 2, 3, 0, 1, np.nan])},
            "demonstration 1: times: expected finite numbers, found nan at index (2).",
        ),
        ({"times": np.array([0.0, 1, 2, 3, 0, 2, 1])}, "demonstration 1: times: expected strictly increasing seconds, "
         "found 2 then 1 at index 1."),
        ({"hand_offsets": np.array([0, 4, 8])},
         "offsets of hand: expected whole numbers rising from 0 to 7, found [0, 4, 8]."),
        ({"sign_offsets": np.array([0, 3, 5, 8])},
         "offsets of signs: expected whole numbers rising from 0 to 10, found [0, 3, 5, 8]."),
        ({"sign_offsets": np.array([0, 5, 8, 10, 10])},
         "demonstration 1: sign 1: expected at least 2 points, found 0."),
        ({"sign_offsets": np.array([0, 5, 10, 10])},
         "demonstrations: expected objects and signs for 2 hands, found 2 and 3."),
        ({"signs": np.array(3.0)}, "signs: expected numbers of shape (n, 2), found shape ()."),
        ({"hand": np.full((7, 2), "x")}, "hand: expected numbers of shape (n, 2), found <U1 values."),
        ({"hand": np.zeros((0, 2)), "times": np.zeros(0), "hand_offsets": np.array([0]), "objects": np.zeros((0, 2, 2)),
          "signs": np.zeros((0, 2)), "sign_offsets": np.array([0])},
         "demonstration set: expected at least one, found none."),
    ],
)  # fmt: skip
def test_a_file_that_lies_is_told_with_file_demonstration_and_field(
    demonstrations: DemonstrationSet, tmp_path: Path, changes: dict[str, Any], sentence: str
) -> None:
    arrays = demonstrations.to_arrays() | changes
    path = tmp_path / "d.npz"
    write_archive(path, "demonstration set", 1, {k: v for k, v in arrays.items() if v is not None})
    with pytest.raises(FileFormatError) as caught:
        DemonstrationSet.load(path)
    assert str(caught.value) == f"{path}: {sentence}"


def test_sizes_are_shown_not_arrays(demonstrations: DemonstrationSet) -> None:
    assert repr(demonstrations[1]) == "Demonstration(signs=2, objects=2, samples=3)"
    assert repr(demonstrations) == "DemonstrationSet(2 demonstrations, signs=2, objects=2)"
