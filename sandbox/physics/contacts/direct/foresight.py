"""Corners that come down within a drift are taken into its kick.

Two bodies touch, and turn against each other: another corner meets somewhere within the drift.
Found where the drift ends, it is as deep as it went since, and to take that back lifts whatever
stands there. So a kick is followed to the end of its drift. What would be in each other there, and
is not yet, gets a row of its own, whose gap may close but no further, and the kick is solved anew
(Stewart and Trinkle 1996; Anitescu and Potra 1997). This takes what of the approach is too much for
the drift, and the impact at the next step takes the rest: neither gives energy.

What bounces is left to its impact, and so is what does not touch at all yet.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.kick import Kick
from sandbox.physics.contacts.direct.layout import Surfaces
from sandbox.physics.contacts.queries import Touched, contacts_of
from sandbox.physics.engine.batch import Contacts
from sandbox.physics.joints.exact.constraints import Coordinates, angles
from sandbox.physics.state.anchor import Plane

LEAST = 1e-8
"""m, how deep a corner must come down to count: a tenth of the overlap that is left alone."""

ALIKE = 1e-9
"""m: sides that are less deep by this are as deep, and corners that are so far beside one on it."""


class Part(NamedTuple):
    """A convex part of a body, along its axes.

    Attributes
    ----------
    corners
        (k,), counter-clockwise; two are a line [m].
    normals
        (k,), of the sides from each to the next, outwards.
    lengths
        (k,), of these sides [m].
    rounding
        How far its surface lies beyond them [m].
    """

    corners: Plane
    normals: Plane
    lengths: Array
    rounding: float

    @classmethod
    def of(cls, shape: pymunk.Poly | pymunk.Segment) -> "Part":
        """Return that of a shape."""
        ends = shape.get_vertices() if isinstance(shape, pymunk.Poly) else (shape.a, shape.b)
        corners = np.array([complex(*end) for end in ends])
        sides = np.roll(corners, -1) - corners
        lengths = np.abs(sides)
        return cls(corners, -1j * sides / lengths, lengths, shape.radius)

    @property
    def around(self) -> tuple[complex, float]:
        """The middle and the radius of a disc around it [m]."""
        middle = complex(self.corners.mean())
        return middle, float(np.abs(self.corners - middle).max()) + self.rounding

    def placed(self, place: complex, turned: complex) -> "Part":
        """Return it in the plane."""
        return self._replace(corners=place + self.corners * turned, normals=self.normals * turned)

    def apart(self, other: "Part") -> Array:
        """Return how far the corners of another are in front of each side: (k, l) [m]."""
        ways = other.corners - self.corners[:, None]
        across = (ways * self.normals.conj()[:, None]).real
        return np.asarray(across - (self.rounding + other.rounding))

    def beside(self, other: "Part", side: int) -> Array:
        """Return how far along a side the corners of another are: (l,) [m]."""
        along = 1j * self.normals[side]
        return np.asarray(((other.corners - self.corners[side]) * along.conjugate()).real)


class Foresight:
    """Finds which corners come down within a drift; n bodies.

    Parameters
    ----------
    bodies
        pymunk's, in order.
    surfaces
        How they touch.
    """

    def __init__(self, bodies: Sequence[pymunk.Body], surfaces: Surfaces) -> None:
        self._bodies = bodies
        shapes = [list(body.shapes) for body in bodies]
        sided = np.array([_has_sides(own) for own in shapes], dtype=bool)
        self._parts = [
            [Part.of(s) for s in own if isinstance(s, pymunk.Poly | pymunk.Segment)]
            for own in shapes
        ]
        discs = [[part.around for part in parts] for parts in self._parts]
        self._middle = [np.array([middle for middle, _ in own]) for own in discs]
        self._radius = [np.array([radius for _, radius in own]) for own in discs]
        self._single = np.array([len(own) == 1 for own in shapes], dtype=bool)
        self._reach = np.array([_reach(parts) for parts in self._parts])
        self._looks = sided[:, None] & sided & (surfaces.restitution == 0)

    def look(self, kick: Kick, motion: Array) -> Contacts | None:
        """Return what meets within the drift after a kick, where it starts; None if nothing does.

        Parameters
        ----------
        motion
            (3 N,), the velocities after the kick [m/s, rad/s].
        """
        drift = kick.joints.drift
        pairs = self._turning(kick.contacts, angles(motion) * drift)
        if not pairs:
            return None
        there = Coordinates(kick.place.values + drift * motion)
        found = {pair: list(self._meet(pair, kick, there)) for pair in pairs}
        found = {pair: meets for pair, meets in found.items() if meets}
        return contacts_of(found) if found else None

    def _turning(self, contacts: Contacts, turns: Array) -> list[tuple[int, int]]:
        """Return the pairs that turn against each other so far that another corner may meet.

        Parameters
        ----------
        turns
            (N,), how far bodies turn in the drift [rad].
        """
        a, b = contacts.bodies.T
        way = np.abs(turns[a] - turns[b]) * np.minimum(self._reach[a], self._reach[b])
        far = way > LEAST
        if not np.count_nonzero(far):
            return []
        whole = (contacts.touches == 2) & self._single[a] & self._single[b]
        rows = np.flatnonzero(far & self._looks[a, b] & ~whole)
        both = contacts.bodies[rows].tolist()
        return sorted({(min(pair), max(pair)) for pair in both})

    def _meet(self, pair: tuple[int, int], kick: Kick, there: Coordinates) -> Iterator[Touched]:
        """Yield where two bodies meet, as it is where the drift starts."""
        a, b = pair
        here, origin = kick.place, kick.joints.origin
        for one, other in self._near(a, b, there):
            began = _placed(one, a, here), _placed(other, b, here)
            for own, side, corner in _within(_placed(one, a, there), _placed(other, b, there)):
                owner, guest = began[own], began[1 - own]
                gap = float(owner.apart(guest)[side, corner])
                if gap <= 0:
                    continue  # it is behind that side already
                normal = complex(owner.normals[side])
                tip = complex(guest.corners[corner]) - normal * guest.rounding + origin
                points = (tip, tip - normal * gap) if own else (tip - normal * gap, tip)
                out = -normal if own else normal
                yield Touched(self._bodies[b], out, [points], -gap)

    def _near(self, a: int, b: int, there: Coordinates) -> Iterator[tuple[Part, Part]]:
        """Yield the parts of two bodies that may be in each other somewhere."""
        one, other = (there.plane[c] + self._middle[c] * there.turned[c] for c in (a, b))
        near = np.abs(one[:, None] - other) < self._radius[a][:, None] + self._radius[b]
        for first, second in np.argwhere(near).tolist():
            yield self._parts[a][first], self._parts[b][second]


def _placed(part: Part, body: int, place: Coordinates) -> Part:
    return part.placed(complex(place.plane[body]), complex(place.turned[body]))


def _within(one: Part, other: Part) -> Iterator[tuple[int, int, int]]:
    """Yield whose side a corner of the other part is behind, 0 or 1, which side, which corner.

    Of two parts that overlap these are the side that shows it least, and the one that faces it.
    """
    parts, apart = (one, other), (one.apart(other), other.apart(one))
    least = [across.min(axis=1) for across in apart]
    own = int(least[1].max() >= least[0].max() - ALIKE)
    side = int(least[own].argmax())
    if least[own][side] >= -LEAST:
        return
    facing = int((parts[1 - own].normals * parts[own].normals[side].conj()).real.argmin())
    for row, chosen in ((own, side), (1 - own, facing)):
        owner, beside = parts[row], parts[row].beside(parts[1 - row], chosen)
        deep = apart[row][chosen] < -LEAST
        deep &= (beside > -ALIKE) & (beside < owner.lengths[chosen] + ALIKE)
        yield from ((row, chosen, int(corner)) for corner in np.flatnonzero(deep))


def _has_sides(shapes: Sequence[pymunk.Shape]) -> bool:
    return bool(shapes) and all(isinstance(s, pymunk.Poly | pymunk.Segment) for s in shapes)


def _reach(parts: Sequence[Part]) -> float:
    """Return how far from its middle a body has corners; without any it has no end [m]."""
    return max((float(np.abs(part.corners).max()) for part in parts), default=np.inf)
