"""A level as the recognisers of set-ups see it."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from math import isfinite
from typing import Any, Literal

import numpy as np

from sandbox.editing.bodies_at_start import Core, PlacedBody, distance
from sandbox.editing.inserted_value_layout import plain
from sandbox.model.expressions import Expression, Values
from sandbox.model.joints import Rod, Rope, Spring, bodies_of, body_of
from sandbox.model.level import Level
from sandbox.model.rules.level_validation import corners

Check = Mapping[str, Any]
"""A check, as in a level's file."""

TOUCHING = 1e-6
"""m, the largest gap at which bodies touch."""

RATES = (60.0, 120.0, 240.0, 480.0, 960.0, 1920.0, 3840.0)
"""Hz, the usual rates of levels."""

SAFE = 0.9
"""The time of a check, as a share of the time until the body meets something."""

SAMPLES = 400
"""The number of times at which obstacles are searched."""

MOST_CORNERS = 8
"""The largest number of corners of the parameters' ranges that are tried."""


Setup = Literal[
    "Atwood machine", "block and tackle", "block on a slope", "block that a slope holds", "capstan",
    "collision", "falling body", "lever", "Newton's cradle", "oscillator", "pendulum",
    "spring pendulum", "thrown body",
]  # fmt: skip


@dataclass(frozen=True)
class Suggestion:
    """A known set-up, and the checks that compare it with its closed form."""

    setup: Setup
    """The name of the set-up."""
    about: tuple[str, ...]
    """Its bodies."""
    checks: tuple[Check, ...]
    """The checks, as in a level's file."""
    rate: float = 60.0
    """The least rate that the checks need [Hz]."""
    located: tuple[str, ...] = ()
    """The bodies whose impacts must be located within a step."""


@dataclass(frozen=True)
class Scene:
    """A level, with the values of its parameters."""

    level: Level
    values: Values
    """The level, and the values of its parameters."""
    thorough: bool = False
    """Whether closed forms must hold for all values of the parameters, which takes longer."""

    @cached_property
    def everywhere(self) -> Sequence["Scene"]:
        """The scene, and if `thorough` those with parameters at the ends of their ranges."""
        ends = corners(self.level, most=MOST_CORNERS) if self.thorough else ()
        return [self, *(Scene(self.level, values) for values in ends)]

    @cached_property
    def known_values(self) -> Values:
        """The values of parameters and constants, for new formulas."""
        return {**self.values, **{name: c(self.values) for name, c in self.level.constants.items()}}

    @cached_property
    def where(self) -> Mapping[str, PlacedBody]:
        """All bodies at the start."""
        bodies = self.level.bodies.items()
        return {name: PlacedBody(name, body, self.values) for name, body in bodies}

    @cached_property
    def joints(self) -> Mapping[str, list[str]]:
        """The names of the joints that hold each body."""
        joints: dict[str, list[str]] = {name: [] for name in self.level.bodies}
        for name, joint in self.level.joints.items():
            for body in set(bodies_of(joint)):
                joints[body].append(name)
        return joints

    def held_by(self, joint: Rod | Rope | Spring) -> str | None:
        """Return the dynamic body that a joint, and no other, ties by its centre to the plane."""
        joined = [end for end in joint.ends if body_of(end)]
        if len(joined) != 1 or not isinstance(bob := joined[0], str):
            return None
        return bob if bob in self.dynamic and len(self.joints[bob]) == 1 else None

    @property
    def dynamic(self) -> list[str]:
        """The names of the dynamic bodies."""
        return [name for name, body in self.level.bodies.items() if body.type == "dynamic"]

    def only(self, *effects: str) -> bool:
        """Return whether no other effects are declared."""
        return set(self.level.effects.declared) <= set(effects)

    @property
    def gravity_y(self) -> Expression | None:
        """The y component of the acceleration of gravity if it points straight down, else None."""
        gravity = self.level.effects.gravity
        if gravity is None or gravity.acceleration[0](self.values) != 0:
            return None
        return gravity.acceleration[1] if gravity.acceleration[1](self.values) < 0 else None

    def mass(self, name: str) -> str:
        """Return the mass of a dynamic body, as a formula."""
        mass = self.level.bodies[name].mass
        assert mass is not None
        return as_factor(mass)

    def velocity(self, name: str) -> complex:
        """Return the velocity of a body at the start [m/s]."""
        return complex(*(v(self.values) for v in self.level.bodies[name].velocity))

    def is_at_rest(self, *names: str) -> bool:
        """Return whether bodies are at rest at the start."""
        bodies = [self.level.bodies[name] for name in names]
        spins = [body.angular_velocity(self.values) for body in bodies]
        return not any(map(self.velocity, names)) and not any(spins)

    @property
    def duration(self) -> float:
        """The duration of a run [s]."""
        return self.level.duration(self.values)

    def distance(self, name: str, displacement: complex, other: str) -> float:
        """Return the gap between a displaced body and another [m]."""
        return distance(self.where[name], self.where[other], displacement)

    def free_until(
        self, name: str, path: Callable[[float], complex], besides: Sequence[str] = ()
    ) -> float:
        """Return the time for which a body can move along a path without meeting another [s].

        Other moving bodies are taken at their initial positions. Without contact nothing is met.
        """
        if self.level.effects.contact is None:
            return self.duration
        solid = (other for other, at in self.where.items() if not at.body.sensor)
        others = [other for other in solid if other not in (name, *besides)]
        for t in np.linspace(0, self.duration, SAMPLES)[1:].tolist():
            if any(self.distance(name, path(t), other) < TOUCHING for other in others):
                return t - self.duration / (SAMPLES - 1)
        return self.duration


def displaced(core: Core, displacement: complex) -> Core:
    """Return a displaced core."""
    return tuple(point + displacement for point in core)


def as_factor(expression: Expression) -> str:
    """Return a number or a formula as a factor, in brackets if needed: `m`, `2.5`, `(m + 1)`."""
    source = expression.source
    if not isinstance(source, str):
        return f"{plain(source)!r}" if source >= 0 else f"({plain(source)!r})"
    return source if source.isidentifier() else f"({source})"


def opposite(expression: Expression) -> str:
    """Return the negative of a number or formula as a factor: that of `-g` is `g`."""
    source = expression.source
    if not isinstance(source, str):
        return f"{plain(-source)!r}"
    inner = source.strip().removeprefix("-").strip()
    return inner if source.strip().startswith("-") and inner.isidentifier() else f"(-({source}))"


def instant(time: float) -> float:
    """Return a time of two significant digits that is not later than another [s]."""
    digits = float(f"{time:.1e}")
    return plain(digits if digits <= time else float(f"{time * 0.95:.1e}"))


def check(
    label: str, quantity: str, formula: str, tolerance: float, **more: object
) -> dict[str, Any]:
    """Return a check as in a level's file; constant values are written as numbers."""
    fields = {"label": label, "quantity": quantity, "formula": formula, "tolerance": tolerance}
    return fields | {key: _number(value) for key, value in more.items() if value is not None}


def _number(value: object) -> object:
    """Return a number for its text; any other value unchanged."""
    with suppress(ValueError):
        if isinstance(value, str) and isfinite(number := float(value)):
            return plain(number)
    return value


def rate_of(lowest: float) -> float:
    """Return the lowest usual rate that is at least a given one, else the highest [Hz]."""
    return next((rate for rate in RATES if rate >= lowest), RATES[-1])
