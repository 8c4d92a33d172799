"""Model files: demonstrations and what was inferred from them, in one ``.npz`` archive without pickles."""

from __future__ import annotations

import os
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.display import one_line
from signimit.exceptions import FileFormatError, InvalidInputError, UnknownNameError
from signimit.inference import WordOrder
from signimit.io.archive import read_archive, write_archive
from signimit.learners import get_learner
from signimit.learners.base import Asked, Belief, Learner, Understanding
from signimit.names import check_names, names_from_array
from signimit.policies import check_policy_kind
from signimit.signs import prototype_points
from signimit.strokes import cut, flatten
from signimit.validation import float_array, whole_numbers

KIND, VERSION = "imitation model", 1


@one_line
class ModelParts(NamedTuple):
    """All that a model file holds; `signimit.ImitationModel` has the same."""

    demonstrations: DemonstrationSet
    understanding: Understanding
    method: str
    policy_kind: str
    prototypes: tuple[NDArray[np.float64], ...] | None
    repeat: bool | None
    given_names: tuple[str, ...]


def write_model(path: str | os.PathLike[str], parts: ModelParts) -> None:
    """Write a model file, whole or not at all."""
    known = parts.understanding
    arrays = {f"demonstrations__{k}": v for k, v in parts.demonstrations.to_arrays().items()}
    arrays |= {f"diagnostics__{k}": v for k, v in known.diagnostics.items()}
    arrays |= {"labels": known.labels, "focus": known.focus, "word_order": np.array(known.word_order)}
    if known.asked is not None and known.trust is not None:
        arrays |= {"asked_movement": known.asked.movement, "asked_focus": known.asked.focus, "trust": known.trust}
    if parts.prototypes is not None:
        points, _, offsets = flatten([(p, np.zeros(len(p))) for p in parts.prototypes])
        arrays |= {"prototypes": points, "prototype_offsets": offsets}
    meta: dict[str, Any] = {"method": parts.method, "policy": parts.policy_kind}
    if any(parts.given_names):
        arrays["movement_names"] = np.array(parts.given_names)
    if parts.repeat is not None:
        meta["repeat"] = parts.repeat
    write_archive(path, KIND, VERSION, arrays, meta)


def read_model(path: str | os.PathLike[str]) -> ModelParts:
    """Read what `write_model` wrote.

    Raises:
        FileFormatError: If the file is not a whole, sane model.
    """
    arrays, meta = read_archive(path, KIND, VERSION)
    where = os.fspath(path)
    demos = DemonstrationSet.from_arrays(_part(arrays, "demonstrations__"), where)
    try:
        method, kind = str(meta["method"]), str(meta["policy"])
        learner = get_learner(method)
        repeat = meta.get("repeat")
        check_policy_kind(kind, repeat)
        understanding = _checked_understanding(arrays, demos, learner)
        prototypes = None
        if "prototypes" in arrays:
            prototypes = prototype_points(cut(arrays["prototypes"], "prototypes", arrays["prototype_offsets"]))
        named: tuple[str, ...] = ()
        if "movement_names" in arrays:
            listed = names_from_array(arrays["movement_names"], "movement_names")
            named = check_names(listed, "movement_names", int(understanding.labels.max()) + 1, optional=True)
        learner.reader(demos, prototypes, understanding)  # what a reader lacks is a fault of the file, to be told now
    except KeyError as error:
        raise FileFormatError(where, f"an entry {error}", "none") from None
    except InvalidInputError as error:
        raise FileFormatError(f"{where}: {error.where}", error.expected, error.found) from None
    except UnknownNameError as error:
        raise FileFormatError(where, f"a known {error.what}", repr(error.name)) from None
    return ModelParts(demos, understanding, method, kind, prototypes, repeat, named)


def _part(arrays: dict[str, NDArray[Any]], prefix: str) -> dict[str, NDArray[Any]]:
    return {k.removeprefix(prefix): v for k, v in arrays.items() if k.startswith(prefix)}


def _checked_understanding(arrays: dict[str, NDArray[Any]], demos: DemonstrationSet, learner: Learner) -> Understanding:
    count, frames, words = len(demos), demos.objects.shape[1], len(demos[0].signs)
    labels = _indices(arrays["labels"], "labels", (count,), count, least=-1)
    movements = int(labels.max()) + 1
    if not movements or len(np.unique(labels[labels >= 0])) != movements:
        raise InvalidInputError("labels", "movements numbered without gaps", f"{labels[:8].tolist()}")
    focus = _indices(arrays["focus"], "focus", (count,), frames, least=-1)
    if ((focus < 0) != (labels < 0)).any():
        raise InvalidInputError("focus", "-1 where the label is -1, and nowhere else", f"{focus[:8].tolist()}")
    order = _indices(arrays["word_order"], "word order", (2,), words)
    known = _part(arrays, "diagnostics__")
    shapes = ((count, frames), (count, movements + 1), (words, words))
    belief = None
    if set(Belief._fields) <= known.keys():
        named = zip(Belief._fields, shapes, strict=True)
        belief = Belief(*(float_array(known[name], name.replace("_", " "), shape) for name, shape in named))
        if not np.isfinite(belief.word_order_evidence).any():
            raise InvalidInputError("word order evidence", "a number of at least one word order", "none")
    evidence = learner.restore_evidence(demos, known)
    asked = trust = None
    if {"asked_movement", "asked_focus", "trust"} <= arrays.keys():
        movement = _indices(arrays["asked_movement"], "asked movement", (count,), movements)
        asked = Asked(movement, _indices(arrays["asked_focus"], "asked focus", (count,), frames))
        trust = float_array(arrays["trust"], "trust", (count,))
        if not ((trust >= 0) & (trust <= 1)).all():
            raise InvalidInputError("trust", "probabilities from 0 to 1", f"{trust[:8].tolist()}")
    return Understanding(labels, focus, WordOrder(int(order[0]), int(order[1])), belief, evidence, asked, trust)


def _indices(value: NDArray[Any], where: str, shape: tuple[int, ...], count: int, least: int = 0) -> NDArray[np.int64]:
    array = whole_numbers(value, where, shape)
    if (array < least).any() or (array >= count).any():
        raise InvalidInputError(where, f"whole numbers from {least} to {count - 1}", f"{array[:8].tolist()}")
    return array
