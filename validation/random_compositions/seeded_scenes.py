"""The scene of a seed, which is always the same."""

from dataclasses import dataclass

import numpy as np

from sandbox.model.level import Level
from validation.random_compositions.families import FAMILIES
from validation.random_compositions.scene_builder import Draft
from validation.stability.hard_case import make
from validation.stability.scene_parts import Document

TREES = 0.15
"""The share of scenes that are random trees."""

TREE = "tree"
"""The name of their family."""


@dataclass(frozen=True, slots=True)
class Scene:
    """A random composition."""

    seed: int
    family: str
    """The family that built it."""
    document: Document
    """The level, as in its file."""
    is_at_rest: bool = False
    """Whether it must stay at rest."""
    conserved_momenta: tuple[str, ...] = ()
    """The momenta that no outside force but gravity changes: of x, y, angle."""

    @property
    def name(self) -> str:
        """Its name: the family and the seed."""
        return f"{self.family}-{self.seed}"

    def level(self) -> Level:
        """Return the level; raise `LevelError` if it has mistakes."""
        return make(self.document)


def seeds(seed: int, count: int) -> list[int]:
    """Return a seed for each scene; the first ones do not depend on the number of scenes."""
    return [int(np.random.SeedSequence((seed, i)).generate_state(1)[0]) for i in range(count)]


def scene(seed: int, family: str | None = None) -> Scene:
    """Return the scene of a seed, from a given family if one is named."""
    draft = Draft(np.random.default_rng(seed))
    drawn = TREE if draft.chance(TREES) else draft.pick([n for n in FAMILIES if n != TREE])
    chosen = family or drawn
    FAMILIES[chosen](draft)
    title = f"{chosen.replace('_', ' ').capitalize()}, seed {seed}"
    return Scene(seed, chosen, draft.document(title), draft.is_at_rest, draft.conserved_momenta)
