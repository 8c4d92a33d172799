"""Every loader of the project: where it is, files for it, and what a user does with what it read.

`find_loaders` looks into the source, so that a loader that is missing in `LOADERS` is noticed.
"""

from __future__ import annotations

import ast
import pickle
from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import signimit
import signimit_envs
from signimit import DemonstrationSet, ImitationModel, StrokeLibrary, load_policy
from signimit.benchmark.entries import refer_to
from signimit.benchmark.results import ResultFile, read_summaries, summarise
from signimit.benchmark.tables import leaderboard
from signimit.exceptions import SignimitError
from signimit.io.formats import inventory_table, read_csv_demonstrations, read_inkml, read_strokes
from signimit.io.formats.dollar import read_dollar
from signimit.io.formats.unipen import read_unipen
from signimit.learners.joint.drawing_dissimilarity import describe_drawing
from signimit.policies import Policy
from signimit.signs import normalised_sign
from signimit_envs.recording import Recording, load_recording
from signimit_envs.recording.formats.csv_recordings import read_csv_recording
from signimit_envs.recording.formats.lerobot.demonstrations import read_lerobot_demonstrations
from signimit_envs.recording.formats.lerobot.recordings import read_lerobot_recording
from signimit_envs.recording.formats.minari_demonstrations import read_minari_demonstrations
from signimit_envs.recording.formats.minari_recordings import read_minari_recording
from signimit_envs.recording.replay import find_divergence, observe_states
from signimit_envs.robustness import samples, studio_samples
from signimit_envs.studio.page.exports import import_bytes, to_library
from signimit_envs.studio.page.prompts import get_language
from signimit_envs.studio.page.views import track_json
from signimit_envs.studio.store.event_json import event_to_json
from signimit_envs.studio.store.events import DrawnDemonstration
from signimit_envs.studio.store.history import History
from signimit_envs.studio.store.sessions import SessionStore

_HANDS = np.array([[0.0, 0.0], [0.1, -0.05], [-0.3, 0.2], [0.01, 0.08]])
_VERBS = ("load", "read", "import")


class Loader(NamedTuple):
    """A function that reads what may come from anywhere.

    Attributes:
        write: Writes sample files into a folder.
        read: Reads such a file or folder; may raise a `SignimitError`, or that there is no such file.
        use: Does with what was read whatever a user can do; raises nothing.
        slow: Whether a file takes more than some milliseconds.
    """

    write: Callable[[Path], Iterator[Path]]
    read: Callable[[Path], Any]
    use: Callable[[Any], object]
    slow: bool = False


def find_loaders() -> set[str]:
    """Find the loaders in the source by their names and arguments.

    A loader is a public function or method called load, read or import, alone or with more words behind, that takes a
    path or bytes, or is a method of a class that is made with a folder.
    """
    found = set()
    for package in (signimit, signimit_envs):
        root = Path(str(package.__file__)).parent
        for path in root.rglob("*.py"):
            parts = (root.name, *path.relative_to(root).with_suffix("").parts)
            module = ".".join(parts).removesuffix(".__init__")
            found |= set(_loaders_of(ast.parse(path.read_text(encoding="utf-8")), module, False))
    return found


def find_unknown_loaders() -> set[str]:
    """Return the loaders in the source that are in none of the lists here."""
    return find_loaders() - LOADERS.keys() - READ_THROUGH.keys() - NOT_FUZZED.keys()


def _loaders_of(tree: ast.Module | ast.ClassDef, where: str, has_folder: bool) -> Iterator[str]:
    """Yield the loaders of a module or class."""
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            init = (n.args for n in node.body if isinstance(n, ast.FunctionDef) and n.name == "__init__")
            made_with = [ast.unparse(n.annotation) for n in node.body if isinstance(n, ast.AnnAssign)]
            made_with += [ast.unparse(a.annotation) for args in init for a in args.args if a.annotation]
            yield from _loaders_of(node, f"{where}.{node.name}", "Path" in made_with)
        elif isinstance(node, ast.FunctionDef) and node.name.split("_")[0] in _VERBS:
            types = [ast.unparse(a.annotation) for a in node.args.args if a.annotation]
            if has_folder or any("Path" in text or text == "bytes" for text in types):
                yield f"{where}.{node.name}"


def use_library(library: StrokeLibrary) -> None:
    """Print a library, choose from it, and prepare its strokes as the learner does."""
    _ = repr(library), inventory_table(library).encode(), (library + library).source.encode()
    for stroke, label in zip(library, library.labels, strict=True):
        _ = repr(stroke)
        _check_finite(normalised_sign(stroke.points))
        _ = len(library.select(label))


def use_demonstrations(demonstrations: DemonstrationSet) -> None:
    """Print demonstrations, and prepare them as the learner does."""
    _ = repr(demonstrations), demonstrations.objects, demonstrations[:1]
    for one in demonstrations:
        _ = repr(one)
        _check_finite(np.gradient(one.hand, one.times, axis=0))
        _check_finite(describe_drawing(one.hand, one.times).half_size)
        for sign in one.signs:
            _check_finite(normalised_sign(sign))


def use_policy(policy: Policy) -> None:
    """Ask a policy for the velocity of one hand and of several, step by step, copied, and placed on the table."""
    _ = repr(policy)
    for hands in (_HANDS[0], _HANDS):
        _check_finite(policy(hands))
        state, moved = policy.start(), hands
        for _ in range(3):
            state, velocity = policy.step(state, moved)
            _check_finite(velocity)
            moved = np.clip(moved + 0.02 * velocity, -1, 1)
    _check_finite(policy.at([0.1, 0.1])(_HANDS))
    _ = pickle.loads(pickle.dumps(policy))


def use_model(model: ImitationModel) -> None:
    """Ask a model for what it knows and why, for answers and their policies, and for what to ask next."""
    _ = repr(model), model.summary(), model.labels, model.focus
    _ = model.landmarks, model.movements, dict(model.diagnostics)
    demos = model.demonstrations
    if model.understanding.belief is not None:
        _ = str(model.explain())
        _ = model.most_informative(demos.objects)
    if model.understanding.evidence is not None and model.method == "joint":
        _ = model.observe(demos[0])
    for one in demos[:2]:
        response = model.respond(one.signs, one.objects)
        _ = repr(response)
        _check_finite(response.confidence)
        _check_finite(response.policy(_HANDS))


def use_recording(recording: Recording) -> None:
    """Print a recording, replay it and observe it."""
    _ = repr(recording), repr(recording.origin), recording[:1], recording.origin.version_note()
    for episode in recording:
        _ = repr(episode)
        _ = observe_states(recording.origin, episode)
        _ = find_divergence(recording.origin, episode)
    with suppress(SignimitError):
        _ = recording.origin.make_spec()


def session_in(folder: Path) -> tuple[History, list[Any]]:
    """Read the session in a studio's folder, with its track."""
    with closing(SessionStore(folder)) as store:
        _ = store.listed()
        return store.read(studio_samples.SESSION), store.read_track(studio_samples.SESSION, 0)


def use_journal(read: tuple[History, list[Any]]) -> None:
    """Do with a session what the page shows of it."""
    history, track = read
    _ = history.title.encode(), history.created.language.encode()
    for one in history.shown:
        _ = one.demonstration, one.by.encode()
    for answer in history.answers:
        _ = event_to_json(answer.asked), round(answer.asked.confidence, 4), answer.asked.movement + answer.asked.focus
    if history.shown:
        _ = DemonstrationSet(one.demonstration for one in history.shown)
        _ = to_library(history.shown, get_language(history.created.language))
    with suppress(SignimitError):
        _ = track_json(track)


def imported_from(path: Path) -> tuple[DrawnDemonstration, ...]:
    """Read a file as the studio imports it."""
    return import_bytes(path.name, path.read_bytes())


def use_import(shown: tuple[DrawnDemonstration, ...]) -> None:
    """Do with imported demonstrations what the studio does."""
    use_demonstrations(DemonstrationSet(one.demonstration for one in shown))
    _ = [one.by.encode() for one in shown]


def results_in(folder: Path) -> Any:
    """Read results, records and summaries, of a benchmark's folder."""
    file = ResultFile(folder, refer_to(samples.ENTRY))
    records = file.read()
    return (file, records), read_summaries(folder)


def use_results(read: Any) -> None:
    """Summarise records, and make the leaderboard of summaries."""
    (file, records), summaries = read
    _ = leaderboard(summaries).encode()
    if records:
        _ = summarise(file)


def _check_finite(value: Any) -> None:
    if not np.isfinite(value).all():
        raise FloatingPointError("not finite")


LOADERS = {
    "signimit.strokes.StrokeLibrary.load": Loader(samples.write_strokes, StrokeLibrary.load, use_library),
    "signimit.demonstrations.DemonstrationSet.load": Loader(
        samples.write_demonstrations, DemonstrationSet.load, use_demonstrations
    ),
    "signimit.policies.load_policy": Loader(samples.write_policies, load_policy, use_policy),
    "signimit.learning.ImitationModel.load": Loader(samples.write_models, ImitationModel.load, use_model, slow=True),
    "signimit.io.formats.csv_demonstrations.read_csv_demonstrations": Loader(
        samples.write_csv_folder, read_csv_demonstrations, use_demonstrations
    ),
    "signimit.io.formats.inkml.reading.read_inkml": Loader(samples.write_inkml_files, read_inkml, use_library),
    "signimit.io.formats.unipen.drawings.read_unipen": Loader(samples.write_unipen_file, read_unipen, use_library),
    "signimit.io.formats.dollar.read_dollar": Loader(samples.write_dollar_file, read_dollar, use_library),
    "signimit.io.formats.reading.read_strokes": Loader(
        samples.write_stroke_files, lambda path: read_strokes([path]), use_library
    ),
    "signimit.benchmark.results.ResultFile.read": Loader(samples.write_results, results_in, use_results),
    "signimit_envs.recording.storage.load_recording": Loader(
        samples.write_recording, load_recording, use_recording, slow=True
    ),
    "signimit_envs.recording.formats.csv_recordings.read_csv_recording": Loader(
        samples.write_csv_recording_folder, read_csv_recording, use_recording, slow=True
    ),
    "signimit_envs.recording.formats.minari_demonstrations.read_minari_demonstrations": Loader(
        samples.write_minari_folder, read_minari_demonstrations, use_demonstrations, slow=True
    ),
    "signimit_envs.recording.formats.minari_recordings.read_minari_recording": Loader(
        samples.write_minari_recording_folder, read_minari_recording, use_recording, slow=True
    ),
    "signimit_envs.recording.formats.lerobot.demonstrations.read_lerobot_demonstrations": Loader(
        samples.write_lerobot_folder, read_lerobot_demonstrations, use_demonstrations, slow=True
    ),
    "signimit_envs.recording.formats.lerobot.recordings.read_lerobot_recording": Loader(
        samples.write_lerobot_recording_folder, read_lerobot_recording, use_recording, slow=True
    ),
    "signimit_envs.studio.store.sessions.SessionStore.read": Loader(
        studio_samples.write_studio_session, session_in, use_journal
    ),
    "signimit_envs.studio.page.exports.import_bytes": Loader(
        studio_samples.write_studio_exports, imported_from, use_import
    ),
}
"""Loaders by their full names."""

READ_THROUGH = {
    "signimit.io.archive.read_archive": "signimit.strokes.StrokeLibrary.load",
    "signimit.io.safe_files.read_records": "signimit_envs.studio.store.sessions.SessionStore.read",
    "signimit.io.formats.csv_tables.read_table": "signimit.io.formats.csv_demonstrations.read_csv_demonstrations",
    "signimit.io.formats.pen_recording.import_pen_file": "signimit.io.formats.inkml.reading.read_inkml",
    "signimit.io.formats.reading.import_strokes": "signimit.io.formats.reading.read_strokes",
    "signimit.io.formats.textfile.read_any_text": "signimit.io.formats.unipen.drawings.read_unipen",
    "signimit.io.formats.textfile.read_bytes": "signimit.io.formats.dollar.read_dollar",
    "signimit.io.formats.textfile.read_text": "signimit.io.formats.unipen.drawings.read_unipen",
    "signimit.io.formats.xmlfile.read_xml": "signimit.io.formats.inkml.reading.read_inkml",
    "signimit.learners.model_files.read_model": "signimit.learning.ImitationModel.load",
    "signimit.policies.storage.read_policy_arrays": "signimit.policies.load_policy",
    "signimit.benchmark.results.read_summaries": "signimit.benchmark.results.ResultFile.read",
    "signimit.benchmark.results.read_comparable_summaries": "signimit.benchmark.results.ResultFile.read",
    "signimit.benchmark.studies.real_people.read_people": "signimit.io.formats.reading.read_strokes",
    "signimit_envs.cli.study.load_recordings": "signimit.strokes.StrokeLibrary.load",
    "signimit_envs.recording.origin.read_origin": "signimit_envs.recording.formats.csv_recordings.read_csv_recording",
    "signimit_envs.recording.formats.lerobot.frames.read_layout": (
        "signimit_envs.recording.formats.lerobot.recordings.read_lerobot_recording"
    ),
    "signimit_envs.recording.formats.registry.read_data": "signimit_envs.recording.storage.load_recording",
    "signimit_envs.recording.formats.registry.read_recording": "signimit_envs.recording.storage.load_recording",
    "signimit_envs.studio.store.sessions.SessionStore.read_track": (
        "signimit_envs.studio.store.sessions.SessionStore.read"
    ),
}
"""Loaders that are fuzzed through another one, which calls them or is called by them."""

NOT_FUZZED = {
    "signimit.benchmark.shipped_sessions.load_split": "compared with a frozen SHA-256",
    "signimit.benchmark.studies.lasa.load_lasa": "scipy's reader of .mat files can end the process; no cure from here",
    "signimit_envs.cli.result_tables.read_csv": "reads the results of this repository",
    "signimit_envs.cli.result_tables.read_json": "reads the results of this repository",
    "signimit_envs.cli.result_tables.read_judged": "reads the results of this repository",
    "signimit_envs.cli.result_tables.read_people": "reads the results of this repository",
}
"""Loaders that are not fuzzed, and why."""
