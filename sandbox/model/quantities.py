"""The names of everything that can be measured, and their units.

A quantity has one name everywhere: in a level's checks, on the command line, in a CSV header, in a
graph and on the screen. It reads `subject.attribute`, with `.x` or `.y` for a component; a vector
without a component stands for its magnitude. The subject is a body, a joint, or `system`.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

from sandbox.model import accounts
from sandbox.model.errors import SandboxError, brief
from sandbox.model.level import Level
from sandbox.model.suggest import closest, suggestion

Component = Literal["x", "y"]
Owner = Literal["body", "joint", "system", "time"]
"""What a quantity belongs to."""

_VECTORS: Mapping[Owner, Mapping[str, str]] = {
    "body": {"position": "m", "velocity": "m/s", "acceleration": "m/s²", "momentum": "kg·m/s"},
    "system": {"center": "m", "momentum": "kg·m/s"},
}
_SCALARS: Mapping[Owner, Mapping[str, str]] = {
    "body": {
        "speed": "m/s",
        "angle": "rad",
        "angular_velocity": "rad/s",
        "angular_acceleration": "rad/s²",
        "kinetic_energy": "J",
        "potential_energy": "J",
        "energy": "J",
        "action": "J·s",
        "contact.normal": "N",
        "contact.friction": "N",
    },
    "system": {
        "kinetic_energy": "J",
        "potential_energy": "J",
        "energy": "J",
        "action": "J·s",
        "angular_momentum": "kg·m²/s",
    },
}

_BOOKS: Mapping[str, str] = {
    "work": "J",
    "loss": "J",
    "unexplained_energy": "J",
    "impulse": "N·s",
    "unexplained_momentum": "kg·m/s",
    "angular_impulse": "N·m·s",
    "unexplained_angular_momentum": "kg·m²/s",
}
"""What a ledger keeps of the system; the first, and the impulses, by what gave or took it."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """A quantity of a level, taken apart.

    Attributes
    ----------
    name
        In full, such as `ball.position.x`.
    owner
        What kind of thing it belongs to.
    subject
        The body or joint; `system` or `t` where there is neither.
    attribute
        Such as `position` or `contact.normal`.
    component
        Of a vector; None for its magnitude, and for scalars.
    unit
        In SI.
    """

    name: str
    owner: Owner
    subject: str
    attribute: str
    component: Component | None
    unit: str

    @property
    def adds_up(self) -> bool:
        """Whether it is an integral over time, from the start of a run."""
        return self.attribute == "action"

    @property
    def booked(self) -> bool:
        """Whether it is known only to a ledger that has seen every step."""
        return self.attribute.partition(".")[0] in _BOOKS


TIME = Quantity("t", "time", "t", "t", None, "s")


class QuantityError(SandboxError, ValueError):
    """A name that is not a quantity of the level."""


def quantities(level: Level) -> Iterator[Quantity]:
    """Yield every quantity of a level that can be measured."""
    yield TIME
    for subject, owner in _owners(level).items():
        yield from _of(owner, subject, level)
    yield from _of_accounts(level)


def momentary(level: Level) -> Iterator[Quantity]:
    """Yield those that a state tells by itself, without what went before; the time is none."""
    for found in quantities(level):
        if not (found.booked or found.adds_up or found is TIME):
            yield found


def quantity(name: str, level: Level) -> Quantity:
    """Return the quantity of that name.

    Raises
    ------
    QuantityError
        If the level has none of that name; the message says what was probably meant.
    """
    if name == TIME.name:
        return TIME
    owners = _owners(level)
    subject, dot, rest = name.partition(".")
    if subject not in owners:
        close = closest(subject, owners)
        hint = suggestion(name, [f"{close}{dot}{brief(rest)}"] if close else [TIME.name, *owners])
        raise QuantityError(f"'{brief(name)}' is not a quantity of this level{hint}")
    found = [*_of(owners[subject], subject, level)]
    if owners[subject] == "system":
        found += _of_accounts(level)
    known = {quantity.name: quantity for quantity in found}
    if name not in known:
        hint = suggestion(name, known, most=len(known))
        raise QuantityError(f"'{brief(name)}' is not a quantity of this level{hint}")
    return known[name]


def _owners(level: Level) -> dict[str, Owner]:
    return {
        **dict.fromkeys(level.bodies, "body"),
        **dict.fromkeys(level.joints, "joint"),
        "system": "system",
    }


def _of_accounts(level: Level) -> Iterator[Quantity]:
    """Yield what a level's forces store, and what its ledger keeps."""
    outside = accounts.outside(level)
    for name in accounts.potentials(level):
        yield _of_system(f"potential_energy.{name}", "J")
    for book, names in {"work": accounts.works(level), "loss": accounts.losses(level)}.items():
        for name in names:
            yield _of_system(f"{book}.{name}", _BOOKS[book])
    for attribute in (*(f"impulse.{name}" for name in outside), "unexplained_momentum"):
        for component in ("x", "y", None):
            yield _of_system(attribute, _BOOKS[attribute.partition(".")[0]], component)
    for attribute in (
        *(f"angular_impulse.{name}" for name in outside),
        "unexplained_angular_momentum",
        "unexplained_energy",
    ):
        yield _of_system(attribute, _BOOKS[attribute.partition(".")[0]])


def _of_system(attribute: str, unit: str, component: Component | None = None) -> Quantity:
    name = f"system.{attribute}" + (f".{component}" if component else "")
    return Quantity(name, "system", "system", attribute, component, unit)


def _of(owner: Owner, subject: str, level: Level) -> Iterator[Quantity]:
    for attribute, unit in _VECTORS.get(owner, {}).items():
        name = f"{subject}.{attribute}"
        yield Quantity(f"{name}.x", owner, subject, attribute, "x", unit)
        yield Quantity(f"{name}.y", owner, subject, attribute, "y", unit)
        yield Quantity(name, owner, subject, attribute, None, unit)
    scalars = level.joints[subject].kind.quantities if owner == "joint" else _SCALARS[owner]
    for attribute, unit in scalars.items():
        yield Quantity(f"{subject}.{attribute}", owner, subject, attribute, None, unit)
