"""
The paper in ten steps
======================

One session of Cederborg and Oudeyer, *Imitating Operations On Internal Cognitive Structures for Language Acquisition*
(Humanoids 2011), with every step a function. Names in the code are links into the reference.
"""

import numpy as np

import signimit as si
from signimit.plots import paper as figures

# %%
# 1. Somebody signs, somebody moves
# ---------------------------------
#
# The *signer* makes two signs, the first for an object, the second for a movement. The *mover* answers with a hand.
# These people are synthetic. The seed is **chosen**: it is the session in which the paper's figures come out, and most
# seeds are not like it. :doc:`/why_the_paper_does_worse` says what it takes.
from signimit.teaching import choose_people

seed = 35
people = choose_people(si.PAPER_LANGUAGE, np.random.default_rng([seed, 1]))

# %%
# 2. Twelve demonstrations (II-A)
# -------------------------------
#
# Six of nine pairs of signs are shown, twice each. The imitator gets signs, objects and the path of the hand, and
# nothing else; ``session.truth`` is for the judge.
from signimit_envs.sessions.session import SessionPlan

session = SessionPlan(seed=seed, attempts=2).as_in_paper().compose(people)
demonstrations = session.demonstrations
demonstrations[0]

# %%
# 3. Signs as points (II-A)
# -------------------------
#
# A sign becomes its similarities to three prototype signs, by dynamic time warping.
space = si.SignSpace(session.prototypes)
points = np.array([[space.embed(sign) for sign in d.signs] for d in demonstrations])
points.shape  # demonstrations, words, prototypes

# %%
# 4. How unlike two paths are (II-B)
# ----------------------------------
#
# Δ is the mean squared angle between the directions of motion at nearest places. It depends on the object from which
# each path is seen, so there is one number for each two demonstrations and each two objects.
distances = si.policy_distances(demonstrations.paths, demonstrations.objects)
distances.shape

# %%
# 5. How alike, in all frames: figure 5 (II-B)
# --------------------------------------------
#
# The rows and columns are sorted by what was really shown, so that the eye finds what the imitator has to find.
similarities = si.policy_similarities(distances)
figures.draw_similarities(similarities, session.truth.movement)

# %%
# 6. The best frames of each pair: figure 6
# -----------------------------------------
similarity = si.maximum_similarities(distances)
figures.draw_maximum_similarity(similarity, session.truth.movement)

# %%
# 7. Algorithm 1: movements (II-C)
# --------------------------------
#
# Each demonstration belongs, more or less, to each of twelve groups; demonstrations that are alike pull each other into
# one. As printed the rule leaves all memberships near 1/N, as the second line shows; `group_movements` says how the
# rule that works is read out of the text.
grouping = si.group_movements(similarity, rng=seed)
printed = si.group_movements(similarity, method="paper-literal", rng=seed)
print("as it works:", grouping.labels, "as printed, largest membership:", printed.memberships.max().round(2))
figures.draw_memberships(grouping.history, grouping.labels)

# %%
# 8. What each was about: figure 4 (II-C)
# ---------------------------------------
#
# A demonstration was about the object from which it looks most like the others of its movement.
focus = si.infer_focus(distances, grouping.labels)
figures.draw_demonstrations(demonstrations, grouping.labels, focus)

# %%
# 9. Which word is which (II-C), and new signs (II-D)
# ---------------------------------------------------
print(si.infer_word_order(points, grouping.labels, focus))
model = si.learn(demonstrations, session.prototypes, method="paper", policy="knn", rng=seed)  # all of the above
print(model.summary())

# %%
# 10. Obeying: figure 7 (II-E, III)
# ---------------------------------
#
# Each pair of signs is asked for twice in new scenes, three pairs of them for the first time ever (framed). The
# direction of the 50 nearest points moves the hand, of a simulated arm each. `performed` says what was drawn.
from signimit_envs import reproduce_many

responses = [model.respond(command.signs, command.objects) for command in session.commands]
hands = [command.hand for command in session.commands]
tracks = reproduce_many([response.policy for response in responses], hands, seconds=10.0)
paths, obeyed = {}, {}
for command, path in zip(session.commands, tracks.paths, strict=True):
    done = si.performed(path, command.objects, session.truth.templates)
    paths.setdefault(command.request, []).append(path - command.objects[command.request.focus])
    obeyed.setdefault(command.request, []).append((done.movement, done.focus) == command.request)
language = si.PAPER_LANGUAGE
figures.draw_reproductions(paths, obeyed, language.movements, language.held_back, "The paper's method")

# %%
# The same demonstrations, with the defaults of `learn`: every hand is to obey.
ours = si.learn(demonstrations)
policies = [ours.respond(command.signs, command.objects).policy for command in session.commands]
done = [
    si.performed(path, command.objects, session.truth.templates)[:2] == command.request
    for path, command in zip(reproduce_many(policies, hands, seconds=10.0).paths, session.commands, strict=True)
]
print(f"{sum(done)} of {len(done)} obeyed")
assert sum(done) >= sum(map(sum, obeyed.values()))
