"""The conditions of the study: sizes of languages, and variants such as noise, fillers or unequal counts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from signimit.benchmark.splits import FILLER_SIGNS, FOCUS_SIGNS, MOVEMENT_SIGNS, SYNTHETIC_MOVEMENTS
from signimit.display import one_line
from signimit.exceptions import InvalidInputError
from signimit.strokes import StrokeLibrary
from signimit.teaching.composition import compose_prototypes, compose_utterance
from signimit.teaching.imperfections import Imperfection, answer_wrongly, draw_beside_the_point, go_home
from signimit.teaching.languages import PAPER_LANGUAGE, Language, Request
from signimit.teaching.people import synthetic_library
from signimit.teaching.people.choosing import CROWD, People, Source, load_person
from signimit.teaching.people.relabelling import with_both_triangles, with_waver
from signimit.teaching.sessions import Asker, Command, Condition, Session, compose_session
from signimit.teaching.stroke_sampler import StrokeSampler

VARIANTS = ("plain", "noise", "unbalanced", "swapped", "filler", "constant filler", "unseen third", "mixed")
BESIDE = "1 beside the point"
AS_WITH_A_MOUSE = "once, goes home, 1 wrong"
IMPERFECT: Mapping[str, tuple[Imperfection, ...]] = {
    "once": (),
    "goes home": (go_home,),
    "1 wrong": (answer_wrongly,),
    "2 wrong": (partial(answer_wrongly, count=2),),
    BESIDE: (),  # what is drawn depends on what the people can draw
    "synonyms": (),
    AS_WITH_A_MOUSE: (answer_wrongly, go_home),
}
"""Variants in which people do not keep to the rules."""
DRAWN_ONCE = ("once", AS_WITH_A_MOUSE)
SYNONYMS = tuple(zip(FOCUS_SIGNS[:3], PAPER_LANGUAGE.prototypes, strict=True))  # second way of writing by sign
REAL_MOVEMENTS = (
    "triangle up", "triangle down", "circle", "rectangle", "star", "circle, other way", "pigtail",
)  # fmt: skip
NOISE = 0.06  # half sizes, root mean square of the waver that "noise" adds to every stroke
SAMPLES = 16  # strokes of each label by a synthetic person
FEW, MANY = 1, 3  # demonstrations of a pair of odd and of even movements where counts are unbalanced
PLAIN_SIZES = (
    (2, 2, 1), (2, 3, 2), (3, 3, 1), (3, 3, 2), (3, 3, 4), (5, 3, 1), (5, 4, 1), (8, 3, 1), (8, 2, 2), (3, 6, 1),
    (5, 6, 1), (3, 3, 6), (2, 4, 5), (6, 2, 3), (8, 6, 1),
)  # fmt: skip
REAL_SIZES = ((3, 3, 1), (3, 3, 2), (5, 4, 1), (7, 3, 1), (3, 3, 5), (7, 6, 1))


@one_line
@dataclass(frozen=True, eq=False)
class Recordings:
    """Strokes of real people.

    Attributes:
        signs: Of those who sign.
        movements: Of those who move.
    """

    signs: StrokeLibrary
    movements: StrokeLibrary


def study_condition(
    movements: int, objects: int, repetitions: int, variant: str = "plain", recordings: Recordings | None = None
) -> Condition:
    """Make a condition of the study.

    Args:
        movements: How many.
        objects: How many.
        repetitions: Demonstrations of each pair that is shown; ignored where counts are unbalanced.
        variant: One of `VARIANTS` or `IMPERFECT`.
        recordings: Whose strokes; synthetic people draw where there are none.

    Raises:
        InvalidInputError: If there are not so many signs or movements, or there is no such variant.
    """
    labels = SYNTHETIC_MOVEMENTS if recordings is None else REAL_MOVEMENTS
    if not (1 <= movements <= len(labels) and 1 <= objects <= len(FOCUS_SIGNS)):
        expected = f"up to {len(labels)} movements and {len(FOCUS_SIGNS)} objects"
        raise InvalidInputError("condition", expected, f"{movements} and {objects}")
    if variant not in (*VARIANTS, *IMPERFECT):
        raise InvalidInputError("condition: variant", ", ".join((*VARIANTS, *IMPERFECT)), repr(variant))
    other_shapes = labels[movements : movements + 2] if variant == BESIDE else ()
    if variant == BESIDE and not other_shapes:
        raise InvalidInputError("condition", "a movement that is left to be beside the point", f"all {movements} taken")
    beside = (partial(draw_beside_the_point, labels=other_shapes),) if other_shapes else ()
    places = {"swapped": (1, 0), "filler": (2, 0), "constant filler": (2, 0)}
    fillers = {"filler": FILLER_SIGNS, "constant filler": FILLER_SIGNS[:1]}
    focus_word, movement_word = places.get(variant, (0, 1))
    pairs = [Request(m, f) for m in range(movements) for f in range(objects)]
    language = Language(
        focus_signs=FOCUS_SIGNS[:objects],
        movement_signs=MOVEMENT_SIGNS[:movements],
        movements=labels[:movements],
        filler_signs=fillers.get(variant, ()),
        focus_word=focus_word,
        movement_word=movement_word,
        unseen=tuple(p for p in pairs if sum(p) % 3 == 0) if variant == "unseen third" else (),
        repetitions=repetitions,
        rounds=1 if variant in DRAWN_ONCE else PAPER_LANGUAGE.rounds,
    )
    who = "synthetic" if recordings is None else "real"
    return Condition(
        name=f"{who} {movements}x{objects}x{repetitions} {variant}",
        change=f"{movements} movements, {objects} objects, {variant}",
        language=language,
        choose_people=partial(
            _study_people,
            recordings=recordings,
            crowd=variant == "mixed",
            noise=NOISE if variant == "noise" else 0.0,
            other_shapes=other_shapes,
        ),
        ask=_ask_every_pair_in_order,
        shown_times=_unbalanced if variant == "unbalanced" else None,
        imperfections=IMPERFECT.get(variant, ()) + beside,
        synonyms=SYNONYMS if variant == "synonyms" else (),
    )


def study_conditions(recordings: Recordings | None = None) -> list[Condition]:
    """Return all conditions: sizes in the plain variant, and every other variant at two sizes; real people last."""
    conditions = [study_condition(*size) for size in PLAIN_SIZES]
    conditions += [study_condition(*size, variant) for size in ((3, 3, 2), (5, 4, 1)) for variant in VARIANTS[1:]]
    if recordings is not None:
        conditions.append(study_condition(7, 3, 1, "mixed", recordings))
        conditions += [study_condition(*size, recordings=recordings) for size in REAL_SIZES]
        conditions += [
            study_condition(*size, variant, recordings) for size in ((3, 3, 2), (5, 4, 1)) for variant in VARIANTS[1:]
        ]
    return conditions


def compose_study_session(condition: Condition, seed: int) -> Session:
    """Compose a session; the same condition and seed give the same one.

    Raises:
        InvalidInputError: If no recorded person drew all that the language needs.
    """
    language = condition.language
    rng = np.random.default_rng([seed, len(language.movements), language.objects, language.repetitions])
    people = condition.choose_people(language, SAMPLES, rng, rng)
    signs = StrokeSampler(people.signs)
    prototypes = compose_prototypes(language, signs, rng)
    return compose_session(condition, seed, People(language, signs, people.movements), rng, prototypes=prototypes)


def _study_people(
    language: Language,
    samples: int,
    who: np.random.Generator,
    how: np.random.Generator,
    *,
    recordings: Recordings | None,
    crowd: bool,
    noise: float,
    other_shapes: tuple[str, ...],
) -> People[StrokeLibrary]:
    """Choose one signer and one mover, or a crowd of each; all is drawn from one generator, ``who``."""
    shapes = (*language.movements, *other_shapes)
    if recordings is None:
        writers = CROWD if crowd else 1
        signs = synthetic_library(language.signs, writers=writers, samples=samples // writers, rng=who)
        movements = synthetic_library(shapes, writers=writers, samples=samples, rng=who)
    elif crowd:
        signs, movements = recordings.signs, with_both_triangles(recordings.movements)
    else:
        signs, _ = load_person(Source(recordings.signs), language.signs, who)
        movements, _ = load_person(Source(recordings.movements), shapes, who)
    if noise:
        signs, movements = with_waver(signs, who, noise), with_waver(movements, who, noise)
    return People(language, signs, movements)


def _ask_every_pair_in_order(asker: Asker) -> list[Command]:
    """Ask for every pair once; the hand waits at the table's centre, for here it is not moved."""
    return [
        Command(
            pair,
            compose_utterance(asker.language, asker.signs, *pair, asker.rng),
            asker.scenes(asker.rng, asker.language.objects),
            np.zeros(2),
        )
        for pair in asker.language.requests
    ]


def _unbalanced(request: Request) -> int:
    return FEW if request.movement % 2 else MANY
