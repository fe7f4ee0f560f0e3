"""Belts: sand that falls on one grain by grain, and a block that is put on one."""

from collections.abc import Iterator

from sandbox.model.expressions import Expression
from validation.case import Case, Choices, Expected
from validation.formulas import newton

SAND: Choices = (
    {},
    {"v": 1.5, "grain": 2.0, "every": 0.4, "mu": 0.5},
    {"v": 0.5, "grain": 0.1, "every": 0.8, "mu": 1.0},
)
BLOCKS: Choices = (
    {},
    {"v": 3.0, "mu": 0.25, "g": 5.0, "mass": 0.1},
    {"v": 1.0, "mu": 0.8, "g": 15.0, "mass": 10.0},
)


def cases() -> Iterator[Case]:
    """Yield the cases of belts."""
    for parameters in SAND:
        for count in (1, 4, 6):
            yield Case(
                name=f"conveyor belt: momentum after {count} of 6 grains",
                level="newton/conveyor-belt",
                parameters=parameters,
                quantity="system.momentum.x",
                at=Expression(f"{count}*every + 0.6"),
                expected=_caught(count),
                tolerance=1e-12,
                because="friction brings each grain to the belt's speed exactly",
            )
    for parameters in BLOCKS:
        yield Case(
            name="block on a belt: way at every step",
            level="newton/block-on-a-belt",
            parameters=parameters,
            quantity="block.position.x",
            expected=lambda p, t: newton.carried_way(p["v"], p["mu"], p["g"], t),
            tolerance=1e-12,
            because="constant acceleration, and the end of slipping located within its step: 2e-15",
            naive_misses=5e-4,
        )


def _caught(grains: int) -> Expected:
    """Return the momentum of so many grains, by the rate at which they come."""
    return lambda p, _: newton.belt_momentum(p["v"], p["grain"] / p["every"], grains * p["every"])
