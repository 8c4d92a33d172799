"""Demonstrations: exactly what the imitator may see, and nothing more (paper, section II-A).

Labels, requested movements and the demonstrator's focus are not here and must never be; they live in
`signimit.teaching.composition.GroundTruth`, with the evaluator.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Self, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from signimit.exceptions import FileFormatError, InvalidInputError
from signimit.io.archive import read_archive, write_archive
from signimit.names import check_names, names_from_array
from signimit.notebook import demonstrations_html
from signimit.strokes import cut, flatten
from signimit.validation import FARTHEST, LEAST_MOVE, finite_array, increasing_times, item_list, moving_points

KIND, VERSION = "demonstration set", 1
_WIDEST = FARTHEST / 2  # m, from the table's middle: so far from there, two places are not too far from each other


@dataclass(frozen=True, eq=False)
class Demonstration:
    """One exchange between the interactant, who signs, and the demonstrator, who moves (paper, section II-A).

    Attributes:
        signs: The utterance, W hand signs in the order they were made, each of shape (T_s, 2), any unit.
        objects: Positions of the objects, shape (O, 2), m, table frame.
        hand: The demonstrator's hand, shape (T, 2), m, table frame.
        times: When the hand was there, shape (T,), s, strictly increasing.
    """

    signs: tuple[NDArray[np.float64], ...]
    objects: NDArray[np.float64]
    hand: NDArray[np.float64]
    times: NDArray[np.float64]

    def __init__(self, signs: Iterable[ArrayLike], objects: ArrayLike, hand: ArrayLike, times: ArrayLike) -> None:
        """Copy, check and make read-only.

        Raises:
            InvalidInputError: Names the field, what was expected and what was found.
        """
        utterance = tuple(moving_points(s, f"sign {i}") for i, s in enumerate(item_list(signs, "signs")))
        places = finite_array(objects, "objects", (None, 2), _WIDEST)
        if not len(places):
            raise InvalidInputError("objects", "at least one position", "none")
        path = moving_points(hand, "hand", _WIDEST, LEAST_MOVE)
        object.__setattr__(self, "signs", utterance)
        object.__setattr__(self, "objects", places)
        object.__setattr__(self, "hand", path)
        object.__setattr__(self, "times", increasing_times(times, "times", len(path)))

    def __repr__(self) -> str:
        """Say its sizes, e.g. ``Demonstration(signs=2, objects=3, samples=250)``."""
        return f"Demonstration(signs={len(self.signs)}, objects={len(self.objects)}, samples={len(self.hand)})"


@dataclass(frozen=True, eq=False)
class DemonstrationSet(Sequence[Demonstration]):
    """N demonstrations of one language (paper, section II-A): same number of words and of objects throughout.

    Attributes:
        demonstrations: The demonstrations, in the order they were seen.
        object_names: What the objects are called where words are printed; None for colours. Nothing is learned from it.

    Example:
        >>> import numpy as np
        >>> from signimit import Demonstration, DemonstrationSet
        >>> line = np.array([[0.0, 0.0], [0.1, 0.0]])
        >>> shown = Demonstration(signs=[line, -line], objects=[[0.1, 0.0], [0.3, 0.2]], hand=line, times=[0.0, 1.0])
        >>> DemonstrationSet([shown, shown], object_names=("cup", "plate"))
        DemonstrationSet(2 demonstrations, signs=2, objects=2)
    """

    demonstrations: tuple[Demonstration, ...]
    object_names: tuple[str, ...] | None = None

    def __init__(self, demonstrations: Iterable[Demonstration], object_names: Iterable[str] | None = None) -> None:
        """Gather demonstrations.

        Args:
            demonstrations: The demonstrations, at least one.
            object_names: One for each object; left out, they are called by colours.

        Raises:
            InvalidInputError: If there are none, one differs in words or objects from the first, or the names cannot be
                printed and told apart.
        """
        object.__setattr__(self, "demonstrations", tuple(item_list(demonstrations, "demonstration set")))
        for i, demonstration in enumerate(self.demonstrations):
            if not isinstance(demonstration, Demonstration):
                raise InvalidInputError(f"demonstration {i}", "a Demonstration", type(demonstration).__name__)
        first = self.demonstrations[0]
        for i, other in enumerate(self.demonstrations):
            for field in ("signs", "objects"):
                want, have = len(getattr(first, field)), len(getattr(other, field))
                if have != want:
                    raise InvalidInputError(f"demonstration {i}: {field}", f"{want} as in demonstration 0", f"{have}")
        named = None if object_names is None else check_names(object_names, "object_names", len(first.objects))
        object.__setattr__(self, "object_names", named)

    @overload
    def __getitem__(self, index: int) -> Demonstration: ...
    @overload
    def __getitem__(self, index: slice) -> DemonstrationSet: ...
    def __getitem__(self, index: int | slice) -> Demonstration | DemonstrationSet:
        """Return one demonstration, or a smaller set."""
        if isinstance(index, slice):
            return DemonstrationSet(self.demonstrations[index], self.object_names)
        return self.demonstrations[index]

    def __iter__(self) -> Iterator[Demonstration]:
        """Go through the demonstrations."""
        return iter(self.demonstrations)

    def __len__(self) -> int:
        """Return N."""
        return len(self.demonstrations)

    def __repr__(self) -> str:
        """Say its sizes, e.g. ``DemonstrationSet(12 demonstrations, signs=2, objects=3)``."""
        first = self.demonstrations[0]
        counts = f"{len(self)} demonstration{'s' * (len(self) != 1)}"
        return f"DemonstrationSet({counts}, signs={len(first.signs)}, objects={len(first.objects)})"

    def _repr_html_(self) -> str:
        """Draw signs, scenes and hands, as notebooks show it."""
        return demonstrations_html(self)

    @property
    def paths(self) -> list[NDArray[np.float64]]:
        """Hand paths, N of shape (T_t, 2), m, table frame."""
        return [d.hand for d in self.demonstrations]

    @property
    def times(self) -> list[NDArray[np.float64]]:
        """Time stamps, N of shape (T_t,), s."""
        return [d.times for d in self.demonstrations]

    @property
    def objects(self) -> NDArray[np.float64]:
        """Object positions, shape (N, O, 2), m, table frame."""
        return np.stack([d.objects for d in self.demonstrations])

    @property
    def signs(self) -> list[tuple[NDArray[np.float64], ...]]:
        """Utterances: N tuples of W strokes."""
        return [d.signs for d in self.demonstrations]

    def check_command(
        self, signs: Iterable[ArrayLike], objects: ArrayLike
    ) -> tuple[list[NDArray[np.float64]], NDArray[np.float64]]:
        """Return an utterance, W signs of shape (T_s, 2), and a scene, shape (O, 2), m, like those of this set.

        Raises:
            InvalidInputError: If there are not as many signs or objects.
        """
        utterance = [moving_points(s, f"sign {i}") for i, s in enumerate(item_list(signs, "signs"))]
        if len(utterance) != len(self[0].signs):
            raise InvalidInputError("signs", f"{len(self[0].signs)} as in the demonstrations", f"{len(utterance)}")
        return utterance, finite_array(objects, "objects", (len(self[0].objects), 2))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a ``.npz`` file without pickles, whole or not at all."""
        write_archive(path, KIND, VERSION, self.to_arrays())

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """Read what `save` wrote.

        Raises:
            FileFormatError: Names the file, the demonstration and the field.
        """
        arrays, _ = read_archive(path, KIND, VERSION)
        return cls.from_arrays(arrays, os.fspath(path))

    def to_arrays(self) -> dict[str, NDArray[Any]]:
        """Return the set as flat arrays, the layout of the file."""
        hands, times, hand_offsets = flatten([(d.hand, d.times) for d in self.demonstrations])
        strokes = [(s, np.arange(len(s), dtype=np.float64)) for d in self.demonstrations for s in d.signs]
        signs, _, sign_offsets = flatten(strokes)
        named = {} if self.object_names is None else {"object_names": np.array(self.object_names)}
        return {
            "objects": self.objects,
            "hand": hands,
            "times": times,
            "hand_offsets": hand_offsets,
            "signs": signs,
            "sign_offsets": sign_offsets,
            **named,
        }

    @classmethod
    def from_arrays(cls, arrays: dict[str, NDArray[Any]], where: str) -> Self:
        """Rebuild a set from `to_arrays`, complaining about ``where`` if that cannot be."""
        try:
            objects = finite_array(arrays["objects"], "objects", (None, None, 2))
            hands, times = (cut(arrays[name], name, arrays["hand_offsets"]) for name in ("hand", "times"))
            strokes = cut(arrays["signs"], "signs", arrays["sign_offsets"])
            count, words = len(hands), len(strokes) // max(1, len(hands))
            if len(objects) != count or words * count != len(strokes):
                raise InvalidInputError(
                    "demonstrations",
                    f"objects and signs for {count} hands",
                    f"{len(objects)} and {len(strokes)}",
                )
            named = None
            if "object_names" in arrays:
                named = names_from_array(arrays["object_names"], "object_names")
            made = []
            for i, hand in enumerate(hands):
                signs = strokes[i * words : (i + 1) * words]
                try:
                    made.append(Demonstration(tuple(signs), objects[i], hand, times[i]))
                except InvalidInputError as error:
                    raise error.inside(f"demonstration {i}") from None
            return cls(made, named)
        except KeyError as error:
            raise FileFormatError(where, f"an array {error}", "none") from None
        except InvalidInputError as error:
            raise FileFormatError(f"{where}: {error.where}", error.expected, error.found) from None
