"""A small network that moves a hand as two signs ask for. Needs PyTorch."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.benchmark.entries.layers import Layer
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


class SignConditionedNetwork(nn.Module):  # type: ignore[misc, unused-ignore]
    """From the code of an utterance, the place of the hand and the time to a velocity.

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
