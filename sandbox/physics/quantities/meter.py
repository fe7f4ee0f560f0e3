"""Measures named quantities from snapshots."""

from collections.abc import Callable, Iterable, Mapping
from functools import cached_property, partial
from math import nan

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.quantities import COUNT, WITHIN, Component, Quantity, QuantityError, quantity
from sandbox.model.shapes import evaluate
from sandbox.model.translatable_message import Message
from sandbox.physics.energy.step_record import Measured
from sandbox.physics.state.joint_anchors import Anchor
from sandbox.physics.state.motion import kinetic_energy
from sandbox.physics.state.snapshot import Snapshot

Measurement = Callable[[Snapshot], Array]


class Meter:
    """Measures quantities of a run, such as a world, from one snapshot or from a stack of them.

    Raises `QuantityError` if the level has no such quantity, or only a ledger knows it.
    """

    def __init__(self, run: Measured, names: Iterable[str]) -> None:
        scene = run.scene
        self._bodies, self._values = run.level.bodies, run.values
        self._rows = {name: i for i, name in enumerate(scene.bodies)}
        self._columns = {name: i for i, name in enumerate(run.level.joints)}
        self._joints = scene.joints
        self._mass, self._moment, self._share = scene.mass, scene.moment, scene.mass_fraction
        self._laws = (*((scene.gravity,) if scene.gravity else ()), *scene.laws)
        self._of_all: dict[str, Array] = {}  # what the quantities of one snapshot share
        self.quantities = {name: quantity(name, run.level) for name in names}
        self._measurements = {name: self._bind(q) for name, q in self.quantities.items()}

    def __call__(self, snapshot: Snapshot) -> dict[str, Array]:
        """Return all quantities: a number each for one snapshot, an array for a stack.

        An integral over time begins with the first instant; it is 0 for one snapshot.
        """
        try:
            return {name: measure(snapshot) for name, measure in self._measurements.items()}
        finally:
            self._of_all.clear()

    def _bind(self, quantity: Quantity) -> Measurement:
        if quantity.needs_ledger or quantity.is_pair_force or quantity.aggregate:
            rule = Message(
                "'{name}' is known only in a recording of the whole run", name=quantity.name
            )
            raise QuantityError(rule)
        match quantity.owner:
            case "time":
                return lambda s: s.t
            case "joint":
                return self._of_joint(quantity.subject, quantity.attribute)
            case "body":
                return self._of_two(quantity) if quantity.other else self._of_body(quantity)
            case "system":
                return self._of_system(quantity)

    def _of_body(self, quantity: Quantity) -> Measurement:
        if quantity.attribute == COUNT:
            return self._count(quantity.subject)
        row, attribute = self._rows[quantity.subject], quantity.attribute
        if vectors := self._vectors_of_bodies.get(attribute):
            shared = partial(self._shared, attribute, vectors)
            return _component(lambda s: shared(s)[..., row, :], quantity.component)
        shared = partial(self._shared, attribute, self._scalars_of_bodies[attribute])
        return lambda s: shared(s)[..., row]

    def _shared(self, attribute: str, measure: Measurement, s: Snapshot) -> Array:
        """Measure an attribute of all bodies, once for all that are asked for."""
        found = self._of_all.get(attribute)
        if found is None:
            found = self._of_all[attribute] = measure(s)
        return found

    def _of_joint(self, name: str, attribute: str) -> Measurement:
        if attribute == "length":
            return lambda s: self._joints.length(name, s)
        if attribute == "potential_energy":
            spring = self._joints.springs.get(name)
            return spring.energy if spring else lambda s: np.zeros_like(s.t)
        column = self._columns[name]
        if attribute == "torque":
            return lambda s: s.torque[..., column]
        if attribute == "tension" and name in self._joints.wires:
            return lambda s: np.abs(s.tension[..., column])
        return partial(self._joints.tension, name)

    def _of_two(self, quantity: Quantity) -> Measurement:
        """Measure a point of a body, or a body relative to another, or in a sensor."""
        row, (kind, _, attribute) = self._rows[quantity.subject], quantity.attribute.partition(".")
        if kind == WITHIN:
            return self._sensing(row, quantity.other)
        if kind == "point":
            arm = complex(
                *evaluate(self._bodies[quantity.subject].points[quantity.other], self._values)
            )
            vector = partial(_of_point, Anchor(row, arm), attribute)
        else:
            vector = partial(_relative, row, self._rows[quantity.other], attribute)
        return _component(vector, quantity.component)

    def _sensing(self, row: int, sensor: str) -> Measurement:
        """Measure the depth of a body in a sensor."""
        from sandbox.physics.quantities.sensor_depth import sensing

        return sensing(row, self._rows[sensor], self._bodies[sensor], self._values)

    def _count(self, sensor: str) -> Measurement:
        """Count the dynamic bodies whose centre is in a sensor."""
        moving = [self._rows[name] for name, body in self._bodies.items() if body.type == "dynamic"]
        depths = [self._sensing(row, sensor) for row in moving]
        return lambda s: np.sum([depth(s) >= 0 for depth in depths], axis=0, dtype=float)

    def _of_system(self, quantity: Quantity) -> Measurement:
        if source := quantity.attribute.partition("potential_energy.")[2]:
            return lambda s: self._potential_of(s, source).sum(axis=-1)
        if vector := self._vectors_of_system.get(quantity.attribute):
            return _component(vector, quantity.component)
        return self._scalars_of_system[quantity.attribute]

    @cached_property
    def _vectors_of_bodies(self) -> Mapping[str, Measurement]:
        """The vectors of every body: (..., n, 2)."""
        return {
            "position": lambda s: s.position,
            "velocity": lambda s: s.velocity,
            "acceleration": lambda s: s.acceleration,
            "momentum": self._momentum,
        }

    @cached_property
    def _scalars_of_bodies(self) -> Mapping[str, Measurement]:
        """The scalars of every body: (..., n)."""
        return {
            "speed": lambda s: _size(s.velocity),
            "angle": lambda s: s.angle,
            "angular_velocity": lambda s: s.angular_velocity,
            "angular_acceleration": lambda s: s.angular_acceleration,
            "kinetic_energy": self._kinetic,
            "potential_energy": self._potential,
            "energy": self._energy,
            "action": self._action,
            "contact.normal": lambda s: s.normal,
            "contact.friction": lambda s: s.friction,
        }

    @property
    def _vectors_of_system(self) -> Mapping[str, Measurement]:
        """The vectors of all dynamic bodies together: (..., 2)."""
        return {"center": self._center, "momentum": lambda s: self._momentum(s).sum(axis=-2)}

    @property
    def _scalars_of_system(self) -> Mapping[str, Measurement]:
        """The scalars of all dynamic bodies together: (...,)."""
        return {
            "kinetic_energy": lambda s: self._kinetic(s).sum(axis=-1),
            "potential_energy": lambda s: self._potential(s).sum(axis=-1),
            "energy": lambda s: self._energy(s).sum(axis=-1),
            "action": lambda s: self._action(s).sum(axis=-1),
            "angular_momentum": self._angular_momentum,
        }

    def _center(self, s: Snapshot) -> Array:
        """Return Σ m r / Σ m; not a number if no body is dynamic."""
        mass = self._mass * self._share(s.t)
        total = mass.sum(axis=-1, keepdims=True)
        return np.sum(mass[..., None] * s.position, axis=-2) / np.where(total > 0, total, nan)

    def _momentum(self, s: Snapshot) -> Array:
        return (self._mass * self._share(s.t))[..., None] * s.velocity

    def _kinetic(self, s: Snapshot) -> Array:
        """Return T = m v² / 2 + I ω² / 2."""
        fraction = self._share(s.t)
        return kinetic_energy(self._mass * fraction, self._moment * fraction, s)

    def _potential(self, s: Snapshot) -> Array:
        potential = np.zeros(s.position.shape[:-1])
        for law in self._laws:
            potential = potential + law.potential_energy(s)
        return potential

    def _potential_of(self, s: Snapshot, effect: str) -> Array:
        """Return U from the laws of one effect."""
        stores = [law for law in self._laws if law.effect.stores(effect)]
        energies = [law.potential_energy(s) for law in stores]
        return sum(energies, np.zeros(s.position.shape[:-1]))

    def _energy(self, s: Snapshot) -> Array:
        return self._kinetic(s) + self._potential(s)

    def _action(self, s: Snapshot) -> Array:
        """Return ∫ (T − U) dt by the trapezoidal rule over the steps, of second order."""
        lagrangian = self._kinetic(s) - self._potential(s)
        action = np.zeros_like(lagrangian)
        if s.t.ndim:
            between = (lagrangian[1:] + lagrangian[:-1]) / 2
            action[1:] = np.cumsum(np.diff(s.t)[:, None] * between, axis=0)
        return action

    def _angular_momentum(self, s: Snapshot) -> Array:
        """Return L = Σ m (x vy − y vx) + I ω, about the origin."""
        x, y = s.position[..., 0], s.position[..., 1]
        fraction = self._share(s.t)
        orbital = self._mass * fraction * (x * s.velocity[..., 1] - y * s.velocity[..., 0])
        return np.sum(orbital + self._moment * fraction * s.angular_velocity, axis=-1)


def _of_point(point: Anchor, attribute: str, s: Snapshot) -> Array:
    """Return the position or velocity of a point of a body: (..., 2)."""
    position, moves, _ = point.kinematics(s)
    found = position if attribute == "position" else moves
    return np.stack((found.real, found.imag), axis=-1)


def _relative(row: int, other: int, attribute: str, s: Snapshot) -> Array:
    """Return the position or velocity relative to another body, in the axes of the plane."""
    of = s.velocity if attribute == "velocity" else s.position
    return of[..., row, :] - of[..., other, :]


def _component(vector: Measurement, component: Component | None) -> Measurement:
    match component:
        case "x":
            return lambda s: vector(s)[..., 0]
        case "y":
            return lambda s: vector(s)[..., 1]
        case None:
            return lambda s: _size(vector(s))


def _size(vector: Array) -> Array:
    return np.hypot(vector[..., 0], vector[..., 1])
