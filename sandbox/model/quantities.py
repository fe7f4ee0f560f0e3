"""The names and units of everything that can be measured.

A quantity has the same name everywhere: in a level's checks, on the command line, in a CSV header,
in a graph and on the screen. It has the form `subject.attribute`, with `.x` or `.y` for a
component; a vector without a component stands for its magnitude. The subject is a body, a joint, or
`system`.

Two bodies, or a body and one of its points, have quantities of their own, named after both:
`block.contact.table.normal`, `moon.relative.planet.velocity.x`, `stick.tip.position.y`; a body has
`ball.within.gate` for every sensor, which has `gate.count` itself. Most quantities can also be
aggregated over time, such as `string.tension.max`.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import chain
from typing import Literal

from sandbox.model import ledger_accounts
from sandbox.model.did_you_mean import closest, suggestion
from sandbox.model.errors import MisuseError, brief
from sandbox.model.level import Level

Component = Literal["x", "y"]
Owner = Literal["body", "joint", "system", "time"]
"""The kind of thing that a quantity belongs to."""

_FORMS: Mapping[str, Component | None] = {".x": "x", ".y": "y", "": None}
"""The endings of a vector's name, with their components."""

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

_PLAIN: Mapping[Owner, Mapping[str, tuple[str, Component | None, str]]] = {
    owner: {
        f"{vector}{end}": (vector, component, unit)
        for vector, unit in _VECTORS[owner].items()
        for end, component in _FORMS.items()
    }
    | {name: (name, None, unit) for name, unit in scalars.items()}
    for owner, scalars in _SCALARS.items()
}
"""The attribute, component and unit of what may follow the name of any body, or `system`."""

_OF_CONTACT = {"contact.normal": "N", "contact.friction": "N"}
"""The forces between two bodies that touch."""

_KINDS_OF_CONTACT = tuple(name.partition(".")[2] for name in _OF_CONTACT)

MOST_MUTUAL = 6
"""The most bodies for which the quantities of all pairs are listed."""

WITHIN = "within"
"""The depth of a body's centre in a sensor, from its outline; negative outside."""

COUNT = "count"
"""The number of moving bodies whose centre is in a sensor."""

_OF_POINTS = {"position": "m", "velocity": "m/s"}
"""The quantities of a point of a body."""

OVER_TIME: Mapping[str, str] = {
    **dict.fromkeys(("min", "max", "largest", "amplitude", "mean"), ""),
    "integral": "s",
}
"""The aggregates of a quantity since the start, with the factor of their unit; `largest` is the
largest size, `amplitude` half the range."""

_BOOKS: Mapping[str, str] = {
    "work": "J",
    "loss": "J",
    "unexplained_energy": "J",
    "impulse": "N·s",
    "unexplained_momentum": "kg·m/s",
    "angular_impulse": "N·m·s",
    "unexplained_angular_momentum": "kg·m²/s",
}
"""The balances that a ledger keeps; the first, and the impulses, are split by cause."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """A quantity of a level, as its parts."""

    name: str
    """The full name, such as `ball.position.x`."""
    owner: Owner
    """The kind of thing that it belongs to."""
    subject: str
    """The body or joint; `system` or `t` for the others."""
    attribute: str
    """The attribute, such as `position` or `contact.normal`."""
    component: Component | None
    """The component of a vector; None for its magnitude, and for scalars."""
    unit: str
    """The SI unit."""
    other: str = ""
    """The second body or the point; empty if there is none."""
    aggregate: str = ""
    """The aggregate since the start, one of `OVER_TIME`; empty for the current value."""

    @property
    def is_integral(self) -> bool:
        """Whether it is an integral over time, from the start of a run."""
        return self.attribute == "action"

    @property
    def needs_ledger(self) -> bool:
        """Whether it needs a ledger that has seen every step."""
        return self.attribute.partition(".")[0] in _BOOKS

    @property
    def is_pair_force(self) -> bool:
        """Whether it is a contact force of two bodies, which a single state does not determine."""
        return bool(self.other) and self.attribute in _OF_CONTACT

    @property
    def is_momentary(self) -> bool:
        """Whether it follows from a single state of the bodies and joints."""
        return not (self.needs_ledger or self.is_integral or self.is_pair_force or self.aggregate)


TIME = Quantity("t", "time", "t", "t", None, "s")


class QuantityError(MisuseError, ValueError):
    """A name that is not a quantity of the level."""


def quantities(level: Level) -> Iterator[Quantity]:
    """Yield every quantity of a level, except the families without a bound.

    These are the quantities of two bodies, see `mutual`, and the aggregates over time.
    """
    yield TIME
    for subject, owner in _owners(level).items():
        yield from _of(owner, subject, level)
    yield from _of_accounts(level)


def momentary_quantities(level: Level) -> Iterator[Quantity]:
    """Yield the quantities that follow from a single state, without the time."""
    for found in chain(quantities(level), mutual(level)):
        if found.is_momentary and found is not TIME:
            yield found


def quantity(name: str, level: Level) -> Quantity:
    """Return the quantity of that name.

    Raises `QuantityError` if the level has none of that name; the message suggests what was
    probably meant.
    """
    if name == TIME.name:
        return TIME
    prefix, _, aggregate = name.rpartition(".")
    if aggregate in OVER_TIME and prefix:
        if (inner := prefix.rpartition("."))[0] and inner[2] in OVER_TIME:
            raise _no_aggregate(name, prefix, aggregate)
        return _over_time(quantity(prefix, level), aggregate)
    subject, dot, rest = name.partition(".")
    owner = _owner(subject, level)
    if owner is None:
        owners = _owners(level)
        close = closest(subject, owners)
        hint = suggestion(name, [f"{close}{dot}{brief(rest)}"] if close else [TIME.name, *owners])
        raise QuantityError(
            "'{name}' is not a quantity of this level{hint}", name=brief(name), hint=hint
        )
    if plain := _PLAIN.get(owner, {}).get(rest):
        return Quantity(name, owner, subject, *plain)
    known = list[str]()
    for found in _family(owner, subject, rest, level):
        if found.name == name:
            return found
        known.append(found.name)
    followed = [f"{prefix}.{form}" for form in OVER_TIME if prefix in known]
    hint = suggestion(name, [*known, *followed], longest=len(known))
    raise QuantityError(
        "'{name}' is not a quantity of this level{hint}", name=brief(name), hint=hint
    )


def _family(owner: Owner, subject: str, rest: str, level: Level) -> Iterator[Quantity]:
    """Yield the quantities that a name of this subject may mean."""
    yield from _of(owner, subject, level)
    if owner == "system":
        yield from _of_accounts(level)
    if owner == "body":
        yield from _of_two(subject, rest, level)


def column_heading(name: str, unit: str) -> str:
    """Return the heading of a quantity's column: its name, with its unit if it has one."""
    return f"{name} [{unit}]" if unit else name


def aggregated(quantity: Quantity) -> str:
    """Return the name of the quantity that is aggregated over time."""
    return quantity.name.removesuffix(f".{quantity.aggregate}")


def mutual(level: Level) -> Iterator[Quantity]:
    """Yield the quantities of all pairs of bodies; none if the level has many bodies."""
    if len(level.bodies) <= MOST_MUTUAL:
        for subject in level.bodies:
            yield from _within(subject, level)
            for other in level.bodies:
                if other != subject:
                    yield from _mutual(subject, other, level)


def _over_time(quantity: Quantity, aggregate: str) -> Quantity:
    """Return an aggregate of a quantity since the start."""
    name = f"{quantity.name}.{aggregate}"
    if quantity.aggregate or quantity.owner == "time":
        raise _no_aggregate(name, quantity.name, aggregate)
    unit = "·".join(part for part in (quantity.unit, OVER_TIME[aggregate]) if part)
    return replace(quantity, name=name, unit=unit, aggregate=aggregate)


def _no_aggregate(name: str, prefix: str, aggregate: str) -> QuantityError:
    """Return the error for a quantity without that aggregate over time."""
    return QuantityError(
        "'{name}' is not a quantity of this level; '{whole}' has no '{what}' over time",
        name=brief(name),
        whole=brief(prefix),
        what=aggregate,
    )


def _of_two(subject: str, rest: str, level: Level) -> Iterator[Quantity]:
    """Yield the quantities of a body with the other body in a name, or the one probably meant."""
    kind, _, after = rest.partition(".")
    other = after.partition(".")[0]
    if kind == WITHIN:
        yield from _within(subject, level)
    elif kind in ("contact", "relative") and other not in ("", *_KINDS_OF_CONTACT):
        found = other if other in level.bodies else closest(other, level.bodies)
        if found and found != subject:
            yield from _mutual(subject, found, level)


def _within(subject: str, level: Level) -> Iterator[Quantity]:
    """Yield the depth of a body in each sensor."""
    for other, body in level.bodies.items():
        if body.sensor and other != subject:
            yield Quantity(f"{subject}.{WITHIN}.{other}", "body", subject, WITHIN, None, "m", other)


def _mutual(subject: str, other: str, level: Level) -> Iterator[Quantity]:
    name = f"{subject}.relative.{other}"
    for attribute, unit in _OF_POINTS.items():
        for end, component in _FORMS.items():
            full_name, relative = f"{name}.{attribute}{end}", f"relative.{attribute}"
            yield Quantity(full_name, "body", subject, relative, component, unit, other)
    yield Quantity(f"{name}.distance", "body", subject, "relative.distance", None, "m", other)
    if level.effects.contact and not (level.bodies[subject].sensor or level.bodies[other].sensor):
        for attribute, unit in _OF_CONTACT.items():
            full_name = f"{subject}.contact.{other}.{attribute.partition('.')[2]}"
            yield Quantity(full_name, "body", subject, attribute, None, unit, other)


def _of_points(subject: str, level: Level) -> Iterator[Quantity]:
    for point in level.bodies[subject].points:
        for attribute, unit in _OF_POINTS.items():
            for end, axis in _FORMS.items():
                name = f"{subject}.{point}.{attribute}{end}"
                yield Quantity(name, "body", subject, f"point.{attribute}", axis, unit, point)


def _owner(subject: str, level: Level) -> Owner | None:
    if subject == "system":
        return "system"
    if subject in level.joints:
        return "joint"
    return "body" if subject in level.bodies else None


def _owners(level: Level) -> dict[str, Owner]:
    subjects = *level.bodies, *level.joints, "system"
    return {name: owner for name in subjects if (owner := _owner(name, level))}


def _of_accounts(level: Level) -> Iterator[Quantity]:
    """Yield the potential energies of a level, and the balances of its ledger."""
    outside = ledger_accounts.external_accounts(level)
    for name in ledger_accounts.potentials(level):
        yield _of_system(f"potential_energy.{name}", "J")
    for name in ledger_accounts.works(level):
        yield _of_system(f"work.{name}", _BOOKS["work"])
    for name in ledger_accounts.losses(level):
        yield _of_system(f"loss.{name}", _BOOKS["loss"])
    for attribute in (*(f"impulse.{name}" for name in outside), "unexplained_momentum"):
        for end, component in _FORMS.items():
            yield _of_system(attribute, _BOOKS[attribute.partition(".")[0]], end, component)
    turns = (f"angular_impulse.{name}" for name in outside)
    for attribute in (*turns, "unexplained_angular_momentum", "unexplained_energy"):
        yield _of_system(attribute, _BOOKS[attribute.partition(".")[0]])


def _of_system(
    attribute: str, unit: str, end: str = "", component: Component | None = None
) -> Quantity:
    return Quantity(f"system.{attribute}{end}", "system", "system", attribute, component, unit)


def _of(owner: Owner, subject: str, level: Level) -> Iterator[Quantity]:
    for rest, (attribute, component, unit) in _PLAIN.get(owner, {}).items():
        yield Quantity(f"{subject}.{rest}", owner, subject, attribute, component, unit)
    if owner == "joint":
        for name, unit in level.joints[subject].kind.quantities.items():
            yield Quantity(f"{subject}.{name}", owner, subject, name, None, unit)
    elif owner == "body":
        yield from _of_points(subject, level)
        if level.bodies[subject].sensor:
            yield Quantity(f"{subject}.{COUNT}", owner, subject, COUNT, None, "")


ATTRIBUTES_OF_BODIES = frozenset(
    name.partition(".")[0]
    for name in (*_VECTORS["body"], *_SCALARS["body"], "relative", WITHIN, *OVER_TIME)
)
"""The names that a point of a body cannot have."""
