"""The splits of the benchmark: conditions that differ from the paper's; a seed means the same people.

In the first twelve one thing is another than in the paper's, and everybody does what the words ask for. In the others
people are as they are: they draw once, go home, err, scribble, have two signs for one thing, or are all strangers.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import UnknownNameError
from signimit.teaching.composition import GroundTruth, compose_demonstrations, compose_utterance
from signimit.teaching.imperfections import answer_wrongly, draw_beside_the_point, go_home
from signimit.teaching.languages import PAPER_LANGUAGE, Language, Request
from signimit.teaching.people import SIGN_LABELS
from signimit.teaching.people.choosing import another_style, clumsy_strangers, same_people, strangers, wavering_people
from signimit.teaching.scenes import sample_scene
from signimit.teaching.sessions import Asker, Command, Condition, Session, ask_at_random, compose_session
from signimit.teaching.stroke_sampler import as_source

FOCUS_SIGNS = ("1", "2", "3", "0", "6", "5")
MOVEMENT_SIGNS = ("4", "5", "6", "0", "7", "8", "9", "2")  # the same digit may mean different things as another word
FILLER_SIGNS = ("7", "8", "9")
SYNTHETIC_MOVEMENTS = (
    "triangle up", "triangle down", "circle", "square", "star", "figure eight", "zigzag", "spiral",
)  # fmt: skip
OPEN_STROKES = ("zigzag", "spiral", "7")  # what ends elsewhere than it began
OTHER_SHAPES = ("square", "star")  # that mean nothing
SECOND_SIGNS = tuple(zip(FOCUS_SIGNS[:3], FILLER_SIGNS, strict=True))  # of each object
CROWDED = 0.25  # times the usual distances between objects
PER_UNSEEN_PAIR = 3  # commands
FAMILIES = 3  # counterfactual ones of a session
RECIPE = 1  # changes when the same seed gives another session
SAMPLES = 16  # drawings of each label by each person
_WHO, _HOW, _SHOWN, _ASKED, _MORE_HOW, _MORE_SHOWN = range(6)  # independent streams of random numbers


def crowded_scene(rng: np.random.Generator, objects: int) -> NDArray[np.float64]:
    """Draw a scene with objects at a quarter of the usual distances, at least 3.5 cm, within each other's drawings."""
    scene = sample_scene(rng, objects)
    centre = scene.mean(axis=0)
    return np.asarray(centre + CROWDED * (scene - centre))


def left_scene(rng: np.random.Generator, objects: int) -> NDArray[np.float64]:
    """Draw a scene with all objects in the left half of the table."""
    while True:
        scene = sample_scene(rng, objects)
        if (scene[:, 0] < 0).all():
            return scene


def right_scene(rng: np.random.Generator, objects: int) -> NDArray[np.float64]:
    """Draw a scene with all objects in the right half of the table."""
    return left_scene(rng, objects) * (-1.0, 1.0)


def ask_unseen_pairs(asker: Asker) -> list[Command]:
    """Ask three times for every pair that was never demonstrated, in random order."""
    return ask_at_random(asker, sorted(asker.language.held_back) * PER_UNSEEN_PAIR)


def ask_counterfactually(asker: Asker) -> list[Command]:
    """Ask in families of four, in random order.

    A family is a command; the same with one sign changed, once the movement's and once the object's; and the same
    signs where the objects have changed places, none staying where it was.
    """
    commands = [command for family in range(FAMILIES) for command in _ask_family(asker, family)]
    return [commands[i] for i in asker.rng.permutation(len(commands))]


def _ask_family(asker: Asker, family: int) -> list[Command]:
    language, rng = asker.language, asker.rng
    first = asker.command(language.requests[int(rng.integers(len(language.requests)))], family)
    movement, focus = first.request
    other_movement = (movement + int(rng.integers(1, len(language.movements)))) % len(language.movements)
    other_focus = (focus + int(rng.integers(1, language.objects))) % language.objects
    moved = np.roll(first.objects, int(rng.integers(1, language.objects)), axis=0)

    def change_sign(request: Request, word: int) -> Command:
        fresh = compose_utterance(language, asker.signs, *request, rng)
        signs = tuple(fresh[w] if w == word else sign for w, sign in enumerate(first.signs))
        return first._replace(request=request, signs=signs)

    return [
        first,
        change_sign(Request(other_movement, focus), language.movement_word),
        change_sign(Request(movement, other_focus), language.focus_word),
        first._replace(objects=moved),
    ]


_LARGE = Language(focus_signs=FOCUS_SIGNS, movement_signs=MOVEMENT_SIGNS, movements=SYNTHETIC_MOVEMENTS, repetitions=1)
_NOT_SHOWN = tuple(pair for pair in _LARGE.requests if sum(pair) % 3)
_DRAWN_ONCE = replace(PAPER_LANGUAGE, rounds=1)
_ALL = (
    Condition(name="paper", change="nothing: six of nine pairs shown twice, all nine asked for"),
    Condition(name="unseen-pair", change="only the pairs that were never shown are asked for", ask=ask_unseen_pairs),
    Condition(
        name="unseen-scene",
        change="shown in the left half of the table, asked for in the right half",
        shown_scenes=left_scene,
        asked_scenes=right_scene,
    ),
    Condition(
        name="unseen-style",
        change="the signer asks with larger, faster and more slanted signs than were shown",
        choose_people=another_style,
    ),
    Condition(
        name="unseen-person",
        change="every sign and movement may be another one's of a crowd, and a stranger asks",
        choose_people=strangers,
    ),
    Condition(
        name="word-order",
        change="the movement is signed first, the object second",
        language=replace(PAPER_LANGUAGE, focus_word=1, movement_word=0),
    ),
    Condition(
        name="filler-word",
        change="a third word between the two means nothing, one of three signs at random",
        language=replace(PAPER_LANGUAGE, filler_signs=FILLER_SIGNS, movement_word=2),
    ),
    Condition(
        name="many",
        change="8 movements, 6 objects, 16 of 48 pairs shown once, any 16 asked for",
        language=replace(_LARGE, unseen=_NOT_SHOWN),
    ),
    Condition(name="few", change="every pair is shown once only", language=replace(PAPER_LANGUAGE, repetitions=1)),
    Condition(name="noisy", change="a slow waver in all that is drawn", choose_people=wavering_people),
    Condition(
        name="ambiguous",
        change="objects at a quarter of the usual distances, within each other's drawings",
        shown_scenes=crowded_scene,
        asked_scenes=crowded_scene,
    ),
    Condition(
        name="counterfactual",
        change="asked in families: a command, one sign changed, the other one changed, the objects permuted",
        ask=ask_counterfactually,
    ),
    Condition(name="once", change="every movement is drawn once, not twice", language=_DRAWN_ONCE),
    Condition(
        name="open-once",
        change="the movements are open strokes, a zigzag, a spiral and a seven, drawn once",
        language=replace(_DRAWN_ONCE, movements=OPEN_STROKES),
    ),
    Condition(name="retreat", change="the hand goes home after drawing", imperfections=(go_home,)),
    Condition(
        name="wrong-2",
        change="2 of 12 demonstrations answer something else than was asked",
        imperfections=(partial(answer_wrongly, count=2),),
    ),
    Condition(
        name="irrelevant-2",
        change="2 of 12 demonstrations are another shape about no object",
        choose_people=partial(same_people, further=OTHER_SHAPES),
        imperfections=(partial(draw_beside_the_point, labels=OTHER_SHAPES, count=2),),
    ),
    Condition(
        name="idle-4",
        change="four further words mean nothing, any digits at random; the second word names the object, the fifth the "
        "movement",
        language=replace(PAPER_LANGUAGE, filler_signs=SIGN_LABELS, fillers=4, focus_word=1, movement_word=4),
    ),
    Condition(name="synonyms", change="every object has two signs, made in turn", synonyms=SECOND_SIGNS),
    Condition(
        name="strangers",
        change="every drawing and every sign is another clumsy person's",
        choose_people=clumsy_strangers,
    ),
    Condition(
        name="strangers-many",
        change="every drawing and every sign is another clumsy person's; 7 movements, 4 objects, each pair shown once, "
        "any 16 asked for",
        language=replace(
            _LARGE,
            focus_signs=FOCUS_SIGNS[:4],
            movement_signs=MOVEMENT_SIGNS[:7],
            movements=SYNTHETIC_MOVEMENTS[:7],
            unseen=(),
        ),
        choose_people=clumsy_strangers,
    ),
    Condition(
        name="mouse",
        change="what people with a mouse do: every movement is drawn once, 1 of 12 demonstrations answers something "
        "else, and the hand goes home",
        language=_DRAWN_ONCE,
        imperfections=(answer_wrongly, go_home),
    ),
    Condition(
        name="strangers-mouse",
        change="every drawing and every sign is another clumsy person's, every movement is drawn once, 1 of 12 "
        "demonstrations answers something else, and the hand goes home",
        language=_DRAWN_ONCE,
        choose_people=clumsy_strangers,
        imperfections=(answer_wrongly, go_home),
    ),
)
SPLITS: dict[str, Condition] = {split.name: split for split in _ALL}


def get_split(name: str) -> Condition:
    """Return the split of that name.

    Raises:
        UnknownNameError: If there is none.
    """
    if name not in SPLITS:
        raise UnknownNameError("split", name, SPLITS)
    return SPLITS[name]


def choose_splits(names: Iterable[str]) -> tuple[Condition, ...]:
    """Return the splits of these names, or all if none is named.

    Raises:
        UnknownNameError: If there is none of a name.
    """
    return tuple(get_split(name) for name in dict.fromkeys(names)) or tuple(SPLITS.values())


def compose_split_session(split: Condition, seed: int) -> Session:
    """Compose a session; the same split and seed give the same one, up to the last digits of other processors."""
    people = split.choose_people(split.language, SAMPLES, _stream(seed, _WHO), _stream(seed, _HOW))
    return compose_session(split, seed, people, _stream(seed, _SHOWN), asking_rng=_stream(seed, _ASKED))


def with_more_demonstrations(session: Session, count: int) -> Session:
    """Let the same people show more, until there are at least ``count`` demonstrations; the first are the session's."""
    split, seed, language = session.condition, session.seed, session.condition.language
    missing = count - len(session.demonstrations)
    if missing <= 0:
        return session
    more = replace(language, repetitions=-(-missing // len(language.seen)))
    samples = 2 * -(-missing // min(len(language.movements), language.objects)) + SAMPLES
    people = split.choose_people(more, samples, _stream(seed, _WHO), _stream(seed, _MORE_HOW))
    rng = _stream(seed, _MORE_SHOWN)
    signs, movements = split.written(people.signs), as_source(people.movements)
    added, meant = compose_demonstrations(more, signs, movements, rng, split.shown_scenes)
    truth, demonstrations, spoilt = session.truth, list(session.demonstrations), [session.truth.spoilt]
    for begin in range(0, len(added), len(session.demonstrations)):  # as many of each session's length are imperfect
        shown = added[begin : begin + len(session.demonstrations)]
        part = meant.select(begin + np.arange(len(shown)))
        shown, found = split.make_imperfect(shown, part, movements, rng)
        spoilt.append(found.spoilt + len(demonstrations))
        demonstrations += shown
    templates = tuple(a + b for a, b in zip(truth.templates, meant.templates, strict=True))
    movement, focus = (np.concatenate(pair) for pair in ((truth.movement, meant.movement), (truth.focus, meant.focus)))
    return replace(
        session,
        demonstrations=DemonstrationSet(demonstrations),
        truth=GroundTruth(language, movement, focus, templates, np.concatenate(spoilt)),
    )


def entry_stream(session: Session) -> np.random.Generator:
    """Return the random generator of a session's entry; its seed does not tell which session it is."""
    name = f"{RECIPE} {session.seed} {session.condition.name}".encode()
    return np.random.default_rng(int.from_bytes(hashlib.sha256(name).digest()))


def _stream(seed: int, which: int) -> np.random.Generator:
    return np.random.default_rng([RECIPE, seed, which])
