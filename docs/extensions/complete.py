"""The reference is complete: what is public and not in it is a warning, and so an error of the build."""

from __future__ import annotations

import ast
import importlib
import inspect
from collections.abc import Iterator
from typing import Any

from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util import logging

PUBLIC = (
    "signimit", "signimit.benchmark", "signimit.teaching", "signimit.teaching.people", "signimit.io.formats",
    "signimit.learners", "signimit.policies", "signimit_envs", "signimit_envs.recording",
)  # fmt: skip
"""Packages whose names are public: those of ``__all__``, or what ``__init__`` defines or imports as itself."""


def public_names(package: str) -> Iterator[str]:
    """Go through the public names of a package that have a docstring of their own: classes and functions."""
    module = importlib.import_module(package)
    names = getattr(module, "__all__", None) or _exported(inspect.getsource(module))
    for name in names:
        value = getattr(module, name)
        if inspect.isclass(value) or inspect.isfunction(value):
            yield name


def _exported(source: str) -> Iterator[str]:
    """Go through what a package defines, or imports as itself (``from .x import y as y``)."""
    for statement in ast.parse(source).body:
        if isinstance(statement, ast.ImportFrom):
            yield from (alias.name for alias in statement.names if alias.asname == alias.name)
        elif isinstance(statement, ast.FunctionDef | ast.ClassDef) and not statement.name.startswith("_"):
            yield statement.name


def find_undocumented(app: Sphinx, env: BuildEnvironment) -> None:
    """Warn of each public name that no page of the reference has."""
    domain: Any = env.domains["py"]
    documented = {name.rpartition(".")[2] for name in domain.objects}
    for package in PUBLIC:
        for name in public_names(package):
            if name not in documented:
                logging.getLogger(__name__).warning("%s.%s is public and not in the reference", package, name)


def setup(app: Sphinx) -> dict[str, bool]:
    """Register with Sphinx."""
    app.connect("env-check-consistency", find_undocumented)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
