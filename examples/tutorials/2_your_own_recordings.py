"""
Your own recordings
===================

From a CSV of a mouse to an arm that obeys. The tables need nothing of signimit: any program that sees a mouse, a pen or
a tracked hand can write them.
"""

# %%
# Three tables
# ------------
#
# A folder has ``hands.csv``, ``objects.csv`` and ``signs.csv`` (:doc:`/formats` has every column). Here a page of
# Python stands in for your recording program: it draws with a shaky hand and writes text. Two signs name two objects,
# two name a square and a triangle; lengths on the table are metres, signs have any unit.
import csv
import tempfile
from pathlib import Path

import numpy as np

rng = np.random.default_rng(0)
folder = Path(tempfile.mkdtemp())
object_signs = [[(0, 2), (0, 0), (1, 0)], [(0, 2), (1, 0), (2, 2)]]  # an L, a V
movement_signs = [[(0, 2), (2, 2), (0, 0), (2, 0)], [(0, 0), (0, 2), (2, 0), (2, 2)]]  # a Z, an N
shapes = [[(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)], [(0, 1), (-1, -1), (1, -1), (0, 1)]]


def draw(corners, samples):
    """Return a hand that goes from corner to corner, shape (samples, 2)."""
    at, (x, y) = np.linspace(0, len(corners) - 1, samples), np.array(corners, float).T
    line = np.column_stack([np.interp(at, range(len(x)), x), np.interp(at, range(len(y)), y)])
    return line + rng.normal(0, 0.003, line.shape)


rows = {"hands": [], "objects": [], "signs": []}
for number, (thing, shape) in enumerate([(0, 0), (0, 1), (1, 0), (1, 1)] * 2):
    objects = np.array([[-0.2, 0.0], [0.2, 0.1]]) + rng.uniform(-0.08, 0.08, (2, 2))
    drawing = objects[thing] + 0.1 * np.array(shapes[shape] + shapes[shape][1:])  # twice round
    hand = draw([(0, -0.2), *drawing], 250)
    rows["hands"] += [(number, k, 0.02 * k, *point) for k, point in enumerate(hand.tolist())]
    rows["objects"] += [(number, i, *place) for i, place in enumerate(objects.tolist())]
    for word, corners in enumerate((object_signs[thing], movement_signs[shape])):
        rows["signs"] += [(number, word, k, *point) for k, point in enumerate(draw(corners, 60).tolist())]
header = {
    "hands": "demonstration,sample,time_s,hand_x_m,hand_y_m",
    "objects": "demonstration,object,x_m,y_m",
    "signs": "demonstration,sign,sample,x_any,y_any",
}
for name, lines in rows.items():
    with (folder / f"{name}.csv").open("w", newline="") as file:
        csv.writer(file).writerows([header[name].split(","), *lines])
print(*(folder / "hands.csv").read_text().splitlines()[:4], sep="\n")

# %%
# Read them
# ---------
#
# What does not fit is named by file, line and column, and nothing is read.
from signimit.io.formats import read_csv_demonstrations

demonstrations = read_csv_demonstrations(folder)
print(demonstrations)

# %%
from signimit import FileFormatError

broken = Path(tempfile.mkdtemp())
for name in header:
    (broken / f"{name}.csv").write_text((folder / f"{name}.csv").read_text().replace("0.04,", "noon,", 1))
try:
    read_csv_demonstrations(broken)
except FileFormatError as error:
    print(str(error).replace(f"{broken}/", ""))

# %%
# Look at them
# ------------
#
# The first four: hands black, the two objects red and green. Which object each was about is what has to be found out.
import matplotlib.pyplot as plt

figure, axes = plt.subplots(1, 4, figsize=(11, 3), layout="constrained")
for panel, demonstration in zip(axes, demonstrations, strict=False):
    panel.plot(*demonstration.hand.T, color="black", linewidth=1)
    panel.scatter(*demonstration.objects.T, c=["#cc332b", "#3d944d"], zorder=3)
    panel.set(aspect="equal", xlabel="x, m")

# %%
# Learn
# -----
#
# Nobody said how many movements there are, which demonstration shows which, or what a sign means.
import signimit as si

model = si.learn(demonstrations)
print(model.explain())

# %%
# A model in doubt would say so here, with the demonstrations that it doubts and what they would have to be to fit.
from signimit.plots.explanation import draw_explanation

draw_explanation(model)

# %%
# Obey
# ----
#
# New signs, a new scene, and the simulated arm; the pair is a V and a Z: a square about the second object.
import gymnasium as gym

import signimit_envs

signs = [draw(object_signs[1], 60), draw(movement_signs[0], 60)]
scene = np.array([[-0.15, 0.12], [0.18, -0.05]])
answer = model.respond(signs, scene)
env = gym.make("signimit/TabletopHand-v0", objects=2)
track = signimit_envs.reproduce(env, answer.policy, scene, hand=[0.0, -0.15], seconds=8.0)
env.close()
print(f"movement {answer.movement}, object {answer.focus}, confidence {answer.confidence:.2f}")

figure, panel = plt.subplots(figsize=(5, 4), layout="constrained")
panel.plot(*track.path.T, color="black", linewidth=1)
panel.scatter(*scene.T, c=["#cc332b", "#3d944d"], zorder=3)
panel.set(aspect="equal", xlabel="x, m", ylabel="y, m", title="what the arm's hand drew")
assert (answer.movement, answer.focus) == (0, 1)

# %%
# Keep
# ----
#
# A file without pickles, whole or not at all. ``signimit convert FOLDER demonstrations.npz`` does the first part of
# this page in a shell.
model.save(folder / "model.npz")
si.ImitationModel.load(folder / "model.npz")
