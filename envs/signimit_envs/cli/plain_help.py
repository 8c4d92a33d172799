"""The help of commands without any package, for a machine on which nothing is installed yet.

It is read out of the source, so that this file can be run by itself: ``python plain_help.py study cells``. With tyro
the help says more, with the same words.
"""

from __future__ import annotations

import ast
import sys
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

_FOLDER = Path(__file__).parent
_WRAPPER = textwrap.TextWrapper(110, subsequent_indent=" " * 21, break_on_hyphens=False)


def plain_help(name: str, arguments: Sequence[str] = ()) -> str:
    """Return the help of a command or of one of its subcommands.

    Args:
        name: The command, or nothing for the list of all.
        arguments: What was typed behind it; the first may be a subcommand.
    """
    commands = _dictionary(_parse("__init__"), "COMMANDS")
    if name not in commands:
        listed = "\n".join(f"  {command:20s} {ast.literal_eval(what)}" for command, what in commands.items())
        return f"usage: signimit COMMAND [options]\n\n{listed}\n"
    stem = name.replace("-", "_")
    subcommands = _dictionary(_parse(stem), "SUBCOMMANDS")
    defined = {found.name: found for found in _definitions(stem)}
    chosen = next((argument for argument in arguments if argument in subcommands), None)
    if subcommands and chosen is None:
        about = {key: _docstring(defined[ast.unparse(value)]).partition("\n")[0] for key, value in subcommands.items()}
        listed = "\n".join(f"  {key:20s} {line}" for key, line in about.items())
        return f"usage: signimit {name} SUBCOMMAND [options]\n\n{ast.get_docstring(_parse(stem))}\n\n{listed}\n"
    function = defined[ast.unparse(subcommands[chosen]) if chosen else "main"]
    text = _docstring(function).partition("\n\nArgs:")[0]
    options = "".join(f"\n{option}" for option in _options(function, defined))
    usage = " ".join(filter(None, ("usage: signimit", name, chosen, options and "[options]")))
    return f"{usage}\n\n{text}\n{options}"


def _parse(stem: str) -> ast.Module:
    return ast.parse((_FOLDER / f"{stem}.py").read_text(encoding="utf-8"))


def _dictionary(module: ast.Module, name: str) -> dict[str, ast.expr]:
    """Return the entries of a dictionary that a module defines; none if it defines none of that name."""
    for statement in module.body:
        if isinstance(statement, ast.Assign) and ast.unparse(statement.targets[0]) == name:
            assert isinstance(statement.value, ast.Dict)
            keys = [ast.literal_eval(key) for key in statement.value.keys if key is not None]
            return dict(zip(keys, statement.value.values, strict=True))
    return {}


def _definitions(stem: str) -> Iterator[ast.FunctionDef | ast.ClassDef]:
    """Yield the functions and classes of a command's module, then those of its parts and of the shared options."""
    parts = sorted(file.stem for file in _FOLDER.glob(f"{stem}_*.py"))
    for module in ("options", *parts, stem):
        for statement in _parse(module).body:
            if isinstance(statement, (ast.FunctionDef, ast.ClassDef)):
                yield statement


def _docstring(node: ast.FunctionDef | ast.ClassDef) -> str:
    return ast.get_docstring(node) or ""


def _options(
    function: ast.FunctionDef | ast.ClassDef, defined: Mapping[str, ast.FunctionDef | ast.ClassDef]
) -> Iterator[str]:
    """Yield a paragraph for each option; instead of one that stands for a group, those of the group."""
    if isinstance(function, ast.ClassDef):
        entries, typed, positional = _entries(function, "Attributes:"), {}, set[str]()
    else:
        arguments = (*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs)
        typed = {argument.arg: ast.unparse(argument.annotation) for argument in arguments if argument.annotation}
        entries, positional = _entries(function, "Args:"), {argument.arg for argument in function.args.posonlyargs}
    for entry in entries:
        name, _, text = entry.partition(": ")
        if isinstance(group := defined.get(typed.get(name, "")), ast.ClassDef):
            yield from _options(group, defined)
            continue
        shown = name.upper() if name in positional else f"--{name.replace('_', '-')}"
        choices = typed.get(name, "").partition("Literal[")[2].partition("]")[0]
        text += f" One of {choices}." * bool(choices)
        yield _WRAPPER.fill(f"  {shown:18s} {text}") + "\n"


def _entries(node: ast.FunctionDef | ast.ClassDef, heading: str) -> list[str]:
    """Return the entries of a section of a docstring, ``name: text``, each on one line."""
    section = textwrap.dedent(_docstring(node).partition(f"{heading}\n")[2].partition("\n\n")[0])
    entries: list[str] = []
    for line in section.splitlines():
        if line.startswith(" ") and entries:
            entries[-1] += f" {line.strip()}"
        else:
            entries.append(line)
    return entries


if __name__ == "__main__":
    named = [argument for argument in sys.argv[1:] if not argument.startswith("-")]
    print(plain_help(named[0].replace("_", "-") if named else "", named[1:]), end="")
