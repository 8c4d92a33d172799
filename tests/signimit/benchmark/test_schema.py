"""What a record and a summary must hold, so that tables can be made of them, and the sentence where it does not."""

from __future__ import annotations

from typing import Any

import pytest

from signimit.benchmark.schema import check_record, check_summary
from signimit.exceptions import InvalidInputError

RECORD: dict[str, Any] = {
    **{"split": "paper", "seed": 0, "session": "00", "code": "c0de", "demonstrations": 12, "groups": 1.0, "order": 1.0},
    **{"focus": 0.5, "obeyed": [1, 0], "misfit": [0.1, 3.0], "read": [2, 1], "families": [0, 0], "seconds": {"act": 1}},
}
ESTIMATE = {"mean": 0.5, "low": 0.1, "high": 0.9, "total": 1.0, "count": 2}
SPLIT: dict[str, Any] = {
    **{
        "sha256": "5ha",
        "sessions_sha256": "5ha",
        "seeds": [[0, 0]],
        "sessions": 1,
        "demonstrations": 12,
        "commands": 2,
    },
    **{"seconds": 1.0, "stages": {"obeyed": ESTIMATE, "groups": ESTIMATE}},
}
SUMMARY: dict[str, Any] = {
    **{"entry": "e", "title": "t", "code": "c0de", "source": None, "oracle": False, "judge": "j", "all": ESTIMATE},
    "splits": {"paper": SPLIT},
}


def test_whole_records_and_summaries_pass() -> None:
    check_record(RECORD)
    check_record(
        {key: RECORD[key] for key in ("split", "seed", "code", "demonstrations", "obeyed", "misfit", "seconds")}
    )
    check_summary(SUMMARY)
    check_summary({**SUMMARY, "splits": {}, "all": None})


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"split": []}, "split: expected one of paper, "),
        ({"seed": 1.0}, "seed: expected a whole number, 0 or more, found 1.0."),
        ({"seed": True}, "seed: expected a whole number, 0 or more, found True."),
        ({"session": 3}, "session: expected text, found int."),
        ({"code": "\ud800"}, "code: expected text in Unicode"),
        ({"demonstrations": -1}, "demonstrations: expected a whole number"),
        ({"obeyed": [], "misfit": []}, "obeyed: expected a score for each command, found none."),
        ({"obeyed": ["1", "0"]}, "obeyed: expected numbers of shape (n,)"),
        ({"obeyed": [2, 0]}, "obeyed: expected numbers within 1, found 2"),
        ({"misfit": [0.1]}, "misfit: expected numbers of shape (2,)"),
        ({"misfit": [0.1, 1e308]}, "misfit: expected numbers within 3"),
        ({"misfit": [0.1, -1]}, "misfit: expected numbers from 0 to 3, found less."),
        ({"groups": "1"}, "groups: expected numbers of shape ()"),
        ({"families": [0.5, 1]}, "families: expected whole numbers"),
        ({"seconds": 3}, "seconds: expected a JSON object, found 3."),
        ({"seconds": {"act": None}}, "seconds: act: expected numbers"),
    ],
)
def test_an_entry_of_a_record_that_is_something_else_is_named(changes: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InvalidInputError) as error:
        check_record({**RECORD, **changes})
    assert str(error.value).startswith(sentence)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"title": None}, "title: expected text, found NoneType."),
        ({"oracle": "no"}, "oracle: expected true or false"),
        ({"judge": [1]}, "judge: expected text, found list."),
        ({"all": 0.5}, "all: expected a JSON object"),
        ({"splits": []}, "splits: expected a JSON object"),
        ({"splits": {"nowhere": SPLIT}}, "split: expected one of paper"),
        ({"splits": {"paper": {**SPLIT, "sessions": "1"}}}, "paper: sessions: expected a whole number"),
        ({"splits": {"paper": {**SPLIT, "seconds": float("nan")}}}, "paper: seconds: expected finite numbers"),
        ({"splits": {"paper": {**SPLIT, "stages": {}}}}, "summary: expected an entry 'obeyed', found none."),
        ({"splits": {"paper": {**SPLIT, "stages": {"obeyed": {}}}}}, "summary: expected an entry 'mean', found none."),
    ],
)
def test_an_entry_of_a_summary_that_is_something_else_is_named(changes: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InvalidInputError) as error:
        check_summary({**SUMMARY, **changes})
    assert str(error.value).startswith(sentence)


@pytest.mark.parametrize("name", ["entry", "title", "code", "oracle", "splits"])
def test_a_summary_without_an_entry_is_told_which(name: str) -> None:
    with pytest.raises(InvalidInputError, match=f"expected an entry '{name}'"):
        check_summary({key: value for key, value in SUMMARY.items() if key != name})
