"""Sessions go out as files and come back the same; files of strangers are refused in a sentence."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from signimit import PAPER_LANGUAGE, DemonstrationSet, InvalidInputError, Stroke, StrokeLibrary, learn
from signimit.teaching.languages import Request
from signimit_envs.studio.limits import Limits
from signimit_envs.studio.page.exports import FORMATS, Lesson, export_bytes, import_bytes, to_library
from signimit_envs.studio.store.events import DrawnDemonstration

pytest.importorskip("defusedxml", reason="InkML needs signimit[strokes]")
Make = Callable[[], DrawnDemonstration]


@pytest.mark.parametrize("name", FORMATS)
def test_demonstrations_come_back_to_the_last_bit(name: str, shown: Make) -> None:
    there = [shown(), replace(shown(), prompt=Request(2, 1))]
    back = import_bytes(
        name,
        export_bytes(name, Lesson(there, PAPER_LANGUAGE, learn(DemonstrationSet(one.demonstration for one in there)))),
    )
    assert len(back) == 2
    for one, other in zip(there, back, strict=True):
        for a, b in zip((*one.signs, one.hand), (*other.signs, other.hand), strict=True):
            np.testing.assert_array_equal(a.points, b.points)
        np.testing.assert_array_equal(one.objects, other.objects)
        np.testing.assert_array_equal(one.hand.times, other.hand.times)
        if name not in ("demonstrations.npz", "model.npz"):  # which has no times of signs
            np.testing.assert_array_equal(one.signs[0].times, other.signs[0].times)


def test_strokes_are_labelled_by_what_was_asked_for(shown: Make) -> None:
    library = to_library([shown(), replace(shown(), prompt=Request(2, 1))], PAPER_LANGUAGE)
    assert library.labels == ("sign 1", "sign 2", "objects", "movement", "2", "6", "objects", "circle")


def test_nothing_cannot_be_exported() -> None:
    with pytest.raises(InvalidInputError, match="at least one demonstration"):
        export_bytes("strokes.csv", Lesson([], None, None))


def test_a_model_that_could_not_be_learned_cannot_be_exported(shown: Make) -> None:
    with pytest.raises(InvalidInputError, match="demonstrations that can be learned from"):
        export_bytes("model.npz", Lesson([shown()], None, None))


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize("content", [b"", b"nonsense", b"PK\x03\x04nonsense", b"<ink/>", b"\xff" * 100, b"a,b\n1,2\n"])
def test_what_is_no_such_file_is_refused_in_a_sentence(name: str, content: bytes) -> None:
    with pytest.raises(InvalidInputError) as error:
        import_bytes(name, content)
    assert "/tmp" not in str(error.value)


def test_a_csv_with_holes_names_the_stroke(shown: Make) -> None:
    lines = export_bytes("strokes.csv", Lesson([shown()], None, None)).decode().splitlines()
    lines[3] = lines[3].rpartition(",")[0] + ",never"
    with pytest.raises(InvalidInputError, match="stroke 0: expected points that move"):
        import_bytes("strokes.csv", "\n".join(lines).encode())


def test_strokes_in_another_order_are_no_demonstrations(shown: Make, tmp_path: Path) -> None:
    library = to_library([shown()], None)
    shuffled = StrokeLibrary(library.strokes, library.labels[::-1], library.writers, library.source)
    shuffled.save(tmp_path / "s.npz")
    with pytest.raises(InvalidInputError, match="again and again"):
        import_bytes("strokes.npz", (tmp_path / "s.npz").read_bytes())


def test_an_archive_that_unpacks_to_too_much_is_not_unpacked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("signimit_envs.studio.page.exports.LIMITS", Limits(unpacked=2**20))
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive, archive.open("a.npy", "w") as member:
        member.write(bytes(2**20 + 1))
    with pytest.raises(InvalidInputError, match="bytes unpacked"):
        import_bytes("demonstrations.npz", content.getvalue())


_HEAD, _INK = "stroke,label,writer,x,y,t\n", '<ink xmlns="http://www.w3.org/2003/InkML">{}</ink>'


@pytest.mark.parametrize(
    ("name", "text", "told"),
    [
        ("strokes.csv", _HEAD + "0,a,b,1,1,1\n" * 300_000, "stroke 0: expected at most 5000 points, found more"),
        ("strokes.csv", _HEAD + "".join(f"{n},a,b,1,1,1\n{n},a,b,2,2,2\n" for n in range(500)), "at most 400 strokes"),
        ("strokes.inkml", _INK.format("<trace>1 1,2 2</trace>" * 100_000), "at most 20000 tags, found more"),
        ("strokes.inkml", _INK.format("<a>" * 1_000_000), "at most 20000 tags, found more"),
        ("strokes.inkml", _INK.format(f"<trace>{'1 1,' * 3_000_000}</trace>"), "at most 8388608 bytes; an archive may"),
    ],
)
def test_a_text_that_would_take_too_much_memory_is_refused_soon(name: str, text: str, told: str) -> None:
    with pytest.raises(InvalidInputError, match=told):
        import_bytes(name, text.encode())


def test_a_whole_session_of_long_strokes_is_not_too_much() -> None:
    times, turn = np.arange(300) / 60, np.linspace(0, 6, 300)[:, None]
    stroke = Stroke(np.hstack([np.sin(turn), np.cos(turn) / 3]), times)
    objects = np.array([[0.1, 0.1], [-0.1, 0.1], [0.0, -0.2]])
    session = [DrawnDemonstration((stroke, stroke), objects, stroke)] * 100
    for name in FORMATS.keys() - {"model.npz"}:
        assert len(import_bytes(name, export_bytes(name, Lesson(session, None, None)))) == 100


def test_an_archive_with_a_name_in_no_encoding_is_refused_in_a_sentence() -> None:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        archive.writestr("é.npy", b"")
    with pytest.raises(InvalidInputError, match="expected a whole archive, found a broken one"):
        import_bytes("strokes.npz", buffer.getvalue().replace("é".encode(), b"\xff\xff"))


def test_more_than_could_have_been_drawn_here_is_refused(shown: Make) -> None:
    far = replace(shown(), objects=np.full((3, 2), 50.0) + np.arange(6).reshape(3, 2))
    with pytest.raises(InvalidInputError, match="demonstration 1: expected objects and hand within"):
        import_bytes("strokes.csv", export_bytes("strokes.csv", Lesson([far], None, None)))
    many = [shown()] * 101
    with pytest.raises(InvalidInputError, match="at most 100 demonstrations"):
        import_bytes("demonstrations.npz", export_bytes("demonstrations.npz", Lesson(many, None, None)))


@pytest.mark.parametrize("name", [name for name in FORMATS if name.startswith("strokes")])
def test_demonstrations_of_different_tables_are_no_session(name: str, shown: Make) -> None:
    two = replace(shown(), objects=shown().objects[:2])
    with pytest.raises(InvalidInputError, match="demonstration 1: objects: expected 3 as in demonstration 0, found 2"):
        import_bytes(name, export_bytes(name, Lesson([shown(), two], None, None)))
