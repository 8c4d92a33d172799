"""What holds between the packages and with the reader: documented names exist, the core never needs a simulator."""

import ast
import dataclasses
import importlib
import inspect
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import signimit
import signimit_assets
from signimit import learners, policies

DOCUMENTED = [
    "Demonstration",
    "DemonstrationSet",
    "ImitationModel",
    "Movement",
    "Response",
    "Query",
    "SignSpace",
    "Stroke",
    "StrokeLibrary",
    "Grouping",
    "WordOrder",
    "Performance",
    "Policy",
    "PlacedPolicy",
    "StatefulPolicy",
    "POLICY_KINDS",
    "GroundTruth",
    "Language",
    "PAPER_LANGUAGE",
    "compose_demonstrations",
    "synthetic_library",
    "dtw_distance",
    "normalised_sign",
    "policy_distances",
    "policy_similarities",
    "maximum_similarities",
    "group_movements",
    "infer_focus",
    "infer_word_order",
    "learn",
    "make_policy",
    "load_policy",
    "run_policy",
    "performed",
    "count_turns",
    "SignimitError",
    "InvalidInputError",
    "FileFormatError",
    "UnknownNameError",
    "MissingDependencyError",
]
SIMULATOR = ("mujoco", "mink", "gymnasium", "signimit_envs", "signimit_assets")
OPTIONAL = ("numba", "defusedxml", "matplotlib", "tqdm", "tyro", "imageio", "sklearn", "OpenGL", "glfw")


def sources(package: ModuleType) -> list[Path]:
    assert package.__file__ is not None
    return sorted(Path(package.__file__).parent.rglob("*.py"))


def imported(tree: ast.AST) -> set[str]:
    """Top-level names of everything a file imports, anywhere in it."""
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and not node.level:
            found.add(str(node.module).split(".")[0])
    return found


@pytest.mark.parametrize("name", DOCUMENTED)
def test_every_documented_name_can_be_imported_and_says_what_it_is(name: str) -> None:
    assert getattr(signimit, name).__doc__


def test_every_public_name_is_documented() -> None:
    public = {n for n, v in vars(signimit).items() if not n.startswith("_") and not inspect.ismodule(v)}
    assert public == set(DOCUMENTED)


def test_every_method_and_policy_kind_has_a_name_and_the_defaults_are_among_them() -> None:
    assert {"paper", "paper-literal"} <= set(learners.LEARNERS)
    assert learners.DEFAULT_METHOD in learners.LEARNERS
    assert "knn" in policies.POLICY_KINDS
    assert policies.DEFAULT_POLICY in policies.POLICY_KINDS


@pytest.mark.parametrize("path", sources(signimit), ids=lambda p: p.stem)
def test_the_core_never_names_the_simulator(path: Path) -> None:
    assert not imported(ast.parse(path.read_text(encoding="utf-8"))) & set(SIMULATOR)


def test_the_assets_import_nothing_of_ours() -> None:
    for path in sources(signimit_assets):
        assert not imported(ast.parse(path.read_text(encoding="utf-8"))) & {"signimit", "signimit_envs", "scripts"}


def test_the_environments_never_import_the_programs() -> None:
    for path in sources(importlib.import_module("signimit_envs")):
        assert "scripts" not in imported(ast.parse(path.read_text(encoding="utf-8")))


BLOCKED = f"""
import sys
for name in {SIMULATOR + OPTIONAL}:
    sys.modules[name] = None  # importing it is an ImportError
import numpy as np
import signimit as si

angle = np.linspace(0, 4 * np.pi, 80)
circle = 0.1 * np.column_stack([np.cos(angle), np.sin(angle)])
bar, hook = [[0, 0], [0, 1]], [[0, 0], [1, 0], [1, 1]]
shown = [
    si.Demonstration((bar if f else hook, hook if m else bar), [[-0.1, 0], [0.1, 0.05 * r]],
                     [[-0.1, 0], [0.1, 0.05 * r]][f] + circle[:: 1 - 2 * m], np.arange(80) / 50)
    for r in range(2) for m in range(2) for f in range(2)
]
model = si.learn(si.DemonstrationSet(shown), prototypes=[bar, hook], method="paper", policy="knn")
response = model.respond((hook, bar), [[0, 0], [0.2, 0]])
assert response.policy([[0.1, 0.1], [0.2, 0.0]]).shape == (2, 2)
si.performed(circle, [[0, 0]], [[circle]])
print(model.summary())
"""


def test_the_core_learns_and_answers_with_nothing_but_numpy_and_scipy(tmp_path: Path) -> None:
    paths = [str(Path(str(signimit.__file__)).parents[1])]
    program = f"import sys; sys.path[:0] = {paths}\n{BLOCKED}"
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "8 demonstrations show" in done.stdout
    assert not list(tmp_path.iterdir())


def test_importing_the_core_leaves_numpys_randomness_alone() -> None:
    np.random.seed(0)  # noqa: NPY002
    before = np.random.get_state()[1].tolist()  # type: ignore[index]  # noqa: NPY002
    importlib.reload(signimit)
    assert np.random.get_state()[1].tolist() == before  # type: ignore[index]  # noqa: NPY002


@pytest.mark.parametrize("path", sources(signimit), ids=lambda p: p.stem)
def test_the_core_draws_only_from_generators_it_is_handed(path: Path) -> None:
    """``np.random`` is there for its types and for default_rng of a seed, never for the global state."""
    allowed = {"Generator", "default_rng", "SeedSequence"}
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Attribute) and ast.unparse(node.value) in ("np.random", "numpy.random"):
            assert node.attr in allowed


@pytest.mark.parametrize("path", sources(signimit), ids=lambda p: p.stem)
def test_a_library_does_not_print(path: Path) -> None:
    calls = [n for n in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(n, ast.Call)]
    assert not [n for n in calls if isinstance(n.func, ast.Name) and n.func.id == "print"]


def test_the_truth_has_no_place_in_what_the_learner_sees() -> None:
    seen = {f.name for f in dataclasses.fields(signimit.Demonstration)}
    assert seen == {"signs", "objects", "hand", "times"}
    assert [f.name for f in dataclasses.fields(signimit.DemonstrationSet)] == ["demonstrations"]
    assert list(inspect.signature(signimit.learn).parameters) == [
        "demonstrations",
        "prototypes",
        "method",
        "policy",
        "rng",
    ]


TEACHING = {"composition", "languages", "people", "scenes", "decks", "formats"}


def modules_needed(path: Path, known: set[Path]) -> set[Path]:
    """Add a file of the core and all files of the core that it imports, directly or not."""
    known.add(path)
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and str(node.module).startswith("signimit."):
            base = Path(str(signimit.__file__)).parent.joinpath(*str(node.module).split(".")[1:])
            for file in (base.with_suffix(".py"), base / "__init__.py"):
                if file.exists() and file not in known:
                    modules_needed(file, known)
    return known


def test_nothing_that_learns_needs_anything_that_composes() -> None:
    package = Path(str(signimit.__file__)).parent
    needed: set[Path] = set()
    for path in (package / "learning.py", *(package / "learners").glob("*.py")):
        modules_needed(path, needed)
    parts = {path.relative_to(package).parts[0].removesuffix(".py") for path in needed}
    assert {"learning", "learners", "similarity", "policies"} <= parts
    assert not parts & TEACHING
