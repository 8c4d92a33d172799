"""Active learning: how many demonstrations it takes until commands are understood, by what the imitator asks for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from signimit.benchmark.studies.conditions import Recordings, study_condition
from signimit.demonstrations import Demonstration, DemonstrationSet
from signimit.inference import WordOrder
from signimit.io.safe_files import Record
from signimit.learning import ImitationModel, learn
from signimit.teaching.languages import Request
from signimit.teaching.people.choosing import People
from signimit.teaching.scenes import sample_scene
from signimit.teaching.sessions import Condition
from signimit.teaching.stroke_sampler import StrokeSampler

SCENES = 8  # that there are to choose from, each time
SAMPLES = 40  # strokes of each label by a synthetic person
ASKED = 20  # demonstrations at the end of a lesson; with few pairs, twice each


def asking_conditions(recordings: Recordings | None = None) -> list[Condition]:
    """Return the conditions in which lessons are given."""
    conditions = [study_condition(*size) for size in ((3, 3, 1), (5, 4, 1))]
    conditions.append(study_condition(5, 3, 1, "noise"))
    if recordings is not None:
        conditions += [study_condition(*size, recordings=recordings) for size in ((3, 3, 1), (5, 4, 1))]
    return conditions


class Question(NamedTuple):
    """A request that the interactant is asked to sign, and the scene to answer in, shape (O, 2), m."""

    request: Request
    objects: NDArray[np.float64]


Ask = Callable[["Lesson", ImitationModel, NDArray[np.float64]], Question]


class Lesson:
    """An interactive session: people, a language, the demonstrations so far, and their ground truth."""

    def __init__(self, condition: Condition, seed: int) -> None:
        """Show every sign once; with odd seeds the movement is named first."""
        plain = condition.language
        self.rng = np.random.default_rng([seed, len(plain.movements), plain.objects])
        self.language = replace(plain, focus_word=seed % 2, movement_word=1 - seed % 2, unseen=())
        people = condition.choose_people(self.language, SAMPLES, self.rng, self.rng)
        self.people = People(self.language, StrokeSampler(people.signs), StrokeSampler(people.movements))
        self.requests: list[Request] = []
        self.demonstrations: list[Demonstration] = []
        # Pairs are random, but each movement and each object comes at least once and as few are shown as can be.
        many, objects = len(plain.movements), plain.objects
        movement, focus = (self.rng.permutation(np.arange(max(many, objects)) % n).tolist() for n in (many, objects))
        for pair in zip(movement, focus, strict=True):
            self.show(Question(Request(*pair), self.scenes(1)[0]))
        self.commands = [
            (request, self.people.speak(request, self.rng), self.scenes(1)[0]) for request in self.language.requests
        ]

    def scenes(self, count: int) -> NDArray[np.float64]:
        """Draw scenes, shape (count, O, 2), m."""
        return np.stack([sample_scene(self.rng, self.language.objects) for _ in range(count)])

    def show(self, question: Question) -> None:
        """Add the demonstration that a question asks for."""
        request, objects = question
        self.requests.append(request)
        self.demonstrations.append(self.people.demonstrate(request, self.rng, lambda rng, count: objects))

    def meaning(self, copied: Sequence[int]) -> Request:
        """Return what signs copied from demonstrations ask for in truth."""
        movement, focus = copied[self.language.movement_word], copied[self.language.focus_word]
        return Request(self.requests[movement].movement, self.requests[focus].focus)

    def accuracy(self, model: ImitationModel) -> float:
        """Return the share of all pairs of signs, each signed anew, that a model understands."""
        means = [
            Counter(self.requests[t].movement for t in movement.members).most_common(1)[0][0]
            for movement in model.movements
        ]
        answers = [(request, model.respond(signs, objects)) for request, signs, objects in self.commands]
        return float(np.mean([(means[a.movement], a.focus) == request for request, a in answers]))


def ask_at_random(lesson: Lesson, model: ImitationModel, scenes: NDArray[np.float64]) -> Question:
    """Ask for any pair in any scene."""
    request = lesson.language.requests[int(lesson.rng.integers(len(lesson.language.requests)))]
    return Question(request, scenes[int(lesson.rng.integers(len(scenes)))])


def ask_the_least_shown(lesson: Lesson, model: ImitationModel, scenes: NDArray[np.float64]) -> Question:
    """Ask for the pair that, by the model, was shown least, in any scene: a balanced design."""
    shown = np.zeros((len(model.movements), scenes.shape[1]))
    asked = model.understanding.requests
    np.add.at(shown, asked, 1.0)
    heard = np.unique(asked.focus)
    movement, at = np.unravel_index(int(shown[:, heard].argmin()), (len(shown), len(heard)))
    word: WordOrder = model.word_order
    copied = [0, 0]
    copied[word.movement] = int(np.flatnonzero(asked.movement == movement)[0])
    copied[word.focus] = int(np.flatnonzero(asked.focus == heard[at])[0])
    return Question(lesson.meaning(copied), scenes[int(lesson.rng.integers(len(scenes)))])


def ask_the_most_informative(lesson: Lesson, model: ImitationModel, scenes: NDArray[np.float64]) -> Question:
    """Ask what `ImitationModel.most_informative` says."""
    query = model.most_informative(scenes)
    return Question(lesson.meaning(query.copied), scenes[query.scene])


STRATEGIES: dict[str, Ask] = {
    "most informative": ask_the_most_informative,
    "least shown": ask_the_least_shown,
    "random": ask_at_random,
}


def run_lessons(condition: Condition, seed: int) -> Record:
    """Let each strategy ask the same people, from the same first demonstrations.

    Returns:
        A record with the accuracy after each demonstration, from the first ones on, by strategy.
    """
    curves: dict[str, list[float]] = {}
    for name, ask in STRATEGIES.items():
        lesson = Lesson(condition, seed)
        last, curve = min(ASKED, 2 * len(lesson.language.requests)), []
        while True:
            model = learn(DemonstrationSet(lesson.demonstrations), policy="knn")
            curve.append(round(lesson.accuracy(model), 4))
            if len(lesson.demonstrations) >= last:
                break
            lesson.show(ask(lesson, model, lesson.scenes(SCENES)))
        curves[name] = curve
    first = max(len(condition.language.movements), condition.language.objects)
    return {"cell": condition.name, "seed": seed, "first": first, "curves": curves}
