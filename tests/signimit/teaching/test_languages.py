"""Languages: the paper's, and those that are none."""

import pytest

from signimit import InvalidInputError
from signimit.teaching.languages import PAPER_LANGUAGE, Language, Request


def test_the_papers_language_shows_six_of_nine_requests_and_holds_back_the_diagonal() -> None:
    assert PAPER_LANGUAGE.words == 2
    assert PAPER_LANGUAGE.objects == 3
    assert len(PAPER_LANGUAGE.requests) == 9
    assert PAPER_LANGUAGE.held_back == {(0, 0), (1, 1), (2, 2)}
    assert PAPER_LANGUAGE.seen == ((0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1))


def test_what_is_held_back_can_be_chosen() -> None:
    language = Language(unseen=(Request(0, 2),))
    assert language.held_back == {(0, 2)}
    assert len(language.seen) == 8


def test_a_single_object_holds_nothing_back() -> None:
    assert len(Language(focus_signs=("1",)).seen) == 3


def test_several_fillers_take_the_places_that_are_left() -> None:
    language = Language(filler_signs=("0", "9"), fillers=4, focus_word=1, movement_word=4)
    assert language.words == 6
    with pytest.raises(InvalidInputError, match="language: fillers: expected at least 1; no filler_signs, no fillers"):
        Language(filler_signs=("0",), fillers=0)
    with pytest.raises(InvalidInputError, match="two places out of"):
        Language(filler_signs=("0",), fillers=2, focus_word=0, movement_word=4)


def test_a_filler_makes_three_words() -> None:
    assert Language(filler_signs=("0",), focus_word=2, movement_word=0).words == 3


@pytest.mark.parametrize(
    ("fields", "match"),
    [
        ({"movement_signs": ("4", "5")}, "movement_signs: expected 3, one a movement, found 2"),
        ({"focus_word": 1}, "focus_word, movement_word: expected two places out of"),
        ({"focus_word": 2}, "focus_word, movement_word"),
        ({"focus_signs": ()}, "at least one object"),
        ({"repetitions": 0}, "at least one demonstration"),
        (
            {"focus_signs": ("1",), "unseen": (Request(0, 0), Request(1, 0), Request(2, 0))},
            "at least one demonstration",
        ),
    ],
)
def test_what_is_no_language_is_refused(fields: dict[str, object], match: str) -> None:
    with pytest.raises(InvalidInputError, match=match):
        Language(**fields)  # type: ignore[arg-type]


def test_the_signs_of_a_language_come_once_each() -> None:
    assert PAPER_LANGUAGE.signs == tuple("123456789")
