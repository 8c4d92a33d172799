"""Groups of options that several commands share, with what they stand for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from signimit.exceptions import InvalidInputError
from signimit.strokes import StrokeLibrary
from signimit.teaching.languages import Language
from signimit.teaching.people.choosing import People, Source, choose_people
from signimit.teaching.sessions import Condition


@dataclass(frozen=True, kw_only=True)
class PeopleOptions:
    """Who makes the signs and who shows the movements.

    Attributes:
        signs: Stroke library of real people (see `import-strokes`) who make the signs; left out, a synthetic person.
        signer: Writer of that library; left out, one is drawn.
        movements: Stroke library of real people who show the movements; left out, a synthetic person.
        mover: Writer of that library; left out, one is drawn.
    """

    signs: Path | None = None
    signer: str | None = None
    movements: Path | None = None
    mover: str | None = None

    def choose(self, language: Language, rng: np.random.Generator) -> People[StrokeLibrary]:
        """Choose a signer and a mover, as `choose_people` does."""
        return choose_people(language, rng, Source(self.signs, self.signer), Source(self.movements, self.mover))


SYNTHETIC_PEOPLE = PeopleOptions()


@dataclass(frozen=True, kw_only=True)
class CellOptions:
    """Which cells of a study are run, how often, and where.

    Attributes:
        sessions: How many sessions of each cell.
        first_seed: Seed of the first; the others follow.
        signs: Stroke library of real people who make signs; with movements, it adds the cells of real people.
        movements: Stroke library of real people who draw movements.
        only: Run only cells whose names contain this.
        workers: Processes; left out, one less than there are processors.
        out: Folder for what is written.
    """

    sessions: int = 20
    first_seed: int = 0
    signs: Path | None = None
    movements: Path | None = None
    only: str = ""
    workers: int = 0
    out: Path = Path("out/study")

    @property
    def seeds(self) -> range:
        """Seeds of the sessions."""
        return range(self.first_seed, self.first_seed + self.sessions)

    def choose(self, cells: Sequence[Condition]) -> list[Condition]:
        """Return the cells that are to be run.

        Raises:
            InvalidInputError: If there are none.
        """
        chosen = [cell for cell in cells if self.only in cell.name]
        if not chosen:
            raise InvalidInputError(
                "--only", f"part of the name of a cell ({'; '.join(cell.name for cell in cells)})", self.only
            )
        return chosen


ALL_CELLS = CellOptions()
