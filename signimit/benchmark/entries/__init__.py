"""Entries of the benchmark by name, in the order of the leaderboard.

What a learner needs that is not installed with signimit is imported when its entry is made.
"""

from __future__ import annotations

from signimit.benchmark.entries.chance import Chance
from signimit.benchmark.entries.imitator import learner_entrant
from signimit.benchmark.entries.knn_cloning import NearestNeighbourCloning
from signimit.benchmark.entries.oracles import AllKnowing, oracle_focus, oracle_grouping
from signimit.benchmark.entries.replay import Replay, ReplayNearby
from signimit.benchmark.protocol import Entrant, Entry, Kit, Oracle

MANY = 1200  # demonstrations for those who learn slowly


def _perceptron(kit: Kit) -> Entry:
    from signimit.benchmark.entries.mlp_cloning import PerceptronCloning

    return PerceptronCloning(kit)


def _deep(name: str, title: str, attention: bool, demonstrations: int = 0) -> Entrant:
    """Enter a deep network, with or without attention to one object."""

    def make(kit: Kit) -> Entry:
        from signimit.benchmark.entries.deep_cloning import DeepCloning

        return DeepCloning(kit, attention)

    return Entrant(name=name, title=title, make=make, demonstrations=demonstrations)


_ALL: tuple[Entrant | Oracle, ...] = (
    learner_entrant("joint", "our default: everything inferred together, path-following", "joint"),
    learner_entrant("paper", "the paper: Algorithm 1 as it works, its k-NN policy", "paper", "knn"),
    learner_entrant("paper-path", "the paper's inference, path-following", "paper"),
    learner_entrant("paper-literal", "the paper with Algorithm 1 as printed", "paper-literal", "knn"),
    _deep("deep-12", "a deep network with attention to one object, trained on what was shown", True),
    _deep("deep-1200", "the same, trained on 1,200 demonstrations", True, MANY),
    _deep("deep-plain-12", "a deep network without attention, trained on what was shown", False),
    _deep("deep-plain-1200", "the same without attention, trained on 1,200 demonstrations", False, MANY),
    Entrant(
        name="clone-knn",
        title="behaviour cloning: the nearest moments, seen from all objects",
        make=lambda kit: NearestNeighbourCloning(),
    ),
    Entrant(name="clone-mlp", title="behaviour cloning: a perceptron from signs, objects and hand", make=_perceptron),
    Entrant(
        name="replay-nearby",
        title="the demonstration with the nearest signs, about the object it was nearest to",
        make=lambda kit: ReplayNearby(),
    ),
    Entrant(name="replay", title="the demonstration with the nearest signs, in its place", make=lambda kit: Replay()),
    Oracle(name="oracle-grouping", title="paper-path, told the groups", make=oracle_grouping),
    Oracle(name="oracle-focus", title="paper-path, told the foci", make=oracle_focus),
    Oracle(name="oracle", title="told everything; only path-following can fail", make=AllKnowing),
    Entrant(name="chance", title="guesses: something that was shown, about something that lies there", make=Chance),
)

ENTRANTS: dict[str, Entrant | Oracle] = {entrant.name: entrant for entrant in _ALL}
"""Everybody who enters, by name."""
