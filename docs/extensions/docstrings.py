"""Docstrings as the reference shows them: names found without their modules, types as they are written in the code."""

from __future__ import annotations

import re
from typing import Any

from docutils import nodes
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx
from sphinx.domains.python import PyObject
from sphinx.environment import BuildEnvironment
from sphinx.util.nodes import make_refnode


def find_by_last_name(
    app: Sphinx, env: BuildEnvironment, node: pending_xref, contents: nodes.Element
) -> nodes.Element | None:
    """Link a name to the only object in the reference that ends with it, as a reader would.

    A docstring says `Grouping` where it is `signimit.Grouping` in the reference, and a type says
    ``signimit.teaching.sessions.Session`` where it is `signimit.teaching.Session`.
    """
    if node.get("refdomain") != "py":
        return None
    domain: Any = env.domains["py"]
    target = node["reftarget"]
    for name in (target, target.rpartition(".")[2] if target.startswith("signimit") else target):
        found = {entry.node_id: (full, entry) for full, entry in domain.objects.items() if full.endswith(f".{name}")}
        if len(found) == 1:
            full, entry = next(iter(found.values()))
            return make_refnode(app.builder, node["refdoc"], entry.docname, entry.node_id, contents, full)
    return None


def skip_aliases(app: Sphinx, what: str, name: str, member: object, skip: bool, options: Any) -> bool | None:
    """Leave out the fields of named tuples, which the section "Attributes" of the class explains."""
    return True if type(member).__name__ == "_tuplegetter" else None


def mend_lines(app: Sphinx, what: str, name: str, value: object, options: Any, lines: list[str]) -> None:
    """Leave out what Python says of every named tuple; let ``np.bool_`` be a type and no link to a footnote."""
    kept = [line for line in lines if not line.startswith("Create new instance of ")]
    lines[:] = [re.sub(r"_(?=\])", r"\_", line) if line.startswith(":vartype") else line for line in kept]


def hide_private(
    app: Sphinx, what: str, name: str, value: object, options: Any, signature: str | None, returns: str | None
) -> tuple[str, str | None] | None:
    """Leave private fields of dataclasses out of signatures."""
    return None if signature is None else (re.sub(r", _\w+=<factory>", "", signature), returns)


def mend_types(app: Sphinx, domain: str, kind: str, content: nodes.Element) -> None:
    """Write an alias within a type by its name; Sphinx shows how it holds it, ``TypeAliasForwardRef('ArrayLike')``."""
    for text in list(content.findall(nodes.Text)):
        if "TypeAliasForwardRef" in text:
            text.parent.replace(text, nodes.Text(re.sub(r"TypeAliasForwardRef\('(\w+)'\)", r"\1", text)))


def setup(app: Sphinx) -> dict[str, bool]:
    """Register with Sphinx."""
    app.connect("missing-reference", find_by_last_name)
    app.connect("autodoc-skip-member", skip_aliases)
    app.connect("autodoc-process-signature", hide_private)
    app.connect("autodoc-process-docstring", mend_lines, priority=900)  # after napoleon
    app.connect("object-description-transform", mend_types, priority=900)  # after autodoc's own
    for field in PyObject.doc_field_types:
        if field.name == "variable":
            field.label = "Attributes"  # Sphinx says "Variables"
    return {"parallel_read_safe": True, "parallel_write_safe": True}
