"""How the house is built: what imports what, and what no module does. Each rule lists its offenders."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import signimit
import signimit_assets
import signimit_envs

SIMULATOR = {"mujoco", "mink", "gymnasium", "signimit_envs", "signimit_assets"}
UNREACHED = ("signimit.plots", "signimit.io.formats", "signimit.benchmark", "signimit.__main__")
LEARNS = ("learning", "learners", "explanation", "asking", "lexicon", "policies", "grouping", "inference",
          "similarity", "signs", "paths", "demonstrations", "strokes", "evaluation", "io.archive",
          "io.safe_files")  # fmt: skip


def find_modules() -> dict[str, Path]:
    """All modules of the three packages, by name."""
    found = {}
    for package in (signimit, signimit_envs, signimit_assets):
        root = Path(str(package.__file__)).parent
        for path in root.rglob("*.py"):
            parts = (root.name, *path.relative_to(root).with_suffix("").parts)
            found[".".join(parts).removesuffix(".__init__")] = path
    return found


MODULES = find_modules()
TREES = {name: ast.parse(path.read_text(encoding="utf-8")) for name, path in MODULES.items()}
CORE = [name for name in MODULES if name.split(".")[0] == "signimit"]


def walk_statements(tree: ast.AST, at_import: bool) -> Iterator[ast.AST]:
    """Everything in a module, or only what runs when it is imported."""
    for node in ast.iter_child_nodes(tree):
        function = isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda))
        typing = isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
        if at_import and (function or typing):
            continue
        yield node
        yield from walk_statements(node, at_import)


def imports(name: str, at_import: bool = False) -> set[str]:
    """Full names of what a module imports; of ``from a import b`` the module a.b if there is one, else a."""
    found = set()
    for node in walk_statements(TREES[name], at_import):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{name} imports relatively"
            inner = {f"{node.module}.{alias.name}" for alias in node.names}
            found |= {full if full in MODULES else str(node.module) for full in inner}
    return found


def top_level(names: set[str]) -> set[str]:
    return {name.split(".")[0] for name in names}


IMPORT_ALONE = """
import sys
from importlib.metadata import packages_distributions

for name in packages_distributions():
    if name not in ("numpy", "scipy", "signimit"):
        sys.modules[name] = None  # importing it is an ImportError
import signimit
print(*sys.modules)
"""


def test_import_signimit_reaches_every_module_of_the_core_with_numpy_and_scipy_only() -> None:
    """All but figures, formats, the benchmark, the command line, and compiled twins, which are imported when used."""
    done = subprocess.run([sys.executable, "-c", IMPORT_ALONE], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    reached = set(done.stdout.split())
    wanted = {name for name in CORE if not name.startswith(UNREACHED) and not name.endswith("_numba")}
    assert sorted(wanted - reached) == []
    assert not {"signimit.plots", "signimit.benchmark"} & reached


def test_the_benchmark_does_not_build_on_its_studies() -> None:
    public = [name for name in CORE if name.startswith("signimit.benchmark") and ".studies" not in name]
    assert [name for name in public if any(".benchmark.studies" in other for other in imports(name))] == []


def test_nothing_that_learns_needs_what_composes_lessons() -> None:
    needed = {name for name in CORE if name.removeprefix("signimit.").startswith(LEARNS)}
    assert {"signimit.learning", "signimit.learners.paper", "signimit.policies.knn"} <= needed
    waiting = list(needed)
    while waiting:
        new = (imports(waiting.pop()) & set(MODULES)) - needed
        needed |= new
        waiting += new
    forbidden = ("signimit.teaching", "signimit.io.formats", "signimit.benchmark", "signimit.plots")
    assert sorted(name for name in needed if name == "signimit" or name.startswith(forbidden)) == []


def test_no_module_imports_itself_through_others() -> None:
    graph = {name: imports(name, at_import=True) & set(MODULES) for name in MODULES}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(" <- ".join(error.args[1]))


def test_imports_point_one_way() -> None:
    """From the environments to the core; only ``python -m signimit`` hands over to the commands. Assets need nobody."""
    wrong = {name: top_level(imports(name)) & SIMULATOR for name in CORE if name != "signimit.__main__"}
    wrong |= {n: top_level(imports(n)) & {"scripts"} for n in MODULES if n.startswith("signimit_envs")}
    ours = {"signimit", "signimit_envs", "scripts"}
    wrong |= {n: top_level(imports(n)) & ours for n in MODULES if n.startswith("signimit_assets")}
    assert {name: found for name, found in wrong.items() if found} == {}


def test_the_core_draws_only_from_generators_it_is_handed() -> None:
    """``np.random`` is there for its types and for default_rng of a seed, never for the global state."""
    allowed = {"Generator", "default_rng", "SeedSequence"}
    offenders = [
        f"{name}:{node.lineno} {ast.unparse(node)}"
        for name in CORE
        for node in ast.walk(TREES[name])
        if isinstance(node, ast.Attribute) and ast.unparse(node.value) in ("np.random", "numpy.random")
        if node.attr not in allowed
    ]
    assert offenders == []


def test_a_library_does_not_print() -> None:
    offenders = [
        f"{name}:{node.lineno}"
        for name in CORE
        for node in ast.walk(TREES[name])
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "print"
    ]
    assert offenders == []
