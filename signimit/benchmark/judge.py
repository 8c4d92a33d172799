"""Identity of the judge: the criterion in words, and the hash of the code that scores a session.

Rows of different judges cannot be compared, so that every result carries the hash, and tables refuse other ones.
"""

from __future__ import annotations

import ast
import hashlib
import inspect
import io
import tokenize
from functools import cache
from types import ModuleType

from signimit import drawing_alignment, evaluation, paths
from signimit.benchmark import scoring

_ENTRANCES = ("judge_inference", "count_signs_read", "score_path")  # of `signimit.benchmark.scoring`

CRITERION = (
    "A command is obeyed if `signimit.performed` finds the movement that was asked for about the object that was asked "
    f"for: a misfit of at most {evaluation.TOLERANCE:g} half sizes to a shown drawing"
    f", {100 * evaluation.COVERED:g} % or more of which was passed in order, "
    f"at {evaluation.SIZES[0]:g} to {evaluation.SIZES[1]:g} times its size."
)
"""What "obeyed" means, for every table that says it."""


@cache
def judge_hash() -> str:
    """Return a short SHA-256 of the code that scores: what scoring, evaluation and geometry of paths use of each other.

    Comments, docstrings and everything that the scores do not depend on may change without changing it.
    """
    parts: dict[str, str] = {}
    waiting: list[tuple[ModuleType, str]] = [(scoring, name) for name in _ENTRANCES]
    while waiting:
        module, name = waiting.pop()
        key = f"{module.__name__}.{name}"
        node = _definitions(module).get(name)
        if node is None or key in parts:
            continue
        parts[key] = _bare_source(module, node)
        used = {found.id for found in ast.walk(node) if isinstance(found, ast.Name)}
        waiting += [place for used_name in used for place in ((module, used_name), _imported(module, used_name))]
    return hashlib.sha256("\n".join(parts[key] for key in sorted(parts)).encode()).hexdigest()[:16]


@cache
def _definitions(module: ModuleType) -> dict[str, ast.stmt]:
    """Return the statements that define a module's functions, classes and constants."""
    found: dict[str, ast.stmt] = {}
    for node in ast.parse(inspect.getsource(module)).body:
        targets = node.targets if isinstance(node, ast.Assign) else [getattr(node, "target", node)]
        named = [t for target in targets for t in (target.elts if isinstance(target, ast.Tuple) else [target])]
        found |= {name: node for t in named if (name := getattr(t, "name", getattr(t, "id", None)))}
    return found


def _imported(module: ModuleType, name: str) -> tuple[ModuleType, str]:
    """Return where a name of a module comes from, if that is another module of the judge."""
    owner = getattr(getattr(module, name, None), "__module__", None)
    for other in (evaluation, drawing_alignment, paths):
        if owner == other.__name__ or (owner is None and name in _definitions(other)):
            return other, name
    return module, name


def _bare_source(module: ModuleType, node: ast.stmt) -> str:
    """Return the source of a statement without comments, docstrings and empty lines."""
    lines: list[str] = inspect.getsource(module).splitlines()
    for token in tokenize.generate_tokens(io.StringIO("\n".join(lines) + "\n").readline):
        if token.type == tokenize.COMMENT:
            lines[token.start[0] - 1] = lines[token.start[0] - 1][: token.start[1]]
    for part in ast.walk(node):
        first = part.body[0] if isinstance(part, ast.FunctionDef | ast.ClassDef) else None
        if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and isinstance(first.value.value, str):
            lines[first.lineno - 1 : first.end_lineno] = [""] * ((first.end_lineno or 0) - first.lineno + 1)
    start = min([node.lineno, *(d.lineno for d in getattr(node, "decorator_list", []))])
    kept = (line.rstrip() for line in lines[start - 1 : node.end_lineno])
    return "\n".join(line for line in kept if line)
