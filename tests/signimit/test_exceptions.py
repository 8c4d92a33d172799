"""Errors: one base, the fitting builtin, facts as attributes, and a sentence that says what would have worked."""

import pickle
import shlex
import sys
from pathlib import Path

import pytest

import signimit as si
import signimit_envs
from signimit.exceptions import install_command

ERRORS = [
    (si.InvalidInputError("hand", "numbers", "text"), ValueError, "hand: expected numbers, found text."),
    (si.FileFormatError("a.npz", "arrays", "none"), ValueError, "a.npz: expected arrays, found none."),
    (si.UnknownNameError("method", "x", ["a", "b"]), ValueError, "Unknown method 'x'; known are a, b."),
    (
        si.MissingDependencyError("defusedxml", "strokes", "reading XML"),
        ImportError,
        f"reading XML needs defusedxml: {sys.executable} -m pip install 'signimit[strokes]'.",
    ),
]


@pytest.mark.parametrize(("error", "builtin", "sentence"), ERRORS)
def test_every_error_has_one_base_the_fitting_builtin_and_a_sentence(
    error: si.SignimitError, builtin: type, sentence: str
) -> None:
    assert isinstance(error, si.SignimitError)
    assert isinstance(error, builtin)
    assert str(error) == sentence


@pytest.mark.parametrize(("error", "builtin", "sentence"), ERRORS)
def test_errors_survive_the_way_from_another_process(error: si.SignimitError, builtin: type, sentence: str) -> None:
    copy = pickle.loads(pickle.dumps(error))
    assert type(copy) is type(error)
    assert str(copy) == sentence
    assert vars(copy) == vars(error)


def test_a_complaint_can_be_told_from_further_out() -> None:
    error = si.FileFormatError("hand", "numbers", "text").inside("demonstration 3")
    assert type(error) is si.FileFormatError
    assert error.where == "demonstration 3: hand"


@pytest.mark.parametrize(("error", "builtin", "sentence"), ERRORS)
def test_an_error_of_a_worker_is_raised_as_it_was(error: si.SignimitError, builtin: type, sentence: str) -> None:
    """Gymnasium's AsyncVectorEnv calls the class of what a worker raised with what it raised."""
    assert type(error)(error) is error


def test_every_hint_to_install_something_names_the_python_that_runs() -> None:
    """A bare pip may be that of another Python."""
    folders = [Path(str(package.__file__)).parent for package in (si, signimit_envs)]
    files = [file for folder in folders for file in folder.rglob("*.py")]
    assert len(files) > 200
    assert [file for file in files if "pip install" in file.read_text(encoding="utf-8")] == []
    assert install_command("a[b]") == f"{shlex.quote(sys.executable)} -m pip install 'a[b]'"
