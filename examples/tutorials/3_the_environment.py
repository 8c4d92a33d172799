"""
The environment
===============

`signimit_envs.TabletopEnv` is a Gymnasium environment whose instruction is not a string or a token, but unlabelled
motion: two signs, as a person drew them.
"""

# %%
# Spaces
# ------
#
# ``signimit/TabletopHand-v0`` takes velocities of the hand, ``signimit/Tabletop-v0`` those of the joints. What the
# signs ask for is not observed; it is in ``info``, for scoring.
import gymnasium as gym
import numpy as np

import signimit_envs

env = gym.make("signimit/TabletopHand-v0")
print(env.action_space)
for name, box in env.observation_space.items():
    print(f"{name:17}", box.shape, box.dtype)

# %%
# An episode begins with signs in a scene. ``options`` fixes what shall not be drawn at random.
import matplotlib.pyplot as plt

observation, info = env.reset(seed=0, options={"movement": 2, "focus": 0})
print(info["request"], "is what the signs ask for: a circle about the red object")
figure, axes = plt.subplots(1, 2, figsize=(5, 2.4), layout="constrained")
for panel, sign in zip(axes, observation["signs"], strict=True):
    panel.plot(*sign.T, color="black")
    panel.set(aspect="equal", xticks=[], yticks=[])

# %%
# Rewards
# -------
#
# The sparse reward is 1 at the step where the judge sees the request fulfilled for the first time, else 0; success does
# not end an episode, time does. A hand-written controller that goes round the red object clockwise:
red, reached = observation["objects"][0], []
for step in range(600):  # 12 s at 50 Hz
    x, y = observation["hand"] - red
    radius = np.hypot(x, y) + 1e-9
    pull = 4 * (radius / 0.105 - 1)
    velocity = 0.35 * np.array([y - pull * x, -x - pull * y]) / radius  # m/s
    observation, reward, terminated, truncated, info = env.step(velocity / env.unwrapped.max_hand_speed)
    if reward:
        reached.append(step / 50)
print(f"rewarded after {reached} s; {info['performance']}")
assert len(reached) == 1
env.close()

# %%
# The dense reward adds a potential: how much of the drawing the hand has passed, and how close it is. It leaves the
# optimal policies as they are.
dense = gym.make("signimit/TabletopHand-v0", reward="dense", discount=0.99)
dense.reset(seed=0)
print([round(float(dense.step(dense.action_space.sample() * 0)[1]), 4) for _ in range(3)])
dense.close()

# %%
# Another language
# ----------------
#
# Signs, objects, movements and word order are arguments, and survive ``EnvSpec.to_json``. Here four objects, and a word
# between that means nothing.
language = {
    "focus_signs": ["1", "2", "star", "spiral"], "movement_signs": ["4", "5"], "movements": ["circle", "zigzag"],
    "focus_word": 2, "movement_word": 0, "filler_signs": ["8", "9"],
}  # fmt: skip
other = gym.make("signimit/TabletopHand-v0", language=language)
observation, info = other.reset(seed=1)
print(observation["objects"].shape, observation["signs"].shape, info["request"])
other.close()

# %%
# Pictures
# --------
#
# Pictures need OpenGL, also without a display (:doc:`/headless`). Where there is none, a `RenderingError` says what is
# missing and what to install, and everything but pictures goes on.
painter = gym.make("signimit/TabletopHand-v0", render_mode="rgb_array", obs_type="pixels", size=(240, 320))
try:
    seen, _ = painter.reset(seed=0)
    figure, axes = plt.subplots(1, 2, figsize=(7, 4.6), layout="constrained")
    for panel, picture, title in zip(
        axes, (seen, painter.render()), ("observed: signs on cards", "rendered"), strict=True
    ):
        panel.imshow(picture)
        panel.set(xticks=[], yticks=[], title=title)
except signimit_envs.RenderingError as error:
    print(f"No pictures here. {error}")
painter.close()

# %%
# Wrappers
# --------
#
# Gymnasium's work as ever. `signimit_envs.RecordMp4` films episodes, `signimit_envs.recording.EpisodeRecorder` keeps
# them so that they replay to the last bit.
from signimit_envs.recording import EpisodeRecorder, find_divergence

recorder = EpisodeRecorder(gym.wrappers.TimeLimit(gym.make("signimit/TabletopHand-v0"), 50))
recorder.reset(seed=0)
recorder.action_space.seed(0)
while not recorder.step(recorder.action_space.sample())[3]:
    pass
recorder.close()
recording = recorder.recording
print(recording, "diverges:", find_divergence(recording.origin, recording[0]))

# %%
# Many at once
# ------------
#
# Gymnasium's vector environments, or, for learned policies, `signimit_envs.reproduce_many`, which is faster by far.
vector = gym.make_vec("signimit/TabletopHand-v0", num_envs=4, vectorization_mode="sync")
observations, infos = vector.reset(seed=0)
observations, rewards, *_ = vector.step(vector.action_space.sample())
print(observations["signs"].shape, rewards)
vector.close()

# %%
# A model obeys in the environment
# --------------------------------
#
# The environment's own language, demonstrated by its own people, then learned without a label; the answer to the signs
# that are observed is a policy, and the policy plugs into the environment.
import signimit as si

env = gym.make("signimit/TabletopHand-v0")
people = env.unwrapped.people
demonstrations, _ = si.compose_demonstrations(people.language, people.signs, people.movements, np.random.default_rng(0))
model = si.learn(demonstrations)
obeyed = 0
for seed in range(3):
    observation, info = env.reset(seed=seed)
    answer = model.respond(observation["signs"], observation["objects"])
    state = answer.policy.start()
    for _ in range(600):
        state, velocity = answer.policy.step(state, observation["hand"])
        action = np.clip(velocity / env.unwrapped.max_hand_speed, -1, 1)
        observation, reward, terminated, truncated, info = env.step(action)
        obeyed += int(reward)
env.close()
print(f"{obeyed} of 3 obeyed")
assert obeyed >= 2

# %%
# Training
# --------
#
# Anything that learns from rewards can be trained: ``signimit train --steps 100000`` trains PPO of stable-baselines3
# (the extra ``rl``) with the dense reward, as a baseline. It is rewarded for obeying, which the learners of signimit
# never are.
