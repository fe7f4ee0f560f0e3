"""Buoyancy in a liquid at rest: the weight of the displaced liquid, computed exactly.

The area A of a polygon below the surface, and the integrals of depth and moment over it, are sums
over the edges, clipped at the surface: by Green's theorem ∬ f dA = −∮ ∫f dy dx around the submerged
area. The waterline adds nothing, because y = 0 there. The polygon itself is not cut, so it need not
be convex. The submerged area of a disc is a circular segment.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np

from sandbox.model.body import Body
from sandbox.model.effects import buoyancy as declared
from sandbox.model.effects.contract import Effect
from sandbox.model.expressions import Array, Values
from sandbox.model.shapes import Area, Disc
from sandbox.physics.engine.pymunk_bodies import local_points
from sandbox.physics.forces.law import Law, LawInputs
from sandbox.physics.state.motion import Motion


class DisplacedArea(NamedTuple):
    """The submerged area A of a body, and integrals over it."""

    area: Array
    """A [m²]."""
    moment: Array
    """The integral over A of the horizontal distance from the centre of mass [m³]."""
    depth: Array
    """The integral over A of the depth [m³]."""


@dataclass(frozen=True, slots=True)
class DiscOutline:
    """The outline of a disc."""

    radius: float  # m

    def displaced(self, height: Array, angle: Array) -> DisplacedArea:  # noqa: ARG002 (it is round)
        """Return the displaced area with the centre at a height above the surface [m]."""
        deep = -height / self.radius
        d = np.clip(deep, -1.0, 1.0)
        half = np.sqrt(1 - d * d)
        turned = np.pi / 2 + np.arcsin(d)
        depth = d * turned + half - half**3 / 3 + np.pi * np.maximum(deep - 1, 0.0)
        area = turned + d * half
        return DisplacedArea(self.radius**2 * area, np.zeros_like(area), self.radius**3 * depth)


@dataclass(frozen=True, slots=True)
class PolygonOutline:
    """The outline of a polygon, counter-clockwise."""

    corners: Array  # (c,) x + iy from the centre of mass [m]

    @classmethod
    def of(cls, points: list[tuple[float, float]]) -> "PolygonOutline":
        """Return the outline through corners, in either orientation."""
        corners = np.array([complex(*point) for point in points])
        turning = float(np.sum((corners.conj() * np.roll(corners, -1)).imag))
        return cls(corners if turning > 0 else corners[::-1])

    def displaced(self, height: Array, angle: Array) -> DisplacedArea:
        """Return the displaced area with the centre at a height [m] and at an angle [rad]."""
        a = self.corners * np.exp(1j * np.asarray(angle))[..., None]
        a = a + 1j * np.asarray(height)[..., None]
        a, b = _below(a, np.roll(a, -1, axis=-1))
        along, ya, yb = (b - a).real, a.imag, b.imag
        area = -along * (ya + yb) / 2
        depth = along * (ya * ya + ya * yb + yb * yb) / 6
        moment = -along * (a.real * (2 * ya + yb) + b.real * (ya + 2 * yb)) / 6
        return DisplacedArea(*(part.sum(axis=-1) for part in (area, moment, depth)))


def _below(a: Array, b: Array) -> tuple[Array, Array]:
    """Return edges clipped to below the surface; those above become a point on it."""
    rise = (b - a).imag
    share = np.clip(np.divide(-a.imag, rise, out=np.zeros_like(rise), where=rise != 0), 0.0, 1.0)
    cut = (a + share * (b - a)).real + 0j
    return np.where(a.imag < 0, a, cut), np.where(b.imag < 0, b, cut)


@dataclass(frozen=True, slots=True)
class Buoyancy:
    """F = −ρ A g at the centroid of the displaced area A, U = ρ g ∬ depth dA."""

    effect: ClassVar[Effect] = declared.Buoyancy.effect

    weight: float  # N/m², ρ g
    surface: float  # m
    bodies: tuple[tuple[int, DiscOutline | PolygonOutline], ...]  # each with its outline

    def add(self, motion: Motion, wrench: Array) -> None:
        """Add the force on each body, and its torque about the centre of mass."""
        for row, found in self._displaced(motion):
            wrench[..., row, 1] += self.weight * found.area
            wrench[..., row, 2] += self.weight * found.moment

    def potential_energy(self, motion: Motion) -> Array:
        """Return ρ g ∬ depth dA, the work needed to submerge each body."""
        stored = np.zeros(motion.position.shape[:-1])
        for row, found in self._displaced(motion):
            stored[..., row] = self.weight * found.depth
        return stored

    def _displaced(self, motion: Motion) -> Iterator[tuple[int, DisplacedArea]]:
        for row, outline in self.bodies:
            height = motion.position[..., row, 1] - self.surface
            yield row, outline.displaced(height, motion.angle[..., row])


def laws(effect: declared.Buoyancy, inputs: LawInputs) -> Iterator[Law]:
    """Yield the buoyancy."""
    level, values = inputs.level, inputs.values
    rows = inputs.rows(effect.bodies).tolist()
    every = ((row, level.bodies[inputs.names[row]]) for row in rows)
    bodies = tuple((r, _outline(b, values)) for r, b in every if isinstance(b.shape, Area))
    weight = effect.density(values) * effect.gravity(values)
    yield Buoyancy(weight, effect.surface(values), bodies)


def _outline(body: Body, values: Values) -> DiscOutline | PolygonOutline:
    if isinstance(body.shape, Disc):
        return DiscOutline(body.shape.radius(values))
    return PolygonOutline.of(local_points(body, values))
