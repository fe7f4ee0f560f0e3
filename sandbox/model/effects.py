"""The manifest of effects: what a level does not declare is not simulated, and costs nothing."""

from typing import Annotated, Literal

from pydantic import Field

from sandbox.model.base import Model
from sandbox.model.bounds import (
    MOST_FORCES,
    MOST_PAIRS,
    Coefficient,
    Coordinate,
    Damping,
    Flow,
    ForceOverTime,
    Mass,
    Power,
    Resistance,
    Speed,
    Spin,
    Strength,
    Width,
)
from sandbox.model.expressions import Fraction
from sandbox.model.mention import ActedOn, ActedOnBodies, BodyName, Couple
from sandbox.model.shapes import Fall, Point, Velocity

SEVERAL = Field(min_length=1, max_length=MOST_FORCES)


class Gravity(Model):
    """The same acceleration for every dynamic body: F = m g, U = −m g · r."""

    acceleration: Fall
    """[x, y] in m/s²; downwards y is negative, such as `[0, -9.81]`"""


class Contact(Model):
    """Bodies are impenetrable. Without it shapes are drawn, but never touch."""

    correction: Fraction | None = None
    """the share of an overlap that each step takes back; if left out 0.2, but 0 where the level
    declares restitution, for pushing bodies apart adds to the energy of their bounces; by the
    direct solver 0.5 of bodies that press on each other, and nothing of those that bounce"""
    slop: Width | None = None
    """m, the overlap that is left alone; if left out 1e-6 m, and for piles half a hundredth of the
    narrowest body that moves"""
    piles: bool = False
    """whether bodies lie on each other in piles, which overlaps that are taken back to the last
    would stir, so that they never come to rest"""
    located: Annotated[ActedOnBodies, Field(min_length=1)] | None = None
    """the dynamic bodies whose impacts are located in time, within the step; those of the others
    are found at the next step, or missed where a body passes through another in between"""
    solver: Literal["iterative", "direct"] | None = None
    """how the forces between bodies that touch are found: by sweeps of pymunk's solver
    (`iterative`), or all at once and together with the exact joints (`direct`), which takes longer
    where many touch; if left out `direct` where the level has exact joints"""
    overlaps: bool = False
    """whether bodies may overlap at the start; if not, those that do are a mistake"""


class Pair(Model):
    """Two bodies that touch."""

    bodies: Couple
    """their names, in any order"""


class FrictionPair(Pair):
    """The coefficient of one pair of bodies, instead of the product of the two bodies' own."""

    coefficient: Coefficient
    static: Coefficient | None = None
    """of surfaces that stick, until they slip; the same as when they slip if left out"""


class Friction(Model):
    """Coulomb friction between bodies in contact; the coefficient of a pair is the product."""

    pairs: Annotated[tuple[FrictionPair, ...], Field(max_length=MOST_PAIRS)] = ()
    located: Annotated[ActedOnBodies, Field(min_length=1)] | None = None
    """the dynamic bodies whose slipping ends at its own time, located within the step; that of the
    others ends with the next kick"""


class RestitutionPair(Pair):
    """The coefficient of one pair of bodies, instead of the product of the two bodies' own."""

    coefficient: Fraction


class Restitution(Model):
    """Bodies bounce: the speed of separation over that of approach, the product of a pair's."""

    pairs: Annotated[tuple[RestitutionPair, ...], Field(max_length=MOST_PAIRS)] = ()
    impacts: Literal["together", "sequence"] = "together"
    """of bodies that touch: pymunk solves them `together`; hard bodies collide in `sequence`, the
    fastest approach first"""


class Rotation(Model):
    """Bodies can turn. Without it every moment of inertia is infinite."""


class Attraction(Model):
    """Attraction to a fixed centre: |F| = mu m / r^p; Newton's, U = −mu m / r, if p is left out."""

    mu: Strength
    """m³/s² (with a power p: m^(p + 1)/s²), the strength of the centre; negative to repel"""
    center: Point = (Coordinate(0), Coordinate(0))
    """m"""
    power: Power = Power(2)
    """p: 3 for a force that falls as 1/r³, −1 for one that grows as a spring's"""


class Gravitation(Model):
    """Bodies attract each other: |F| = G m1 m2 r / s³, U = −G m1 m2 / s, s² = r² + softening²."""

    constant: Strength
    """m³/(kg s²), G; negative to repel"""
    softening: Width = Width(0)
    """m, below which the attraction of two bodies no longer grows; 0 is Newton's law"""
    bodies: Annotated[ActedOnBodies, Field(min_length=2)] | None = None
    """those that attract each other; all dynamic bodies if left out"""


class Centrifugal(Model):
    """The plane turns about a vertical axis in it: F = m ω² (x − x0), U = −m ω² (x − x0)² / 2."""

    rate: Spin
    """rad/s, ω"""
    axis: Coordinate = Coordinate(0)
    """m, x0"""


class Drag(Model):
    """The drag of a fluid at rest: F = −(linear + quadratic |v|) v."""

    linear: Damping = Damping(0)
    """kg/s, Stokes's, of slow motion"""
    quadratic: Resistance = Resistance(0)
    """kg/m, of fast motion"""
    bodies: Annotated[ActedOnBodies, Field(min_length=1)] | None = None
    """those that it acts on; all dynamic bodies if left out"""


class Force(Model):
    """A given force on a body, constant or of time."""

    body: ActedOn
    """what it acts on"""
    force: tuple[ForceOverTime, ForceOverTime]
    """[x, y] in N, over the parameters and the time t"""
    at: Point = (Coordinate(0), Coordinate(0))
    """[x, y] in m, the point that it acts on, from the centre of mass along the body's axes"""
    frame: Literal["world", "body"] = "world"
    """whose axes [x, y] lie along: `body` for a force that turns with the body, as a thruster's"""


class Thrust(Model):
    """A rocket: m dv/dt = F + u dm/dt, from the start until its propellant is burnt.

    Its mass falls at the rate, and its moment of inertia with the mass.
    """

    body: ActedOn
    """what it drives"""
    exhaust: Velocity
    """[x, y] in m/s, u, the velocity of what leaves relative to the body, along the body's axes"""
    rate: Flow
    """kg/s, how fast it leaves"""
    propellant: Mass
    """kg, how much of the body's mass leaves; less than all"""


class Accretion(Model):
    """A body gathers matter, from the start on: m dv/dt = F + (w − v) dm/dt.

    Its mass grows at the rate, and its moment of inertia with the mass.
    """

    body: ActedOn
    """what gathers"""
    rate: Flow
    """kg/s, how fast matter comes"""
    velocity: Velocity = (Speed(0), Speed(0))
    """[x, y] in m/s, w, at which it comes"""


class Belt(Model):
    """A body whose surface runs along it: friction carries along what touches it."""

    body: BodyName
    """which; it stands still, or moves as told"""
    velocity: Velocity
    """[x, y] in m/s of its surface, along the body's axes; only what lies along a side counts"""


class Sticking(Model):
    """Bodies that become one at their first touch: the perfectly inelastic collision."""

    pairs: Annotated[tuple[Pair, ...], Field(min_length=1, max_length=MOST_PAIRS)]
    """who sticks to whom, where and how they first touch"""


class Effects(Model):
    """Everything that acts in a level."""

    gravity: Gravity | None = None
    """Uniform gravity."""
    contact: Contact | None = None
    """Bodies touch."""
    friction: Friction | None = None
    """Bodies in contact rub."""
    restitution: Restitution | None = None
    """Bodies in contact bounce."""
    sticking: Sticking | None = None
    """Bodies stick to each other."""
    rotation: Rotation | None = None
    """Bodies turn."""
    attraction: Annotated[tuple[Attraction, ...], SEVERAL] | None = None
    """Fixed centres attract or repel."""
    gravitation: Gravitation | None = None
    """Bodies attract or repel each other."""
    centrifugal: Centrifugal | None = None
    """The plane turns about a vertical axis."""
    drag: Drag | None = None
    """A fluid slows bodies down."""
    force: Annotated[tuple[Force, ...], SEVERAL] | None = None
    """Given forces act on bodies."""
    belt: Annotated[tuple[Belt, ...], SEVERAL] | None = None
    """Surfaces run."""
    thrust: Annotated[tuple[Thrust, ...], SEVERAL] | None = None
    """Rockets burn their own mass."""
    accretion: Annotated[tuple[Accretion, ...], SEVERAL] | None = None
    """Bodies gather matter."""

    @property
    def in_sequence(self) -> bool:
        """Whether impacts come one after the other."""
        return self.restitution is not None and self.restitution.impacts == "sequence"

    @property
    def declared(self) -> tuple[str, ...]:
        """The names of the effects that the level declares."""
        return tuple(name for name in type(self).model_fields if getattr(self, name) is not None)
