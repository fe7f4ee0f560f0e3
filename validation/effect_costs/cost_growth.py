"""The growth of a step's cost with the number of bodies, here and in stock pymunk."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from sandbox.model.level_writing import text
from sandbox.model.loading import parse
from sandbox.model.many_body_level_generator import crowd
from sandbox.physics.measuring.step_timing import step_seconds
from sandbox.physics.run import build
from validation.case import naive

COUNTS: Mapping[str, Sequence[int]] = {"gas": (100, 1000, 10_000), "pile": (100, 1000, 5000)}
"""The numbers of bodies; pymunk takes half a minute to free a pile of 10,000."""

QUICK: Mapping[str, Sequence[int]] = {kind: counts[:2] for kind, counts in COUNTS.items()}

FALLS = 90
"""The number of steps after which falling bodies lie in a heap."""


@dataclass(frozen=True, slots=True)
class Growth:
    """The cost of a step per body, for several numbers of bodies."""

    scene: str
    """The kind of crowd."""
    bodies: tuple[int, ...]
    """(k,), the numbers of moving bodies."""
    seconds_per_body: tuple[float, ...]
    bare_seconds_per_body: tuple[float, ...]
    """(k,), the time of a step per body [s]; bare is stock pymunk."""
    contacts_per_body: tuple[float, ...]
    bare_contacts_per_body: tuple[float, ...]
    """(k,), the number of contacts per body: a small heap has relatively more surface."""


def growths(counts: Mapping[str, Sequence[int]] = COUNTS) -> Iterator[Growth]:
    """Measure every kind of crowd, compared with pymunk on the same scene."""
    for kind, numbers in counts.items():
        figures = [_figures(kind, number) for number in numbers]
        yield Growth(kind, tuple(numbers), *zip(*figures, strict=True))


def _figures(kind: str, number: int) -> tuple[float, ...]:
    """Return the seconds per body, ours and bare, and the contacts per body, ours and bare."""
    level = parse(text(crowd(kind, number)))
    worlds = [build(level), build(naive(level))]
    for world in worlds:
        for _ in range(FALLS):
            world.step()
    starts = [lambda world=world: world.step for world in worlds]  # each continues its own run
    seconds = step_seconds(starts, 20)
    contacts = [len(world.scene.batch.contacts().bodies) for world in worlds]
    return tuple(figure / number for figure in (*seconds, *contacts))
