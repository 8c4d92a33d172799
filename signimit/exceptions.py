"""Everything that signimit refuses, under one base class.

Each class also inherits the builtin that fits, takes facts, keeps them as attributes, and says
in one sentence what was wrong, where, what was expected and what was found.
"""

from __future__ import annotations

import shlex
import sys
from collections.abc import Iterable
from typing import Any


class _ErrorType(type):
    """Type of errors, by which ``type(error)(error)`` is the error again.

    So Gymnasium's `AsyncVectorEnv` raises what was raised in another process; with facts for arguments that would be a
    TypeError.
    """

    def __call__(cls, *facts: Any, **named: Any) -> Any:
        if len(facts) == 1 and not named and type(facts[0]) is cls:
            return facts[0]
        return super().__call__(*facts, **named)


class SignimitError(Exception, metaclass=_ErrorType):
    """Base of every error that signimit raises on purpose.

    Its facts are its ``args``, so that an error survives the way back from another process.
    """


class InvalidInputError(SignimitError, ValueError):
    """A value that cannot be used.

    Attributes:
        where: What was given, e.g. ``"demonstration 3: hand"``.
        expected: What would have worked.
        found: What was there instead.
    """

    def __init__(self, where: str, expected: str, found: str) -> None:
        """Keep the three facts."""
        self.where, self.expected, self.found = where, expected, found
        super().__init__(where, expected, found)

    def __str__(self) -> str:
        """Return the sentence, which can be printed whatever a file or its name is made of."""
        sentence = f"{self.where}: expected {self.expected}, found {self.found}."
        return sentence.encode("utf-8", "backslashreplace").decode()

    def inside(self, place: str) -> InvalidInputError:
        """Return the same complaint, told from one level further out."""
        return type(self)(f"{place}: {self.where}", self.expected, self.found)


class FileFormatError(InvalidInputError):
    """A file that is not what its name promises: truncated, foreign, hostile or of another version."""


class UnknownNameError(SignimitError, ValueError):
    """A name that stands for nothing, with the names that would have worked.

    Attributes:
        what: The kind of thing that was asked for, e.g. ``"policy kind"``.
        name: The name that was given.
        known: The names that exist.
    """

    def __init__(self, what: str, name: object, known: Iterable[str]) -> None:
        """Keep the facts."""
        self.what, self.name, self.known = what, name, tuple(known)
        super().__init__(what, name, self.known)

    def __str__(self) -> str:
        """Return the sentence, with the alternatives."""
        return f"Unknown {self.what} {self.name!r}; known are {', '.join(self.known)}."


class MissingDependencyError(SignimitError, ImportError):
    """An optional package is needed and not installed.

    Attributes:
        package: The package that is missing.
        extra: The extra of signimit that installs it.
        purpose: What needs it.
    """

    def __init__(self, package: str, extra: str, purpose: str) -> None:
        """Keep the facts."""
        self.package, self.extra, self.purpose = package, extra, purpose
        super().__init__(package, extra, purpose)

    def __str__(self) -> str:
        """Return the sentence, with what to type."""
        return f"{self.purpose} needs {self.package}: {install_command(f'signimit[{self.extra}]')}."


def install_command(requirement: str) -> str:
    """Return what to type in a shell to install a package for the Python that runs, whichever ``pip`` comes first."""
    return shlex.join([sys.executable or "python", "-m", "pip", "install", requirement])
