"""
Your own learner and policy
===========================

Write a policy, drive the arm with it, write a learner, and enter the benchmark.
"""

# %%
# A policy is a function
# ----------------------
#
# From positions of hands, m, to velocities, m/s. Everything that moves a hand takes one; with a memory, it is an object
# with ``start()`` and ``step(state, hand)``, as `signimit.Policy` says.
import numpy as np

import signimit as si


def spiral_in(hand):
    """Go round the origin counter-clockwise, ever closer to 8 cm."""
    x, y = np.moveaxis(np.asarray(hand), -1, 0)
    radius = np.hypot(x, y) + 1e-9
    inward = 2.0 * (radius - 0.08) / radius
    return np.stack([-0.3 * y / radius - inward * x, 0.3 * x / radius - inward * y], axis=-1)


import matplotlib.pyplot as plt

starts = np.array([[0.2, 0.0], [-0.1, -0.2], [0.01, 0.01]])
paths = si.run_policy(spiral_in, starts, seconds=6.0)
figure, panel = plt.subplots(figsize=(4, 4), layout="constrained")
panel.plot(paths[..., 0], paths[..., 1], linewidth=1)
panel.plot(*starts.T, "o", color="black", markersize=4)
panel.set(aspect="equal", xlabel="x, m", ylabel="y, m")

# %%
# A policy that learns
# --------------------
#
# `Policy` asks for one method. This one follows the demonstration that passes nearest; placed about an object it is a
# policy of the table.


class NearestDemonstration(si.Policy):
    """Moves as the demonstrations did at the nearest demonstrated point, and towards it."""

    def __init__(self, paths, times):
        self.points = np.concatenate(paths)
        self.velocities = np.concatenate([np.gradient(p, t, axis=0) for p, t in zip(paths, times, strict=True)])

    def step(self, state, hand):
        hands = np.atleast_2d(hand)
        nearest = np.linalg.norm(hands[:, None] - self.points, axis=2).argmin(axis=1)
        velocity = self.velocities[nearest] + 2.0 * (self.points[nearest] - hands)
        return state, velocity.reshape(np.shape(hand))


# %%
# Taught with what the default learner took for one movement:
from signimit.benchmark.shipped_sessions import get_session
from signimit.benchmark.splits import get_split

session = get_session(get_split("paper"), seed=0)  # the sessions of the benchmark are frozen and shipped
model = si.learn(session.demonstrations)
_, shown, times = model.movements[0]
policy, place = NearestDemonstration(shown, times), np.array([0.1, 0.05])
path = si.run_policy(policy.at(place), [-0.1, -0.1], seconds=6.0)
figure, panel = plt.subplots(figsize=(4, 4), layout="constrained")
for one in shown:
    panel.plot(*(one + place).T, color="lightgrey", linewidth=1)
panel.plot(*path.T, color="black", linewidth=1)
panel.set(aspect="equal", xlabel="x, m", ylabel="y, m", title="demonstrations grey, the policy black")

# %%
# A learner
# ---------
#
# An entry of the benchmark has three methods. It never learns what was meant. This one repeats the demonstration whose
# signs are most alike, about the object that it was drawn nearest to. It understands nothing, and so has nothing to
# say to a pair of signs that was not shown.


class MostAlikeUtterance:
    """Repeats the demonstration whose signs were most alike."""

    def observe(self, demonstrations):
        self.known = [([si.normalised_sign(s) for s in d.signs], d) for d in demonstrations]

    def begin(self, signs, objects):
        asked = [si.normalised_sign(s) for s in signs]
        costs = [sum(map(si.dtw_distance, asked, heard)) for heard, _ in self.known]
        shown = self.known[int(np.argmin(costs))][1]
        gaps = np.linalg.norm(shown.hand[:, None] - shown.objects, axis=2)
        focus = gaps.mean(axis=0).argmin()
        self.path = shown.hand - shown.objects[focus] + objects[focus]

    def act(self, observation):
        step, half = round(observation.seconds * 50), len(self.path) // 2
        aim = self.path[step if step < len(self.path) else half + step % half]  # then the second half, on and on
        return (aim - observation.hand) / 0.1  # m/s: most of the way in 0.1 s


# %%
# Try it
# ------
#
# One session of the split ``paper``; nine commands, of which six were shown.
from signimit.benchmark.running import obey

entry = MostAlikeUtterance()
entry.observe(session.demonstrations)
for command in session.commands:
    done = si.performed(obey(entry, command), command.objects, session.truth.templates)
    verdict = "obeyed" if done[:2] == command.request else "not obeyed"
    known = "shown" if command.request in session.truth.requests else "never shown"
    print(f"movement {command.request.movement}, object {command.request.focus}, {known}: {verdict}")

# %%
# Enter the benchmark
# -------------------
#
# Save the class in a file, and:
#
# .. code-block:: sh
#
#    signimit benchmark run --entry my_entry.py:MostAlikeUtterance --splits paper unseen-pair
#    signimit benchmark table
#
# :doc:`/benchmark` says what is scored, and what an entry may say of its own understanding to have its stages scored,
# too; :doc:`/benchmark_entries` who takes part.
