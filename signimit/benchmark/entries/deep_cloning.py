"""Behaviour cloning by a small deep network, with and without attention to objects. Needs PyTorch."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.benchmark.entries.cloning import Layer, collect_moments, perceptron_output, sigmoid_weighted
from signimit.benchmark.protocol import Kit, Observation
from signimit.demonstrations import DemonstrationSet
from signimit.exceptions import MissingDependencyError
from signimit.signs import normalised_sign

try:
    import torch
    from torch import Tensor, nn
except ImportError:
    raise MissingDependencyError("torch", "deep", "A deep entry") from None

SAMPLES = 32  # points of a sign
CODE = 16  # numbers that stand for a sign
HIDDEN = 128
STEPS, STEPS_EACH = 2000, 4  # batches, and how many more for each demonstration
UTTERANCES, MOMENTS = 32, 256  # of a batch, about
LEARNING_RATE, WEIGHT_DECAY = 2e-3, 1e-4
ASTRAY = 0.06  # m, the most that the standard deviation of a hand's disturbance is
PULL = 2.0  # 1/s, how fast a hand that is astray goes back
SIGN_NOISE = 0.05  # half sizes of a sign
SPEED = 0.35  # m/s, brings velocities to the order of 1
NEAR = 0.1  # m, brings places to the order of 1
OPENING = 1.0  # s after which the time tells no more: before, the hand reaches


class SignConditionedNetwork(nn.Module):  # type: ignore[misc, unused-ignore]
    """Network from the code of an utterance, the place of the hand and the time to a velocity.

    Each sign is encoded by the same two convolutions. With attention, the code chooses softly among the objects and the
    hand's place is seen from what it chose; without, from all objects at once.
    """

    def __init__(self, words: int, objects: int, attention: bool) -> None:
        """Make the layers."""
        super().__init__()
        self.encoder = nn.Sequential(
            nn.Conv1d(4, 16, 5, stride=2, padding=2),
            nn.ReLU(),
            nn.Conv1d(16, 32, 5, stride=2, padding=2),
            nn.ReLU(),
            nn.Flatten(),
            nn.Linear(32 * SAMPLES // 4, CODE),
            nn.Tanh(),
        )
        self.attention = nn.Linear(words * CODE, objects) if attention else None
        self.head = nn.Sequential(
            nn.Linear(words * CODE + (2 if attention else 2 * objects) + 1, HIDDEN),
            nn.SiLU(),
            nn.Linear(HIDDEN, HIDDEN),
            nn.SiLU(),
            nn.Linear(HIDDEN, 2),
        )

    def encode(self, signs: Tensor) -> Tensor:
        """Encode utterances, shape (B, W, 4, 32), as (B, W * 16)."""
        batch, words = signs.shape[:2]
        code: Tensor = self.encoder(signs.reshape(batch * words, 4, SAMPLES))
        return code.reshape(batch, -1)

    def weigh(self, code: Tensor) -> Tensor | None:
        """Return how much each object counts, shape (B, O), or None where none is chosen."""
        return None if self.attention is None else torch.softmax(self.attention(code), dim=1)

    def forward(self, code: Tensor, places: Tensor, time: Tensor) -> Tensor:
        """Compute velocities, shape (B, 2), from codes, hands seen from objects (B, O, 2), and times (B, 1)."""
        weights = self.weigh(code)
        seen = places.flatten(1) if weights is None else (weights[:, :, None] * places).sum(dim=1)
        velocity: Tensor = self.head(torch.cat([code, seen, time], dim=1))
        return velocity

    def head_layers(self) -> list[Layer]:
        """Return the weights and biases from code, place and time to velocity."""
        linear = [layer for layer in self.head if isinstance(layer, nn.Linear)]
        return [(_array(layer.weight).T, _array(layer.bias)) for layer in linear]


def _array(tensor: Tensor) -> NDArray[np.float64]:
    return np.asarray(tensor.detach().numpy(), dtype=np.float64)


def sign_channels(signs: Sequence[ArrayLike]) -> NDArray[np.float32]:
    """Describe an utterance by the places and directions along its signs, shape (W, 4, 32)."""
    described = []
    for sign in signs:
        places = normalised_sign(sign, SAMPLES)
        along = np.gradient(places, axis=0)
        along /= np.linalg.norm(along, axis=1, keepdims=True) + 1e-9
        described.append(np.concatenate([places.T, along.T]))
    return np.stack(described).astype(np.float32)


@contextmanager
def reproducible_torch(seed: int) -> Iterator[None]:
    """Let PyTorch compute the same bytes every time on this machine, and leave its settings as they were."""
    threads, strict = torch.get_num_threads(), torch.are_deterministic_algorithms_enabled()
    lenient = torch.is_deterministic_algorithms_warn_only_enabled()
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        torch.set_num_threads(1)
        torch.use_deterministic_algorithms(True)
        try:
            yield
        finally:
            torch.set_num_threads(threads)
            torch.use_deterministic_algorithms(strict, warn_only=lenient)


class TrainingSet(NamedTuple):
    """Training set as tensors: N utterances and M moments.

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

    With attention it has a place for a focus, one object chosen by the signs, which it is not told; without, it
    is the same network with the hand's place among all objects for input.
    """

    def __init__(self, kit: Kit, attention: bool) -> None:
        """Store the session's random generator."""
        self._rng, self._attention = kit.rng, attention

    def observe(self, demonstrations: DemonstrationSet) -> None:
        """Train the network."""
        training = _training_set(demonstrations)
        words, objects = training.signs.shape[1], training.places.shape[1]
        with reproducible_torch(int(self._rng.integers(2**31))):
            self._network = SignConditionedNetwork(words, objects, self._attention)
            _train(self._network, training)
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
        """Evaluate the network."""
        places = (observation.hand - self._objects) / NEAR
        seen = places.ravel() if self._weights is None else self._weights @ places
        time = min(observation.seconds / OPENING, 1.0)
        inputs = np.concatenate([self._code, seen, [time]])
        return SPEED * perceptron_output(self._layers, inputs, sigmoid_weighted)


def _training_set(demonstrations: DemonstrationSet) -> TrainingSet:
    moments = collect_moments(demonstrations)
    length = np.bincount(moments.demonstration)
    time = np.concatenate([times - times[0] for times in demonstrations.times])
    arrays = (
        np.stack([sign_channels(signs) for signs in demonstrations.signs]),
        np.cumsum(length) - length,
        length,
        ((moments.hand[:, None] - demonstrations.objects[moments.demonstration]) / NEAR).astype(np.float32),
        (moments.velocity / SPEED).astype(np.float32),
        np.minimum(time / OPENING, 1.0)[:, None].astype(np.float32),
    )
    return TrainingSet(*(torch.from_numpy(array) for array in arrays))


def _train(network: SignConditionedNetwork, training: TrainingSet) -> None:
    """Minimise the squared error of velocities."""
    steps = STEPS + STEPS_EACH * len(training.signs)
    optimiser = torch.optim.AdamW(network.parameters(), lr=LEARNING_RATE, weight_decay=WEIGHT_DECAY)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimiser, LEARNING_RATE, total_steps=steps)
    for _ in range(steps):
        optimiser.zero_grad()
        _batch_loss(network, training).backward()  # type: ignore[no-untyped-call, unused-ignore]
        optimiser.step()
        schedule.step()


def _batch_loss(network: SignConditionedNetwork, training: TrainingSet) -> Tensor:
    """Return the error on random moments of random demonstrations.

    Signs are blurred a little. Hands are put astray and shall go back, so that errors do not grow (Laskey et al., DART,
    CoRL 2017).
    """
    shown = torch.randperm(len(training.signs))[:UTTERANCES]
    count, each = len(shown), -(-MOMENTS // len(shown))
    signs = training.signs[shown]
    code = network.encode(signs + SIGN_NOISE * torch.randn_like(signs)).repeat_interleave(each, dim=0)
    within = torch.rand(count, each) * training.length[shown, None]
    moment = (training.first[shown, None] + within.long()).flatten()
    astray = torch.randn(len(moment), 2) * torch.rand(len(moment), 1) * ASTRAY
    velocity = training.velocity[moment] - (PULL / SPEED) * astray
    given = network(code, training.places[moment] + astray[:, None] / NEAR, training.time[moment])
    return torch.nn.functional.mse_loss(given, velocity)
