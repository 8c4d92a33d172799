"""Entries of the benchmark by name, in the order of the leaderboard."""

from __future__ import annotations

from signimit.benchmark.entries.chance import Chance
from signimit.benchmark.entries.imitator import learner_entrant
from signimit.benchmark.entries.oracles import AllKnowing, oracle_focus, oracle_grouping
from signimit.benchmark.entries.replay import Replay
from signimit.benchmark.protocol import Entrant, Oracle

_ALL: tuple[Entrant | Oracle, ...] = (
    learner_entrant("joint", "our default: everything inferred together, path-following", "joint"),
    learner_entrant("paper", "the paper: Algorithm 1 as it works, its k-NN policy", "paper", "knn"),
    learner_entrant("paper-path", "the paper's inference, path-following", "paper"),
    learner_entrant("paper-literal", "the paper with Algorithm 1 as printed", "paper-literal", "knn"),
    Entrant(name="replay", title="the demonstration with the nearest signs, again", make=lambda kit: Replay()),
    Oracle(name="oracle-grouping", title="paper-path, told the groups", make=oracle_grouping),
    Oracle(name="oracle-focus", title="paper-path, told the foci", make=oracle_focus),
    Oracle(name="oracle", title="told everything; only path-following can fail", make=AllKnowing),
    Entrant(name="chance", title="guesses: something that was shown, about something that lies there", make=Chance),
)

ENTRANTS: dict[str, Entrant | Oracle] = {entrant.name: entrant for entrant in _ALL}
"""Everybody who enters, by name."""
