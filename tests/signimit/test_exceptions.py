"""Errors: one base, the fitting builtin, facts as attributes, and a sentence that says what would have worked."""

import pickle
import sys

import pytest

import signimit as si

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
