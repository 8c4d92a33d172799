"""Demonstrations come back from CSV tables bit for bit; a wrong cell is named by file, line and column."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import signimit as si
from signimit.io.formats import read_csv_demonstrations, write_csv_demonstrations
from signimit.io.formats.csv_tables import read_table, write_table


@pytest.fixture
def demonstrations() -> si.DemonstrationSet:
    rng = np.random.default_rng(0)
    return si.DemonstrationSet(
        si.Demonstration(
            signs=tuple(rng.normal(size=(length, 2)) * 1e3 for length in (3 + number, 7)),
            objects=rng.uniform(-0.3, 0.3, (3, 2)),
            hand=rng.uniform(-0.3, 0.3, (5 + number, 2)),
            times=np.cumsum(rng.uniform(0.01, 0.03, 5 + number)),
        )
        for number in range(3)
    )


def test_demonstrations_come_back_bit_for_bit(demonstrations: si.DemonstrationSet, tmp_path: Path) -> None:
    write_csv_demonstrations(tmp_path / "demos", demonstrations)
    again = read_csv_demonstrations(tmp_path / "demos").to_arrays()
    for name, array in demonstrations.to_arrays().items():
        assert again[name].tobytes() == array.tobytes(), name
        assert again[name].shape == array.shape


@settings(max_examples=100, deadline=None)
@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), min_size=1, max_size=5))
def test_every_finite_number_survives_a_table(tmp_path_factory: pytest.TempPathFactory, values: list[float]) -> None:
    path = tmp_path_factory.mktemp("table") / "t.csv"
    write_table(path, ["n", "x"], list(enumerate(values)))
    rows = list(read_table(path, ["n", "x"]))
    assert [row.whole(0) for row in rows] == list(range(len(values)))
    assert np.array([row.numbers(1)[0] for row in rows]).tobytes() == np.array(values).tobytes()


def test_the_header_names_columns_with_units(demonstrations: si.DemonstrationSet, tmp_path: Path) -> None:
    write_csv_demonstrations(tmp_path / "demos", demonstrations)
    headers = {path.name: path.read_text().partition("\n")[0] for path in (tmp_path / "demos").iterdir()}
    assert headers == {
        "hands.csv": "demonstration,sample,time_s,hand_x_m,hand_y_m",
        "objects.csv": "demonstration,object,x_m,y_m",
        "signs.csv": "demonstration,sign,sample,x_any,y_any",
    }


@pytest.mark.parametrize(
    ("table", "old", "new", "complaint"),
    [
        ("hands.csv", "\n1,0,", "\n1,0,a", "hands.csv, line 7, column time_s: expected a finite number, found 'a0."),
        ("hands.csv", "\n1,0,", "\n1,0,nan", "line 7, column time_s: expected a finite number, found 'nan0."),
        ("hands.csv", "\n1,1,", "\n1,2,", "line 8, column sample: expected 1, found '2'"),
        ("hands.csv", "\n1,0,", "\n2,0,", "line 7, column demonstration: expected 0 or 1, found '2'"),
        ("hands.csv", "\n1,0,", "\n1.0,0,", "line 7, column demonstration: expected a whole number, found '1.0'"),
        ("hands.csv", "time_s", "time_ms", "line 1: expected the columns demonstration,sample,time_s"),
        ("hands.csv", "\n1,0,", "\n1,0,0,", "line 7: expected 5 cells, found 6"),
        ("hands.csv", "\n1,0,", '\n1,0,"', "comma-separated values"),
        ("objects.csv", "\n2,0,", "\n2,0,1e999,", "line 8: expected 4 cells, found 5"),
        ("objects.csv", "\n2,0,", "\n2,0,9", "objects.csv, line 8"),
        ("signs.csv", "\n0,1,0,", "\n0,2,0,", "line 5, column sign: expected 0 or 1, found '2'"),
        ("signs.csv", "\n0,1,0,", "\n0,1,1,", "line 5, column sample: expected 0, found '1'"),
    ],
)
def test_a_wrong_cell_is_named(
    demonstrations: si.DemonstrationSet, tmp_path: Path, table: str, old: str, new: str, complaint: str
) -> None:
    write_csv_demonstrations(tmp_path / "demos", demonstrations)
    path = tmp_path / "demos" / table
    text = path.read_text()
    if complaint == "objects.csv, line 8":  # a number too large for a float
        new, complaint = "\n2,0,1e999\n#", "objects.csv, line 8: expected 4 cells, found 3"
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(si.SignimitError) as refusal:
        read_csv_demonstrations(tmp_path / "demos")
    assert complaint in str(refusal.value)


def test_half_written_tables_are_refused(demonstrations: si.DemonstrationSet, tmp_path: Path) -> None:
    write_csv_demonstrations(tmp_path / "demos", demonstrations)
    path = tmp_path / "demos" / "signs.csv"
    text = path.read_text()
    path.write_text(text[:-5])
    with pytest.raises(si.SignimitError, match="expected a line's end, as whole files have, found the end of the file"):
        read_csv_demonstrations(tmp_path / "demos")
    path.write_text(text[: text.index("\n2,") + 1])
    with pytest.raises(si.SignimitError, match=r"3 in hands\.csv, 3 in objects\.csv, 2 in signs\.csv"):
        read_csv_demonstrations(tmp_path / "demos")
    path.write_text("")
    with pytest.raises(si.SignimitError, match=r"signs\.csv, line 1: expected the columns"):
        read_csv_demonstrations(tmp_path / "demos")
    path.unlink()
    with pytest.raises(FileNotFoundError):
        read_csv_demonstrations(tmp_path / "demos")


def test_a_table_of_a_resting_hand_is_refused_by_demonstration(
    demonstrations: si.DemonstrationSet, tmp_path: Path
) -> None:
    write_csv_demonstrations(tmp_path / "demos", demonstrations[:1])
    (tmp_path / "demos" / "hands.csv").write_text(
        "demonstration,sample,time_s,hand_x_m,hand_y_m\n0,0,0,1,1\n0,1,1,1,1\n"
    )
    with pytest.raises(si.SignimitError, match="demos: demonstration 0: hand: expected points that move"):
        read_csv_demonstrations(tmp_path / "demos")
