"""
What it does not understand
===========================

Where the learner stops, shown. Whoever builds upon it should know; what is known of how often these things happen is in
:doc:`/results`.
"""

# %%
# Signs that were never taught
# ----------------------------
#
# A sign of nobody's still is nearest to something. The confidence says so, and `ImitationModel.respond_if_sure`
# declines.
import numpy as np

import signimit as si

rng = np.random.default_rng(1)
language = si.PAPER_LANGUAGE
labels = (*language.signs, "star", "spiral")
signs = si.synthetic_library(labels, samples=8, rng=rng)
movements = si.synthetic_library(language.movements, samples=12, rng=rng)
demonstrations, truth = si.compose_demonstrations(language, signs, movements, rng)
model = si.learn(demonstrations)
scene = demonstrations[0].objects


def fresh(label):
    """Return the writer's last drawing of a label, which no demonstration has."""
    return signs.select(label)[-1].points


for words in (("1", "4"), ("2", "star"), ("spiral", "star")):
    answer = model.respond([fresh(word) for word in words], scene)
    sure = model.respond_if_sure([fresh(word) for word in words], scene) is not None
    print(f"{words}: confidence {answer.confidence:.2f}, {'answers' if sure else 'declines'}")

# %%
# Too few demonstrations
# ----------------------
#
# Three demonstrations cannot show what nine pairs mean. It does not refuse to learn, it says what is missing.
few = si.learn(demonstrations[:3])
print(few.explain())

# %%
# A word order that nothing tells apart
# -------------------------------------
#
# If each object was only ever seen with one movement, either word may name either thing.
from dataclasses import replace

tied = replace(language, unseen=tuple((m, f) for m in range(3) for f in range(3) if m != f), repetitions=4)
tied_demonstrations, _ = si.compose_demonstrations(tied, signs, movements, rng)
print(*si.learn(tied_demonstrations).explain().text.splitlines()[-2:], sep="\n")

# %%
# Objects in one place
# --------------------
#
# What an answer was about is told by where the hand was, in scenes that differ. Here the objects lie 5 mm apart, less
# than a hand strays: a drawing about one is as good a drawing about its neighbour. The figure has a "?" where it
# doubts.
from signimit.plots.explanation import draw_explanation


def crowded(rng, objects):
    """Return objects in a row, 5 mm apart, anywhere on the table."""
    return np.column_stack([0.005 * np.arange(objects), np.zeros(objects)]) + rng.uniform(-0.1, 0.1, 2)


crowd, crowd_truth = si.compose_demonstrations(language, signs, movements, rng, crowded)
confused = si.learn(crowd)
right = (confused.focus == crowd_truth.focus).sum()
print(f"{right} of {len(crowd)} objects right; {len(confused.explain().ambiguous)} are called ambiguous")
draw_explanation(confused)

# %%
# Answers to something else
# -------------------------
#
# People err: some demonstrations answer another request. The model trusts them less, and says what each would have to
# be to fit. With nine of twelve there is little left that others could be measured by.
from signimit.teaching.imperfections import answer_wrongly
from signimit.teaching.stroke_sampler import as_source

for count in (1, 3, 6, 9):
    erring, true = answer_wrongly(
        demonstrations, truth, as_source(movements), np.random.default_rng(count), count=count
    )
    understood = si.learn(erring)
    suspected = {suspicion.demonstration for suspicion in understood.explain().suspicions}
    found = len(suspected & set(true.spoilt.tolist()))
    print(f"{count} of 12 err: {found} of them suspected, {len(suspected) - found} others too")

# %%
# A hand that shakes, a movement that is no movement
# --------------------------------------------------
#
# Drawings that differ as much as movements do are taken for several movements, or for none. Here hands stray more and
# more from the same drawings, which are about 20 cm wide: a random walk is added.
for stray in (0.0, 0.05, 0.1, 0.2, 0.4):  # m after the whole drawing, on average
    steps = [rng.normal(0, stray / np.sqrt(len(d.hand)), d.hand.shape) for d in demonstrations]
    slow = [np.cumsum(step, axis=0) for step in steps]
    shaky = si.DemonstrationSet(
        si.Demonstration(d.signs, d.objects, d.hand + drift, d.times)
        for d, drift in zip(demonstrations, slow, strict=True)
    )
    understood = si.learn(shaky)
    right = (understood.focus == truth.focus).sum()
    print(f"{100 * stray:.0f} cm: {right} of 12 objects right, {len(understood.explain().suspicions)} suspected")

# %%
# From one object to another
# --------------------------
#
# Every movement is about *one* object. Lines that go from the object asked for to the next one have two, and what they
# have in common cannot be said in the frame of one: they are of all lengths and directions. It groups by chance
# likenesses; all it says is that the word order cannot be told.
import matplotlib.pyplot as plt


def draw_line(demonstration, request):
    """Return a demonstration with a straight line from the object asked for to the next one, or to the one before."""
    begin = demonstration.objects[request.focus]
    end = demonstration.objects[(request.focus + 1 + request.movement % 2) % 3]
    hand = begin + (end - begin) * np.linspace(0, 1, 120)[:, None] + rng.normal(0, 0.001, (120, 2))
    return si.Demonstration(demonstration.signs, demonstration.objects, hand, 0.02 * np.arange(120))


lines = si.DemonstrationSet(draw_line(d, request) for d, request in zip(demonstrations, truth.requests, strict=True))
misled = si.learn(lines)
print(misled.summary().partition("There are")[0])
figure, axes = plt.subplots(1, 4, figsize=(10, 2.6), layout="constrained")
for panel, demonstration in zip(axes, lines, strict=False):
    panel.plot(*demonstration.hand.T, color="black", linewidth=1.2)
    panel.scatter(*demonstration.objects.T, c=["#cc332b", "#3d944d", "#2e66c2"], zorder=3)
    panel.set(aspect="equal", xlim=(-0.3, 0.3), ylim=(-0.3, 0.3), xticks=[], yticks=[])

# %%
# What it has no notion of
# ------------------------
#
# - Movements about two objects, as above, or about where the hand was.
# - Sentences: an utterance has as many words in each demonstration, one for the object and one for the movement; what
#   is left over means nothing.
# - Depth, forces, grasping: hands are points on a table.
# - Changes of mind: a demonstration weighs as much after an hour as after a minute.
