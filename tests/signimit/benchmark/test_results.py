"""Results survive kills, and never mix with results of something else."""

import json
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import pytest

from signimit.benchmark.entries import EntrantReference
from signimit.benchmark.judge import judge_hash
from signimit.benchmark.results import (
    EARLIER,
    ResultFile,
    Summary,
    installed_versions,
    read_comparable_summaries,
    read_summaries,
    records_digest,
    run_missing,
    summarise,
    write_summary,
)
from signimit.benchmark.running import SessionTask, code_hash
from signimit.exceptions import FileFormatError
from signimit.io.safe_files import Record


def record_of(task: SessionTask, **changes: object) -> Record:
    facts = {"split": task.split, "seed": task.seed, "session": "0", "code": code_hash(), "demonstrations": 6}
    scores = {"groups": 1.0, "obeyed": [1, int(task.seed > 0)], "misfit": [0.1, 0.2], "seconds": {"act": 0.5}}
    return {**facts, **scores, **changes}


def engine(tasks: Iterable[SessionTask]) -> Iterator[Record]:
    """Answers at once, in another order than asked."""
    for task in reversed(list(tasks)):
        yield record_of(task)


@pytest.fixture
def file(tmp_path: Path, still: EntrantReference) -> ResultFile:
    return ResultFile(tmp_path / "new", still)


def run(file: ResultFile, seeds: Iterable[int]) -> list[Record]:
    return list(run_missing(file, ["paper", "few"], seeds, engine))


def test_only_what_is_missing_is_run(file: ResultFile) -> None:
    assert len(run(file, range(3))) == 6
    assert run(file, range(3)) == []
    assert [(r["split"], r["seed"]) for r in run(file, range(4))] == [("few", 3), ("paper", 3)]
    assert [(r["split"], r["seed"]) for r in file.read()] == [(s, n) for s in ("paper", "few") for n in range(4)]


def test_a_torn_last_line_is_run_again(file: ResultFile) -> None:
    run(file, range(2))
    whole = file.records.read_bytes()
    file.records.write_bytes(whole[:-20])
    assert len(run(file, range(2))) == 1
    assert len(file.read()) == 4


def test_a_torn_first_line_is_written_again(file: ResultFile) -> None:
    file.folder.mkdir()
    file.records.write_bytes(b'{"format": "signi')
    assert len(run(file, [0])) == 2
    assert len(file.read()) == 2


@pytest.mark.parametrize(
    ("key", "value", "sentence"),
    [
        ("version", 2, r"expected version 1; give another --out, or move the file away, found 2\."),
        ("code", "abc", r'expected code "\w{16}"; give another --out, or move the file away, found "abc"\.'),
        ("source", "abc", r'expected source "\w+\.\.\. \(SHA-256 \w{8}\); give'),
        ("splits", {"paper": "0"}, r"expected splits .*, found \{\"paper\": \"0\"\}\."),
        ("format", None, r'expected format "signimit benchmark results"; give .*, found null\.'),
    ],
)
def test_results_of_something_else_are_refused_and_left_alone(
    file: ResultFile, key: str, value: object, sentence: str
) -> None:
    run(file, [0])
    header, *lines = file.records.read_text().splitlines()
    changed = "\n".join([json.dumps(json.loads(header) | {key: value}), *lines]) + "\n"
    file.records.write_text(changed)
    with pytest.raises(FileFormatError, match=sentence):
        run(file, range(2))
    assert file.records.read_text() == changed


def test_a_file_of_before_a_split_was_added_goes_on(file: ResultFile) -> None:
    run(file, [0])
    header, *lines = file.records.read_text().splitlines()
    fewer = json.loads(header)
    del fewer["splits"]["mouse"]
    file.records.write_text("\n".join([json.dumps(fewer), *lines]) + "\n")
    assert len(run(file, range(2))) == 2
    assert len(file.read()) == 4


def test_a_line_that_is_no_record_is_named(file: ResultFile) -> None:
    run(file, [0])
    with file.records.open("a") as out:
        out.write("[1, 2]\nmore\n")
    with pytest.raises(FileFormatError, match=r"jsonl: line 4: expected a JSON object, found '\[1, 2\]'"):
        file.read()


def test_an_engine_that_cannot_start_leaves_nothing_behind(file: ResultFile) -> None:
    def unreachable(tasks: Iterable[SessionTask]) -> Iterator[Record]:
        yield from ()
        raise OSError("nobody there")

    with pytest.raises(OSError, match="nobody there"):
        list(run_missing(file, ["few"], [0], unreachable))
    assert not file.folder.exists()


def test_a_record_that_lacks_something_is_named(file: ResultFile) -> None:
    run(file, [0])
    with file.records.open("a") as out:
        out.write('{"split": "few"}\n')
    with pytest.raises(FileFormatError, match=r"jsonl: line 4: expected a record with code, demonstrations, "):
        file.read()


def test_a_worker_with_other_code_is_refused_and_what_came_before_is_kept(file: ResultFile) -> None:
    def mixed(tasks: Iterable[SessionTask]) -> Iterator[Record]:
        first, second, *_ = tasks
        yield record_of(first)
        yield record_of(second, code="abc")

    with pytest.raises(FileFormatError, match=r"record of a worker: expected code \w{16}, found abc\."):
        list(run_missing(file, ["paper", "few"], [0], mixed))
    assert len(file.read()) == 1


def test_a_summary_counts_what_is_there(file: ResultFile) -> None:
    run(file, [0, 1, 2, 5])
    summary = write_summary(file)
    assert json.loads(file.summary.read_text()) == summary == read_summaries(file.folder)[0]
    few = summary["splits"]["few"]
    assert list(summary["splits"]) == ["paper", "few"]
    assert (few["sessions"], few["seeds"], few["commands"], few["demonstrations"]) == (4, [[0, 2], [5, 5]], 8, 24)
    assert (few["stages"]["obeyed"]["total"], few["stages"]["obeyed"]["count"]) == (7, 8)
    assert set(few["stages"]) == {"groups", "obeyed", "misfit"}
    assert few["seconds"] == 2.0
    assert summary["code"] == code_hash()
    assert summary["oracle"] is False
    assert {"numpy", "python", "scipy", "signimit", "machine"} <= set(summary["versions"])


def test_the_digest_knows_results_but_neither_time_nor_order(file: ResultFile, tmp_path: Path) -> None:
    other = ResultFile(tmp_path / "other", file.entrant)
    run(file, range(3))
    for seed in (2, 0, 1):
        for record in run_missing(other, ["few", "paper"], [seed], engine):
            assert record["seed"] == seed
    assert summarise(other)["digest"] == summarise(file)["digest"]
    records = file.read()
    assert records_digest([r | {"seconds": {}, "code": "abc"} for r in records]) == records_digest(records)
    assert records_digest([records[0] | {"misfit": [0.1, 0.2000001]}, *records[1:]]) != records_digest(records)


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("{", "something else"),
        ("[]", "something else"),
        ('{"format": "signimit benchmark results", "version": 9}', "signimit benchmark results version 9"),
    ],
)
def test_a_summary_of_another_version_is_refused(tmp_path: Path, text: str, found: str) -> None:
    (tmp_path / "new.json").write_text(text)
    with pytest.raises(FileFormatError, match=f"expected signimit benchmark results version 1, found {found}"):
        read_summaries(tmp_path)


def rows_of(folder: Path, entry: EntrantReference, seeds: dict[str, Iterable[int]]) -> None:
    """Run two entries, each on its seeds, and write their summaries."""
    for name, numbers in seeds.items():
        file = ResultFile(folder, entry._replace(name=name + ".py:Still"))
        run(file, numbers)
        write_summary(file)


def change_row(folder: Path, name: str, change: Callable[[Summary], object]) -> None:
    path = folder / f"{name}.py-Still.json"
    summary = json.loads(path.read_text())
    change(summary)
    path.write_text(json.dumps(summary))


def test_rows_of_one_judge_and_the_same_sessions_stand_in_one_table(tmp_path: Path, still: EntrantReference) -> None:
    rows_of(tmp_path, still, {"a": range(3), "b": range(3)})
    assert [row["judge"] for row in read_comparable_summaries(tmp_path)] == [judge_hash()] * 2
    change_row(tmp_path, "b", lambda row: row.update(code="other", source="other"))  # shown, not compared
    assert len(read_comparable_summaries(tmp_path)) == 2


@pytest.mark.parametrize(
    ("change", "found"),
    [
        (lambda row: row.pop("judge"), "found none, as in version 0.1.0."),
        (lambda row: row.update(judge="abc"), "found judge abc."),
        (lambda row: row["splits"]["few"].update(sha256="0123"), "found 0123."),
        (lambda row: row["splits"]["few"].update(sessions_sha256="0", sessions=2), r"found others, seeds [[0, 2]]."),
    ],
)
def test_a_row_of_another_judge_or_of_other_sessions_is_refused_with_the_remedy(
    tmp_path: Path, still: EntrantReference, change: Callable[[Summary], object], found: str
) -> None:
    rows_of(tmp_path, still, {"a": range(3), "b": range(3)})
    change_row(tmp_path, "b", change)
    with pytest.raises(FileFormatError) as refused:
        read_comparable_summaries(tmp_path)
    assert str(refused.value).startswith(f"{tmp_path / 'b.py-Still.json'}: expected ")
    assert f"then `benchmark run --entry b.py:Still --out {tmp_path}` runs it" in str(refused.value)
    assert str(refused.value).endswith(found)


def test_the_mean_over_splits_has_the_interval_of_people_who_are_the_same_in_all(file: ResultFile) -> None:
    run(file, range(20))
    every = write_summary(file)["all"]
    assert every["mean"] == pytest.approx(39 / 40)  # in session 0 one command of two is not obeyed
    assert (every["count"], every["low"] < every["mean"] < every["high"]) == (80, True)
    list(run_missing(file, ["few"], [20], engine))
    assert write_summary(file)["all"] is None


def test_rows_of_learners_that_are_gone_stay_in_the_table(tmp_path: Path, still: EntrantReference) -> None:
    rows_of(tmp_path, still, {"a": range(3)})
    rows_of(tmp_path / EARLIER, still, {"old": range(3)})
    assert [row["entry"] for row in read_comparable_summaries(tmp_path)] == ["a.py:Still", "old.py:Still"]
    change_row(tmp_path / EARLIER, "old", lambda row: row.update(judge="abc"))
    with pytest.raises(FileFormatError, match=rf"{EARLIER}/old.py-Still.json: .* --out {tmp_path / EARLIER}` runs it"):
        read_comparable_summaries(tmp_path)


def test_an_entry_of_a_package_is_known_by_all_its_modules(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "their_learner"
    package.mkdir()
    for name, text in {"__init__": "", "entry": "class Still: ...\n", "part": "x = 1\n"}.items():
        (package / f"{name}.py").write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    reference = EntrantReference("their_learner.entry:Still")
    first = ResultFile(tmp_path, reference).header["source"]
    assert first == ResultFile(tmp_path, reference).header["source"] != code_hash()
    (package / "part.py").write_text("x = 2\n")
    assert ResultFile(tmp_path, reference).header["source"] != first
    assert ResultFile(tmp_path, EntrantReference("joint")).header["source"] is None


def test_a_folder_without_results_says_what_makes_them(tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=r"expected results; `benchmark run` makes them, found none"):
        read_summaries(tmp_path)


def test_versions_are_told_of_what_is_installed() -> None:
    assert set(installed_versions("numpy", "no such package")) == {"python", "numpy"}
