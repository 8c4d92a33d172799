"""Reports of imports: every drawing is in one row, every finding in one line."""

from pathlib import Path

from signimit import FileFormatError
from signimit.io.formats.import_report import FileReport, Finding, ImportReport

JITTER = "time stamps that step back: lifted"
DOT = FileFormatError("b.xml: drawing 2", "at least 2 points", "1")
REPORT = ImportReport(
    (
        FileReport(Path("a.xml"), "dollar", 3),
        FileReport(Path("b.xml"), "dollar", 2, (Finding("b.xml: drawing 0", JITTER, 2),), (DOT,)),
        FileReport(Path("c.xml"), "dollar", 1, (Finding("c.xml", JITTER, 5), Finding("c.xml", "an accent"))),
        FileReport(
            Path("d.dat"), "unipen", 4, [Finding(f"d.dat: line {i}", "even pace", 1, "assumed") for i in range(4)]
        ),
        FileReport(Path("README"), None, passed_over="not a drawing"),
    )
)


def test_the_table_adds_up_files_drawings_and_findings() -> None:
    assert REPORT.table() == (
        "               files  drawings\n"
        "read               2         8\n"
        "repaired           1         2\n"
        "left out           1         1\n"
        "not a drawing      1         0\n"
        "repaired: time stamps that step back: lifted (7 in 2 places)\n"
        "assumed: even pace (4 in 4 places)\n"
        "repaired: an accent (1 in 1 places)\n"
        "left out: b.xml: drawing 2: expected at least 2 points, found 1."
    )


def test_all_that_was_left_out_is_named() -> None:
    files = tuple(FileReport(Path(f"{i}"), None, left_out=(DOT,)) for i in range(30))
    assert ImportReport(files).table().splitlines()[-30:] == [f"left out: {DOT}"] * 30


def test_the_summary_names_the_first_that_was_left_out_or_else_repaired() -> None:
    sentence = (
        "drawings: 10 read, 2 of them repaired, 1 left out; the first: b.xml: drawing 2: expected at least 2 points"
    )
    assert REPORT.summary().startswith(sentence)
    sentence = "drawings: 1 read, 1 of them repaired, 0 left out; the first: c.xml: time stamps that step back: lifted."
    assert ImportReport(REPORT.files[2:3]).summary() == sentence


def test_assumptions_are_no_flaws() -> None:
    assert not REPORT.flawless
    assert ImportReport((REPORT.files[0], *REPORT.files[3:])).flawless
    assert [file.status for file in REPORT.files] == ["read", "left out", "repaired", "read", "not a drawing"]
    assert REPORT.left_out == (DOT,)
