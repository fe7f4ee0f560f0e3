"""Gaps between bodies, as functions of the bodies' positions.

A contact is a corner on a side, a disc on a side, or two discs on each other. Each has a gap V,
which must not shrink, and a slip S, the distance that its surfaces have slipped. Both are functions
of the positions: constrained at the end of the drift they hold to second order on curved paths, as
joints do (see `shake`). Velocities of the contact points at the beginning of the drift would leave
a curved path by h v² / 2R a step.

With A and B the points of the two bodies, d = B − A, and n from the first body to the second, in
the complex plane:

    on a side     V = Re(n̄ d)     S = Re((i n)̄ d) + a θ_a + b θ_b    n turns with the side's body
    discs         V = s |d|        S = s |d| φ + a θ_a + b θ_b         φ is the rotation of d

For discs A and B are the centres, and s = −1 where one is inside the other. The radii a and b, by
which angles count, end midway between the surfaces of two discs. For curves see `curve_contacts`; a
side touches a curve as if it were its osculating circle.
"""

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.rows.contact_outlines import PARALLEL, SHARP, Outlines
from sandbox.physics.contacts.direct.rows.contact_points import FROM_TO, ContactPoints
from sandbox.physics.contacts.direct.rows.curve_contacts import (
    CurveContact,
    follow_curves,
    on_curves,
)
from sandbox.physics.contacts.direct.rows.sides_in_contact import sides_of, to_the_middle
from sandbox.physics.engine.space_arrays import Booleans, Contacts, Integers
from sandbox.physics.joints.exact.constraint_interface import Coordinates
from sandbox.physics.state.joint_anchors import Complexes

OUT = FROM_TO[::-1]
"""The sign of the direction from each of the two bodies to the other."""

ALIKE = 1e-6
"""m, the largest distance of corners that lie on each other: either may be that on the side."""

NEAR = 1e-15
"""m, how far apart two centres in one place are taken to be, along the normal of their contact."""

LEANS = 0.1
"""rad, the largest angle between sides that count as facing each other. A contact of theirs has one
normal, that of one side, though at one of its points a corner may lie on the other side."""


@dataclass(slots=True)  # not frozen: made in every step
class Features:
    """The contact points of N bodies with the plane.

    Attributes
    ----------
    touching
        Their layout.
    points
        A and B above, (2, k + f), along their bodies' axes [m].
    side
        (k + f,), the body with the side; the first body where there is none.
    normal
        (k + f,), n above, and i n for friction, along the axes of that body.
    is_owner
        (2, k + f), 1 for the body with the side, else 0.
    rounds
        The r points without a side; None if all have one.
    sign
        (r,), s above, of these points.
    rolls
        a and b above, (2, f) [m].
    circles
        (f,), s above for friction between discs, and 0 elsewhere.
    offset
        (k,), d at the beginning of the drift [m].
    curved
        The points on curves, which are osculating circles in the other fields.
    corners
        (k,), where corners meet corners, which count as sides of the first body; None if nowhere.
    """

    touching: ContactPoints
    points: Complexes
    side: Integers
    normal: Complexes
    is_owner: Array
    rounds: slice | Integers | None
    sign: Array
    rolls: Array
    circles: Array
    offset: Complexes
    curved: tuple[CurveContact, ...] = ()
    corners: Booleans | None = None

    def evaluate(self, pose: Coordinates, total: Array, jacobian: Array) -> None:
        """Write the gaps and slips, (k + f,), and their Jacobian, (k + f, 3 N).

        Entries of the Jacobian that are 0 are not written.
        """
        row_bodies, count, rotations = self.touching.row_bodies, len(self.offset), pose.rotation
        arms = self.points * rotations.take(row_bodies)
        ends = pose.position.take(row_bodies) + arms
        d = ends[1] - ends[0]
        axes = self.normal * rotations.take(self.side)
        beside = axes.conj() * d  # along the normal, and along the side
        if self.rounds is not None or self.curved:
            self._bend(pose, arms, d[:count], axes, beside)
        total[:] = beside.real
        signed = FROM_TO * axes
        spin = (signed * arms.conj()).imag
        spin += self.is_owner * beside.imag
        if len(row_bodies[0]) > count:
            rolled = self.rolls * pose.angle.take(row_bodies[:, count:])
            total[count:] += rolled[0]
            total[count:] += rolled[1]
            spin[:, count:] += self.rolls
        flat, (in_plane, in_angle) = jacobian.reshape(-1), self.touching.jacobian_indices
        flat[in_plane], flat[in_angle] = signed.view(float), spin

    def _bend(
        self, pose: Coordinates, arms: Complexes, d: Complexes, axes: Complexes, beside: Complexes
    ) -> None:
        """Correct the rows of discs and curves, for which normals turn; see `evaluate`."""
        rubs, count = self.touching.friction_points, len(d)
        along, across = axes[:count], 1j * axes[:count]
        rows = gap, slip, _, _ = beside.real[:count], beside.imag[:count], along, across
        if self.rounds is not None:
            self._of_round(d, rows)
        if self.curved:
            follow_curves(self.curved, (pose.position, pose.rotation), arms[:, :count], rows)
            arms[:, count:] = arms[:, rubs]
        if len(rubs):
            beside.real[count:], beside.imag[count:] = slip.take(rubs), -gap.take(rubs)
            axes[count:] = across.take(rubs)

    def _of_round(self, d: Complexes, rows: tuple[Array, Array, Complexes, Complexes]) -> None:
        """Set the rows of discs: the gaps and slips, and their derivatives by d, (k,) each."""
        gap, slip, along, across = rows
        rounds, sign = self.rounds, self.sign
        normal = sign * along[rounds]
        d = _directed(d[rounds], normal)
        size = np.abs(d)
        gap[rounds], along[rounds] = sign * size, sign * d / size
        if len(self.touching.friction_points):
            apart = _directed(self.offset[rounds], normal)
            first, direction = np.abs(apart), d / apart
            slip[rounds] = sign * first * np.arctan2(direction.imag, direction.real)
            across[rounds] = 1j * along[rounds] * (first / size)

    def moved(self, pose: Coordinates) -> "Features":
        """Return the same contact points for a drift that begins at other positions."""
        moved, bodies, rubs = copy(self), self.touching.row_bodies, self.touching.friction_points
        points = pose.position[bodies] + self.points * pose.rotation[bodies]
        first, second = points[:, : len(self.offset)]
        moved.offset = second - first
        moved.rolls = to_the_middle(self.rolls, self.circles, moved.offset[rubs])
        return moved


def _directed(d: Complexes, normal: Complexes) -> Complexes:
    """Return the vectors between centres, with a direction where they coincide."""
    return d if d.all() else np.where(d == 0, NEAR * normal, d)


def _rounds(corner: Booleans, apart: Array, normal: Array) -> tuple[Array, slice | Integers]:
    """Return the sign s of each gap between discs, 0 of others, and the indices of the former."""
    sign = np.where(corner, np.where((apart.conj() * normal).real < 0, -1.0, 1.0), 0.0)
    return sign, slice(None) if corner.all() else np.flatnonzero(corner)


def features(
    contacts: Contacts, touching: ContactPoints, pose: Coordinates, origin: complex
) -> Features:
    """Return the contact points of a step; the origin is that of the positions [m]."""
    (bodies, pair, _, number, rubs), outlines = touching[:5], touching.outlines
    n = contacts.direction.view(complex).take(pair)
    middle = np.ascontiguousarray(contacts.points).view(complex).take(number) - origin
    out = OUT * n  # of each body
    surfaces = middle + out * (contacts.depths.take(number) / 2)
    where, rotation = pose.position.take(bodies), pose.rotation.take(bodies)
    is_round, center = outlines.round(where, rotation, n, middle)
    back = rotation.conj()
    owns, normals = _owns(touching, out * back, (surfaces - where) * back)
    curved = tuple(on_curves(outlines.figures, bodies, n, surfaces, (pose.position, pose.rotation)))
    if (ends := touching.ends) is not None:
        is_round = is_round & ~ends
        curved = tuple(one for one in curved if not ends[int(one.sign < 0), one.point])
    is_round, center = _with_curves(curved, pose, is_round, center, owns)
    recalls = not curved and ends is None and outlines.figures.plain
    known = touching.memory.recall(owns) if recalls else None
    corners, corner = (None, None) if known else _corners(outlines, is_round, owns)
    bends = None if known else _bends(outlines, is_round, owns, corner)
    core = surfaces if bends is None else surfaces - out * np.where(bends, outlines.rounding, 0.0)
    at = np.where(is_round, center, core)
    d = at[1] - at[0]
    sign, rounds = (None, None) if corner is None else _rounds(corner, d, n)
    if known is None:
        known = sides_of(touching, is_round, owns, sign, bends, curved)
        if recalls and corner is None and corners is None and bends is None:
            touching.memory.note(owns, known)
    normal = np.where(owns[1], normals[1], normals[0])
    return Features(
        touching=touching,
        points=((at - where) * back).take(touching.rows, axis=1),
        side=known.side,
        normal=np.concatenate((normal, 1j * normal.take(rubs))),
        is_owner=known.is_owner,
        rounds=rounds,
        sign=np.zeros(0) if sign is None else sign[rounds],
        rolls=to_the_middle(known.rolls, known.circles, d[rubs]),
        circles=known.circles,
        offset=d,
        curved=tuple(one for one in curved if corner is not None and corner[one.point]),
        corners=corners,
    )


def _owns(touching: ContactPoints, out: Complexes, points: Complexes) -> tuple[Booleans, Complexes]:
    """Return which body has the side: (2, k), at most one of the two at each point.

    `out`, (2, k), is the direction from each body to the other, and `points`, (2, k), are the
    contact points on both [m], along their axes. Where sides face each other, a corner of one lies
    on the side of the other; which body's side it is may differ between their two points. Also the
    normals from the first body to the second, along the axes of both, (2, k): those of the sides
    where the sides lean, and the contact has the normal of the other one.
    """
    faced, off = touching.outlines.sides(out)
    if touching.ends is not None:
        off = np.where(touching.ends, np.inf, off)
    owns, leans = off < PARALLEL, off < LEANS
    if not np.count_nonzero(leans[0] & leans[1]):
        return owns, OUT * out
    near = touching.outlines.from_corners(points)
    alike, both = np.abs(near[0] - near[1]) <= ALIKE, owns[0] & owns[1]
    yields = np.where(alike, touching.yields, near[0] < near[1])
    wrong = leans[0] & leans[1] & ~(alike | both) & (owns[0] == yields) & (owns[0] | owns[1])
    wrong &= near.min(axis=0) <= ALIKE
    owns = np.where(both, (~yields, yields), owns ^ wrong)
    return owns, OUT * np.where(wrong, faced, out)


def _with_curves(
    curved: Sequence[CurveContact],
    pose: Coordinates,
    is_round: Booleans,
    center: Complexes,
    owns: Booleans,
) -> tuple[Booleans, Complexes]:
    """Return which points are on discs, and the centres, with curves as discs: (2, k) each.

    The normal is that of a curve, if it bends there, and not that of a side of the other body.
    """
    if not curved:
        return is_round, center
    is_round, center = is_round.copy(), center.copy()
    for one in curved:
        own = int(one.sign < 0)
        center[own, one.point] = pose.position[one.curve] + pose.rotation[one.curve] * one.center
        is_round[own, one.point] = True
        owns[1 - own, one.point] &= one.arched
    return is_round, center


def _corners(
    outlines: Outlines, is_round: Booleans, owns: Booleans
) -> tuple[Booleans | None, Booleans | None]:
    """Return where corners meet corners, and where else no side takes part: (k,), None if nowhere.

    Corners that meet count as sides of the first body. `is_round` and `owns`, (2, k), tell whether
    the bodies are round there, and which has the side.
    """
    corner = ~(owns[0] | owns[1])
    if not np.count_nonzero(corner):
        return None, None
    if not np.count_nonzero(outlines.sharp):
        return None, corner
    sharp = corner & outlines.sharp & ~is_round.any(axis=0)
    if not np.count_nonzero(sharp):
        return None, corner
    owns[0] |= sharp
    corner &= ~sharp
    return sharp, corner if np.count_nonzero(corner) else None


def _bends(
    outlines: Outlines, is_round: Booleans, owns: Booleans, corner: Booleans | None
) -> Booleans | None:
    """Return where bodies touch with a rounded corner or end: (2, k), None if nowhere.

    A corner on a side counts as sharp, unless its rounding is that of a thick line.
    """
    if not outlines.figures.thick:
        return None if corner is None else np.stack((corner, corner))
    bends = ~(owns | is_round) & (outlines.rounding > SHARP)
    return bends if corner is None else bends | corner
