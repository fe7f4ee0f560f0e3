"""A level as the recognisers of set-ups look at it."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from math import isfinite
from typing import Any, Literal

import numpy as np

from sandbox.editing.json_layout import plain
from sandbox.editing.placement import Core, Placed, distance
from sandbox.model.expressions import Expression, Values
from sandbox.model.joints import Joint, bodies_of
from sandbox.model.level import Level
from sandbox.model.rules.faults import corners

Check = Mapping[str, Any]
"""A check, as it stands in a level's file."""

TOUCHING = 1e-6
"""m, bodies closer than this touch."""

RATES = (60.0, 120.0, 240.0, 480.0, 960.0, 1920.0, 3840.0)
"""Hz, the rates that levels have."""

SAFE = 0.9
"""The time of a check, as a share of the time until the body meets something."""

SAMPLES = 400
"""At how many times obstacles are looked for."""

MOST_CORNERS = 8
"""How many corners of the parameters' ranges are tried."""


Setup = Literal[
    "Atwood machine", "block and tackle", "block on a slope", "block that a slope holds", "capstan",
    "collision", "falling body", "lever", "Newton's cradle", "oscillator", "pendulum",
    "spring pendulum", "thrown body",
]  # fmt: skip


@dataclass(frozen=True)
class Suggestion:
    """A known set-up, and the checks that compare it with its closed form.

    Attributes
    ----------
    setup
        The name of the set-up.
    about
        The bodies that it is made of.
    checks
        The checks, as they stand in a level's file.
    rate
        Hz, that they need at the least.
    located
        The bodies whose impacts must have their own time within a step.
    """

    setup: Setup
    about: tuple[str, ...]
    checks: tuple[Check, ...]
    rate: float = 60.0
    located: tuple[str, ...] = ()


@dataclass(frozen=True)
class Scene:
    """A level, with the values of its parameters.

    Attributes
    ----------
    level, values
        Which.
    thorough
        Whether what is said of it is to hold with all values of its parameters, which takes longer.
    """

    level: Level
    values: Values
    thorough: bool = False

    @cached_property
    def everywhere(self) -> Sequence["Scene"]:
        """The same with its parameters at the ends of their ranges, too, where that is wanted."""
        ends = corners(self.level, most=MOST_CORNERS) if self.thorough else ()
        return [self, *(Scene(self.level, values) for values in ends)]

    @cached_property
    def known(self) -> Values:
        """The values of parameters and constants, for composing new formulas."""
        return {**self.values, **{name: c(self.values) for name, c in self.level.constants.items()}}

    @cached_property
    def where(self) -> Mapping[str, Placed]:
        """All bodies where they start."""
        bodies = self.level.bodies.items()
        return {name: Placed(name, body, self.values) for name, body in bodies}

    @cached_property
    def joints(self) -> Mapping[str, list[str]]:
        """The joints that hold each body."""
        held: dict[str, list[str]] = {name: [] for name in self.level.bodies}
        for name, joint in self.level.joints.items():
            for body in set(bodies_of(joint)):
                held[body].append(name)
        return held

    @property
    def dynamic(self) -> list[str]:
        """The bodies that forces move."""
        return [name for name, body in self.level.bodies.items() if body.type == "dynamic"]

    def only(self, *effects: str) -> bool:
        """Whether nothing else acts than that."""
        return set(self.level.effects.declared) <= set(effects)

    @property
    def fall(self) -> Expression | None:
        """What the acceleration of gravity is along y, if it acts and points straight down."""
        gravity = self.level.effects.gravity
        if gravity is None or gravity.acceleration[0](self.values) != 0:
            return None
        return gravity.acceleration[1] if gravity.acceleration[1](self.values) < 0 else None

    def mass(self, name: str) -> str:
        """Return the mass of a dynamic body, as a formula."""
        mass = self.level.bodies[name].mass
        assert mass is not None
        return said(mass)

    def velocity(self, name: str) -> complex:
        """Return the velocity of a body at the start [m/s]."""
        return complex(*(v(self.values) for v in self.level.bodies[name].velocity))

    def rests(self, *names: str) -> bool:
        """Whether bodies neither move nor turn at the start."""
        bodies = [self.level.bodies[name] for name in names]
        spins = [body.angular_velocity(self.values) for body in bodies]
        return not any(map(self.velocity, names)) and not any(spins)

    @property
    def lasts(self) -> float:
        """How long a run is [s]."""
        return self.level.duration(self.values)

    def distance(self, name: str, way: complex, other: str) -> float:
        """Return how far a body that was moved would be from another one [m]."""
        return distance(self.where[name], self.where[other], way)

    def free_until(
        self, name: str, way: Callable[[float], complex], besides: Sequence[str] = ()
    ) -> float:
        """Return for how long a body would go its way without meeting another [s].

        Others that move are where they start. Without contact nothing is ever met.
        """
        if self.level.effects.contact is None:
            return self.lasts
        solid = (other for other, at in self.where.items() if not at.body.sensor)
        others = [other for other in solid if other not in (name, *besides)]
        for t in np.linspace(0, self.lasts, SAMPLES)[1:].tolist():
            if any(self.distance(name, way(t), other) < TOUCHING for other in others):
                return t - self.lasts / (SAMPLES - 1)
        return self.lasts

    def joint(self, name: str) -> Joint:
        """Return a joint."""
        return self.level.joints[name]


def moved(core: Core, way: complex) -> Core:
    """Return a core elsewhere."""
    return tuple(point + way for point in core)


def said(expression: Expression) -> str:
    """Return a number or a formula such that it can be multiplied: `m`, `2.5`, `(m + 1)`."""
    source = expression.source
    if not isinstance(source, str):
        return f"{plain(source)!r}" if source >= 0 else f"({plain(source)!r})"
    return source if source.isidentifier() else f"({source})"


def opposite(expression: Expression) -> str:
    """Return what is subtracted if it is added: of `-g` it is `g`."""
    source = expression.source
    if not isinstance(source, str):
        return f"{plain(-source)!r}"
    inner = source.strip().removeprefix("-").strip()
    return inner if source.strip().startswith("-") and inner.isidentifier() else f"(-({source}))"


def instant(time: float) -> float:
    """Return a time of two digits, not after another one [s]."""
    digits = float(f"{time:.1e}")
    return plain(digits if digits <= time else float(f"{time * 0.95:.1e}"))


def check(
    label: str, quantity: str, formula: str, tolerance: float, **more: object
) -> dict[str, Any]:
    """Return a check as it stands in a level's file; a number stands as one, not as a formula."""
    told = {"label": label, "quantity": quantity, "formula": formula, "tolerance": tolerance}
    return told | {key: _number(value) for key, value in more.items() if value is not None}


def _number(value: object) -> object:
    """Return a number for the text of one; anything else as it is."""
    with suppress(ValueError):
        if isinstance(value, str) and isfinite(number := float(value)):
            return plain(number)
    return value


def rate_of(least: float) -> float:
    """Return the first of the usual rates that is high enough [Hz]."""
    return next((rate for rate in RATES if rate >= least), RATES[-1])
