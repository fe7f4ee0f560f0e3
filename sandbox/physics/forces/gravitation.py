"""Newtonian attraction between bodies."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import ClassVar, NamedTuple

import numpy as np

from sandbox.model.effects import gravitation as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Integers, in_place
from sandbox.physics.forces.law import Law, LawInputs
from sandbox.physics.forces.variable_mass import MassFraction, constant_mass
from sandbox.physics.state.motion import Motion

AT_ONCE = 15_000
"""The number of pairs that are computed at once, such that their arrays stay in the cache."""


class Block(NamedTuple):
    """Some bodies, and all that attract them, except those of earlier blocks."""

    rows: slice
    others: slice
    """The bodies, and these with all that follow."""
    offsets: tuple[Array, Array]
    """(..., some, others) each, the x and y components from the first to the second [m]."""

    def add(self, to: Array, mass: Array, of_pairs: Array, sign: int) -> None:
        """Add m1 m2 times a value of each pair to its first body, and to its second with a sign.

        Sums and masses are those of all bodies, (..., k, 1), the values those of pairs, (..., some,
        others).
        """
        to[..., self.rows, :] += mass[..., self.rows, :] * (of_pairs @ mass[..., self.others, :])
        later = slice(self.rows.stop, self.others.stop)
        if later.start < later.stop:
            back = of_pairs[..., self.rows.stop - self.rows.start :].mT @ mass[..., self.rows, :]
            to[..., later, :] += sign * mass[..., later, :] * back


@dataclass(frozen=True, slots=True)
class Gravitation:
    """Newton's law between every two of k bodies: F = G m1 m2 r / s³, U = −G m1 m2 / s.

    s² = r² + ε² is Plummer's softening: without it, the force of bodies that meet is infinite. Each
    of the two has half of the energy of a pair.
    """

    effect: ClassVar[Effect] = declared.Gravitation.effect

    constant: float  # m³/(kg s²), G
    bodies: Integers  # (k,)
    mass: Array  # (n,) kg at the start
    softening: float = 0.0  # m, ε
    mass_fraction: MassFraction = constant_mass
    _rows: slice | Integers = field(init=False)  # of the bodies

    def __post_init__(self) -> None:
        """Store the rows of the bodies."""
        object.__setattr__(self, "_rows", in_place(self.bodies))

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add to each body the pull of all others."""
        mass = self._mass(motion)
        force = np.zeros((2, *motion.position.shape[:-2], len(self.bodies), 1))
        for block, square in self._blocks(motion):
            weight = np.sqrt(square)
            weight *= square
            np.divide(self.constant, weight, out=weight)
            for component, offset in zip(force, block.offsets, strict=True):
                offset *= weight
                block.add(component, mass, offset, -1)
        wrench[..., self._rows, :2] += np.concatenate(force, axis=-1)

    def potential_energy(self, motion: Motion) -> Array:
        """Return −G m1 m2 / s of each pair, half for each of the two."""
        mass = self._mass(motion)
        pairs = np.zeros((*motion.position.shape[:-2], len(self.bodies), 1))
        for block, square in self._blocks(motion):
            block.add(pairs, mass, 1 / np.sqrt(square), 1)
        energy = np.zeros(motion.position.shape[:-1])
        energy[..., self._rows] = -self.constant / 2 * pairs[..., 0]
        return energy

    def _blocks(self, motion: Motion) -> Iterator[tuple["Block", Array]]:
        """Yield blocks that together contain each pair once, with s² of their pairs."""
        positions = np.ascontiguousarray(np.moveaxis(motion.position[..., self._rows, :], -1, 0))
        count, stop = len(self.bodies), 0
        while (start := stop) < count:
            rows = max(AT_ONCE // max(positions[0][..., start:].size, 1), 1)
            stop = min(start + rows, count)
            x, y = (
                position[..., None, start:] - position[..., start:stop, None]
                for position in positions
            )
            square = x * x
            square += y * y
            square += self.softening**2
            own = np.arange(stop - start)
            square[..., own, own] = np.inf  # no body attracts itself
            yield Block(slice(start, stop), slice(start, count), (x, y)), square

    def _mass(self, motion: Motion) -> Array:
        """Return the masses of the bodies at the times of a motion: (..., k, 1) [kg]."""
        return (self.mass * self.mass_fraction(motion.t))[..., self._rows, None]


def laws(effect: declared.Gravitation, inputs: LawInputs) -> Iterator[Law]:
    """Yield the gravitation between the bodies."""
    constant, softening = effect.constant(inputs.values), effect.softening(inputs.values)
    yield Gravitation(
        constant, inputs.rows(effect.bodies), inputs.mass, softening, inputs.mass_fraction
    )
