"""Pages of the folder ``results``: the site shows the tables that the commands wrote, and links to them work."""

from __future__ import annotations

import re
from pathlib import Path

from sphinx.application import Sphinx

_TITLES = {
    "README": "How everything was measured",
    "benchmark/README": "Leaderboard of the benchmark",
    "judge/acceptance": "What the judge accepts",
    "paper-conditions/factors": "The paper's conditions, one factor at a time",
    "paper-conditions/ladder": "The paper's conditions, added one by one",
    "policies/real/table": "Policies, real people",
    "policies/synthetic/table": "Policies, synthetic people",
    "real-people/people": "Real people, person by person",
    "study/cells": "Learners and baselines, cell by cell",
    "throughput/throughput": "Throughput",
}
_CONTENTS = """
```{toctree}
:glob:

*/*
*/*/*
```
"""
_LINK = re.compile(r"\]\((?:\.\./)?(results/[^)#\s]+)\)")


def write_pages(app: Sphinx) -> None:
    """Write a page for each Markdown file of ``results``, into ``docs/measured``, which is not in the repository."""
    results, pages = Path(app.srcdir).parent / "results", Path(app.srcdir) / "measured"
    wanted = {}
    for file in sorted(results.rglob("*.md")):
        name = file.relative_to(results).with_suffix("").as_posix()
        text = file.read_text(encoding="utf-8")
        if not text.startswith("# "):
            text = f"# {_TITLES.get(name, name.replace('/', ', ').capitalize())}\n\n{text}"
        folder = f"{'../' * name.count('/')}../../results/{Path(name).parent}"
        text = re.sub(r"!\[([^]]*)\]\(([^):]+)\)", rf"![\1]({folder}/\2)", text)
        if name == "README":
            text += _CONTENTS
        wanted[pages / f"{name}.md"] = text
    for old in set(pages.rglob("*.md")) - set(wanted):
        old.unlink()
    for path, text in wanted.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def link_pages(app: Sphinx, docname: str, source: list[str]) -> None:
    """Let links to files of ``results`` lead to their pages, where they have one."""

    def replace(match: re.Match[str]) -> str:
        page = f"measured/{match[1].removeprefix('results/')}"
        return f"](/{page})" if page.endswith(".md") and (Path(app.srcdir) / page).exists() else match[0]

    source[0] = _LINK.sub(replace, source[0])


def setup(app: Sphinx) -> dict[str, bool]:
    """Register with Sphinx; pages are written before it looks which there are."""
    write_pages(app)
    app.connect("source-read", link_pages)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
