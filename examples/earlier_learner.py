"""An earlier state of this package as an entry of the benchmark: its learner, its policies, today's judge.

This file is copied into the earlier package, which has been given a name of its own; docs/benchmark.md has the lines.
"""

import importlib

import numpy as np

from signimit.learners.base import Reading, Understanding

earlier = importlib.import_module(__name__.partition(".")[0])


class Joint:
    """The joint learner of version 0.1.0: everything inferred together, path-following."""

    def observe(self, demonstrations):
        shown = [earlier.Demonstration(d.signs, d.objects, d.hand, d.times) for d in demonstrations]
        self.model = earlier.learn(earlier.DemonstrationSet(shown), rng=0)
        self.understanding = Understanding(self.model.labels, self.model.focus, self.model.word_order)

    def begin(self, signs, objects):
        response = self.model.respond(signs, objects)
        movements = len(self.model.movements)
        self.reading = Reading(np.eye(movements)[response.movement], np.eye(len(objects))[response.focus])
        self.policy, self.state = response.policy, response.policy.start()

    def act(self, observation):
        self.state, velocity = self.policy.step(self.state, observation.hand)
        return velocity
