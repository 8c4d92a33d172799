"""Every loader of the project reads mutated files: what is read works, what is not is refused in a sentence."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from signimit import FileFormatError
from signimit_envs.robustness.archives import mutate_archive
from signimit_envs.robustness.fuzzing import Fault, fuzz_loaders, samples_of, write_input
from signimit_envs.robustness.loaders import LOADERS, NOT_FUZZED, READ_THROUGH, Loader, find_loaders
from signimit_envs.robustness.mutation import mutate_bytes, mutate_json, mutate_json_lines, mutate_text

FILES, SLOW_FILES = 30, 8  # of each loader; `python -m signimit fuzz files` tries as many as one likes
EXTRAS = {"minari": ("minari", "h5py"), "lerobot": ("pyarrow",), "inkml": ("defusedxml",), "dollar": ("defusedxml",),
          "read_strokes": ("defusedxml",), "import_bytes": ("defusedxml",)}  # fmt: skip


def need_extras(name: str) -> None:
    """Skip where the packages of a format are not installed."""
    for word, packages in EXTRAS.items():
        for package in packages if word in name else ():
            pytest.importorskip(package)


def test_every_loader_of_the_project_is_fuzzed_or_excused() -> None:
    """A loader that is new must be given sample files in `LOADERS`, and none that is listed may be gone."""
    assert find_loaders() == LOADERS.keys() | READ_THROUGH.keys() | NOT_FUZZED.keys()
    assert set(READ_THROUGH.values()) <= LOADERS.keys()


@pytest.mark.parametrize("name", LOADERS)
def test_what_no_mutation_touched_is_read_and_used(name: str, tmp_path: Path) -> None:
    need_extras(name)
    for place in LOADERS[name].write(tmp_path):
        LOADERS[name].use(LOADERS[name].read(place))


@pytest.mark.parametrize("name", LOADERS)
def test_mutated_files_are_read_and_work_or_are_refused(name: str, tmp_path: Path) -> None:
    """A short seeded run of the command."""
    need_extras(name)
    count = SLOW_FILES if LOADERS[name].slow else FILES
    tallies = [tally for _, tally in fuzz_loaders({name: count}, seed=13, keep=tmp_path)]
    assert [fault for tally in tallies for fault in tally.faults] == []
    assert sum(tally.read + tally.refused for tally in tallies) == count


@pytest.mark.parametrize("mutate", [mutate_bytes, mutate_text, mutate_json, mutate_json_lines, mutate_archive])
def test_a_mutation_depends_on_its_generator_alone(mutate: Callable[[bytes, np.random.Generator], bytes]) -> None:
    name = "StrokeLibrary.load" if mutate is mutate_archive else "SessionStore.read"
    sample = next(iter(samples_of(next(key for key in LOADERS if key.endswith(name))).values()))
    content = next(part for part in sample.values() if part)
    content = content.splitlines()[0] if mutate is mutate_json else content
    first, again = ([mutate(content, np.random.default_rng(seed)) for seed in range(40)] for _ in range(2))
    assert first == again
    assert len(set(first)) > 30


def test_a_file_can_be_made_again_from_its_number(tmp_path: Path) -> None:
    name = "signimit.policies.load_policy"
    made = list[bytes]()
    for number in (3, 3, 4):
        folder = tmp_path / str(len(made))
        folder.mkdir()
        made.append(write_input(name, number, 0, folder).read_bytes())
    assert made[0] == made[1] != made[2]


def _read_number(path: Path) -> int:
    content = path.read_bytes()
    if content[:1] == b"-":
        raise FileFormatError(str(path), "no sign", "one")
    return int(content)


def _sample(folder: Path) -> Any:
    (folder / "number.csv").write_text("17")
    yield folder / "number.csv"


def _divide(value: int) -> None:
    _ = np.float64(1.0) / np.float64(value)


def _die(value: int) -> None:
    os._exit(7)


@pytest.mark.parametrize(
    ("use", "wanted"), [(_divide, ("ValueError", "RuntimeWarning")), (_die, ("process ended with code 7",))]
)
def test_whatever_else_comes_out_is_a_fault_and_its_file_is_kept(
    use: Callable[[int], None], wanted: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Exceptions that are nobody's, warnings of numpy and the end of the process, each with the number of its file."""
    monkeypatch.setitem(LOADERS, "a.loader", Loader(_sample, _read_number, use))
    tallies = [tally for _, tally in fuzz_loaders({"a.loader": 80}, seed=1, workers=2, keep=tmp_path)]
    faults = [fault for tally in tallies for fault in tally.faults]
    assert sum(tally.read + tally.refused for tally in tallies) + len(faults) == 80
    assert all(any(isinstance(f, Fault) and word in f.error for f in faults) for word in wanted)
    assert sum(tally.refused for tally in tallies) > 0
    assert {path.name for path in tmp_path.iterdir()} == {f"loader-{fault.number}" for fault in faults}
