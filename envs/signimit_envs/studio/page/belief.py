"""JSON of a model for the page: movements, words, their order, doubts, and the demonstration it wishes for."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from signimit.asking import Query
from signimit.explanation import SUSPECT, Reasons, is_word_order_clear, ordinal
from signimit.learning import ImitationModel
from signimit.names import object_name
from signimit.paths import resample_path
from signimit.signs import normalised_sign
from signimit_envs.studio.page.prompts import get_language
from signimit_envs.studio.store.history import History

_SIGN_POINTS, _DRAWING_POINTS = 2, 64  # every second of a sign's 64 points; points of a drawing
_MOST_EXAMPLES = 6  # of a word or a movement; more would not be seen


def belief_json(model: ImitationModel) -> dict[str, Any]:
    """Return what a model of a method with probabilities has learned; numbers are rounded for the screen."""
    reasons, order = model.explain(), model.word_order
    asked = model.understanding.requests
    order_text = f"the {ordinal(order.focus)} sign names the object, the {ordinal(order.movement)} the movement."
    clear = is_word_order_clear(model.understanding)
    order_text = (
        order_text.capitalize() if clear else f"The word order cannot be told yet; so far it seems that {order_text}"
    )
    object_words = [
        {"object": i, "strokes": _signs_json(model, order.focus, asked.focus == i)}
        for i in range(model.demonstrations.objects.shape[1])
    ]
    movement_words = [
        {
            "movement": m,
            "strokes": _signs_json(model, order.movement, asked.movement == m),
            "drawings": [_rounded(resample_path(path, _DRAWING_POINTS)) for path in found.paths[-_MOST_EXAMPLES:]],
        }
        for m, found in enumerate(model.movements)
    ]
    return {
        "movements": [{"number": m, "members": list(found.members)} for m, found in enumerate(model.movements)],
        "labels": model.labels.tolist(),
        "focus": model.focus.tolist(),
        "focus_probability": _rounded(reasons.focus_probability),
        "movement_probability": _rounded(reasons.movement_probability),
        "word_order": {"focus": order.focus, "movement": order.movement, "clear": clear, "text": order_text},
        "word_orders": [
            {"focus": other.focus, "movement": other.movement, "loss": round(loss, 2)}
            for other, loss in reasons.word_orders
        ],
        "lexicon": {"objects": object_words, "movements": movement_words},
        "trust": _rounded(model.trust),
        "doubtful": doubts(reasons),
        "text": model.summary(),
    }


def wish_json(model: ImitationModel, wish: Query) -> dict[str, Any]:
    """Return the demonstration that would teach the model most, with a sentence."""
    asked = f"movement {wish.movement + 1} about the {object_name(wish.focus)} object"
    words = [f"the {ordinal(word)} of demonstration {number + 1}" for word, number in enumerate(wish.copied)]
    meanings = model.understanding.requests
    trust = model.trust[(meanings.movement == wish.movement) & (meanings.focus == wish.focus)]
    if not len(trust):
        reason = "as nobody has shown me that yet"
    else:
        reason = "to be surer" if trust[-1] >= SUSPECT else "again, as I doubt that what I was shown then was meant"
    return {
        "text": f"Please make signs like {' and '.join(words)}: I think they ask for {asked}, and ask {reason}.",
        "request": {"movement": wish.movement, "focus": wish.focus},
        "signs": [sign_json(sign) for sign in wish.signs],
        "copied": list(wish.copied),
    }


def doubts(reasons: Reasons) -> list[dict[str, Any]]:
    """Return the demonstrations that the model is unsure about, each with a sentence, and whether it is a suspicion.

    A suspicion tells what the demonstration would have to be to fit, and stands for its other doubts.
    """
    found: dict[int, list[str]] = {}
    suspected = {suspicion.demonstration: str(suspicion) for suspicion in reasons.suspicions}
    for doubt in reasons.ambiguous:
        likely = [f"{object_name(i)} {p:.0%}" for i, p in zip(doubt.objects, doubt.probabilities, strict=True)]
        found.setdefault(doubt.demonstration, []).append(f"about {' or '.join(likely)}")
    for number in reasons.unsure_movements:
        found.setdefault(number, []).append("its movement is in doubt")
    return [
        {
            "number": number,
            "suspected": number in suspected,
            "text": suspected.get(number) or f"Demonstration {number + 1}: {', '.join(found[number])}.",
        }
        for number in sorted({*found, *suspected})
    ]


def understood_text(movement: int, focus: int, confidence: float, name: str = "") -> str:
    """Return a sentence of what was understood, which counts from 1.

    E.g. "movement 2 about the green object, 94 %", or "movement 2 (circle) about ..." if it has a name.
    """
    called = f" ({name})" if name else ""
    return f"movement {movement + 1}{called} about the {object_name(focus)} object, {100 * confidence:.0f} %"


def movement_names(model: ImitationModel, history: History) -> list[str]:
    """Return what people call each movement: by the name given last, or by the prompt of most of its demonstrations.

    The robot is told none of them. A movement without a name gets an empty text.
    """
    language, names = get_language(history.created.language), list(history.names)
    found = []
    for movement in model.movements:
        members = [history.shown[t] for t in movement.members]
        given = max(members, key=lambda one: names.index(one) if one in history.names else -1)
        prompts = Counter(one.prompt.movement for one in members if one.prompt is not None)
        likely, count = prompts.most_common(1)[0] if prompts else (0, 0)
        asked = language.movements[likely] if language is not None and 2 * count > len(members) else ""
        found.append(history.names.get(given) or asked)
    return found


def _signs_json(model: ImitationModel, word: int, which: NDArray[np.bool_]) -> list[Any]:
    """Return how the latest of some demonstrations made their sign at a place of the utterance."""
    numbers = np.flatnonzero(which)[-_MOST_EXAMPLES:]
    return [sign_json(model.demonstrations[int(t)].signs[word]) for t in numbers]


def sign_json(sign: NDArray[np.float64]) -> Any:
    """Return a sign as it is shown, within [-1, 1]."""
    return _rounded(normalised_sign(sign)[::_SIGN_POINTS])


def _rounded(array: NDArray[np.float64]) -> Any:
    return np.round(array, 3).tolist()
