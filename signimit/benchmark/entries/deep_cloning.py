"""Behaviour cloning by a small deep network, with and without attention to objects. Needs PyTorch."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.benchmark.entries.deep_network import SignConditionedNetwork, reproducible_torch, sign_channels
from signimit.benchmark.entries.layers import perceptron_output, sigmoid_weighted
from signimit.benchmark.entries.samples import samples_of
from signimit.benchmark.protocol import Kit, Observation
from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import MissingDependencyError

try:
    import torch
    from torch import Tensor
except ImportError:
    raise MissingDependencyError("torch", "deep", "A deep entry") from None

STEPS, STEPS_EACH = 2000, 4  # batches, and how many more for each demonstration
UTTERANCES, MOMENTS = 32, 256  # of a batch, about
LEARNING_RATE, WEIGHT_DECAY = 2e-3, 1e-4
ASTRAY = 0.06  # m, the most that the standard deviation of a hand's disturbance is
PULL = 2.0  # 1/s, how fast a hand that is astray goes back
SIGN_NOISE = 0.05  # half sizes of a sign
SPEED = 0.35  # m/s, brings velocities to the order of 1
NEAR = 0.1  # m, brings places to the order of 1
OPENING = 1.0  # s after which the time tells no more: before, the hand reaches


class Lesson(NamedTuple):
    """Demonstrations as tensors: N utterances and M moments.

    Attributes:
        signs: Shape (N, W, 4, 32).
        first: Number of the first moment of each demonstration, shape (N,).
        length: How many it has, shape (N,).
        places: The hand seen from each object, shape (M, O, 2), in units of `NEAR`.
        velocity: Shape (M, 2), in units of `SPEED`.
        time: Shape (M, 1), in units of `OPENING`, 1 at most.
    """

    signs: Tensor
    first: Tensor
    length: Tensor
    places: Tensor
    velocity: Tensor
    time: Tensor


class DeepCloning:
    """A network trained end to end from signs, objects, hand and time to velocity.

    With attention it has a place for a focus, one object chosen by the signs, but nobody tells it which; without, it
    is the same network with the hand's place among all objects for input.
    """

    def __init__(self, kit: Kit, attention: bool) -> None:
        """Take the die."""
        self._rng, self._attention = kit.rng, attention

    def observe(self, demonstrations: DemonstrationSet) -> None:
        """Train."""
        lesson = _lesson(demonstrations)
        words, objects = lesson.signs.shape[1], lesson.places.shape[1]
        with reproducible_torch(int(self._rng.integers(2**31))):
            self._network = SignConditionedNetwork(words, objects, self._attention)
            _train(self._network, lesson)
        self._layers = self._network.head_layers()

    def begin(self, signs: tuple[NDArray[np.float64], ...], objects: NDArray[np.float64]) -> None:
        """Encode the signs; what depends on the hand is left to `act`."""
        with reproducible_torch(0), torch.inference_mode():
            code = self._network.encode(torch.from_numpy(sign_channels(signs))[None])
            weights = self._network.weigh(code)
        self._code = code[0].numpy().astype(np.float64)
        self._weights = None if weights is None else weights[0].numpy().astype(np.float64)
        self._objects = objects

    def act(self, observation: Observation) -> ArrayLike:
        """Ask the network."""
        places = (observation.hand - self._objects) / NEAR
        seen = places.ravel() if self._weights is None else self._weights @ places
        time = min(observation.seconds / OPENING, 1.0)
        inputs = np.concatenate([self._code, seen, [time]])
        return SPEED * perceptron_output(self._layers, inputs, sigmoid_weighted)


def _lesson(demonstrations: DemonstrationSet) -> Lesson:
    samples = samples_of(demonstrations)
    length = np.bincount(samples.demonstration)
    time = np.concatenate([times - times[0] for times in demonstrations.times])
    arrays = (
        np.stack([sign_channels(signs) for signs in demonstrations.signs]),
        np.cumsum(length) - length,
        length,
        ((samples.hand[:, None] - demonstrations.objects[samples.demonstration]) / NEAR).astype(np.float32),
        (samples.velocity / SPEED).astype(np.float32),
        np.minimum(time / OPENING, 1.0)[:, None].astype(np.float32),
    )
    return Lesson(*(torch.from_numpy(array) for array in arrays))


def _train(network: SignConditionedNetwork, lesson: Lesson) -> None:
    """Minimise the squared error of velocities."""
    steps = STEPS + STEPS_EACH * len(lesson.signs)
    optimiser = torch.optim.AdamW(network.parameters(), lr=LEARNING_RATE, weight_decay=WEIGHT_DECAY)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, LEARNING_RATE, total_steps=steps)
    for _ in range(steps):
        optimiser.zero_grad()
        _batch_loss(network, lesson).backward()  # type: ignore[no-untyped-call, unused-ignore]
        optimiser.step()
        schedule.step()


def _batch_loss(network: SignConditionedNetwork, lesson: Lesson) -> Tensor:
    """Return the error on random moments of random demonstrations.

    Signs are blurred a little. Hands are put astray and shall go back, so that errors do not grow (Laskey et al., DART,
    CoRL 2017).
    """
    shown = torch.randperm(len(lesson.signs))[:UTTERANCES]
    count, each = len(shown), -(-MOMENTS // len(shown))
    signs = lesson.signs[shown]
    code = network.encode(signs + SIGN_NOISE * torch.randn_like(signs)).repeat_interleave(each, dim=0)
    within = torch.rand(count, each) * lesson.length[shown, None]
    moment = (lesson.first[shown, None] + within.long()).flatten()
    astray = torch.randn(len(moment), 2) * torch.rand(len(moment), 1) * ASTRAY
    velocity = lesson.velocity[moment] - (PULL / SPEED) * astray
    given = network(code, lesson.places[moment] + astray[:, None] / NEAR, lesson.time[moment])
    return torch.nn.functional.mse_loss(given, velocity)
