"""What is promised to the reader: names, the tables of the package's docstring, a core that needs no simulator."""

import dataclasses
import functools
import importlib
import inspect
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import signimit
from signimit import learners, policies

NAMES_OF_0_1_0 = [
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


def resolve(name: str) -> Any:
    """What a docstring means by a name: public, or spelled out from the package on."""
    parts = name.split(".")
    if parts[0] not in ("signimit", "signimit_envs"):
        return functools.reduce(getattr, parts, signimit)
    found: Any = importlib.import_module(parts[0])
    for number, part in enumerate(parts[1:], 2):
        if not hasattr(found, part):
            importlib.import_module(".".join(parts[:number]))
        found = getattr(found, part)
    return found


def docstring_tables() -> tuple[list[list[str]], list[list[str]]]:
    """Rows of the notation and of the map of the paper, three columns each."""
    parts = re.split(r"^=.*=$", str(signimit.__doc__), flags=re.MULTILINE)
    return tuple([re.split(" {2,}", row) for row in parts[n].strip().splitlines()] for n in (2, 5))  # type: ignore[return-value]


@pytest.mark.parametrize("name", sorted({*NAMES_OF_0_1_0, *signimit.__all__}))
def test_every_public_name_can_be_imported_and_says_what_it_is(name: str) -> None:
    assert getattr(signimit, name).__doc__


def test_all_has_every_public_name_and_completion_little_else() -> None:
    public = {n for n, v in vars(signimit).items() if not n.startswith("_") and not inspect.ismodule(v)}
    assert public == {*signimit.__all__, "StatefulPolicy"}
    starred: dict[str, Any] = {}
    exec("from signimit import *", starred)
    assert set(starred) - {"__builtins__"} == set(signimit.__all__)
    assert set(dir(signimit)) - set(signimit.__all__) == {"io", "learners", "policies", "teaching", "__version__"}
    assert all(hasattr(signimit, name) for name in dir(signimit))


def test_the_notation_is_that_of_the_docstrings_it_names() -> None:
    rows, _ = docstring_tables()
    assert {"N", "O", "W", "T", "P", "Δ", "γ", "M", "ω", "ϖ", "ξ"} <= {symbol for symbol, *_ in rows}
    absent = [
        f"{symbol} in {name}"
        for symbols, _, where in rows
        for name in re.findall("`([^`]+)`", where)
        for symbol in symbols.split(", ")
        if not re.search(rf"(?<![A-Za-z]){symbol}(?![A-Za-z])", str(resolve(name).__doc__))
    ]
    assert absent == []


def test_the_map_of_the_paper_leads_to_docstrings_that_lead_back() -> None:
    _, rows = docstring_tables()
    assert {section for section, *_ in rows} >= {"II-A", "II-B", "II-C", "II-D", "II-E", "II-F", "III", "figure 7"}
    silent = []
    for section, _, where in rows:
        for name in re.findall("`([^`]+)`", where):
            if name.startswith("signimit.plots"):
                pytest.importorskip("matplotlib", reason="figures need matplotlib")
            cited = section if section.startswith("figure") else rf"sections? {section}\b"
            if not re.search(cited, str(resolve(name).__doc__)):
                silent.append(f"{section} in {name}")
    assert silent == []


def test_every_method_and_policy_kind_has_a_name_and_the_defaults_are_among_them() -> None:
    assert {"paper", "paper-literal"} <= set(learners.LEARNERS)
    assert learners.DEFAULT_METHOD in learners.LEARNERS
    assert "knn" in policies.POLICY_KINDS
    assert policies.DEFAULT_POLICY in policies.POLICY_KINDS


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


def test_the_truth_has_no_place_in_what_the_learner_sees() -> None:
    seen = {f.name for f in dataclasses.fields(signimit.Demonstration)}
    assert seen == {"signs", "objects", "hand", "times"}
    assert [f.name for f in dataclasses.fields(signimit.DemonstrationSet)] == ["demonstrations", "object_names"]
    assert list(inspect.signature(signimit.learn).parameters) == [
        "demonstrations",
        "prototypes",
        "method",
        "policy",
        "rng",
        "repeat",
    ]
