"""The contact properties of a level's bodies, as the direct solver needs them."""

from collections.abc import Sequence

import numpy as np
import pymunk

from sandbox.model.body import Body
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.shapes import Arc, Curve, Disc, Hoop, Polygon, Polyline, Segment
from sandbox.physics.contacts.coefficients.pair_coefficients import pair_coefficients
from sandbox.physics.contacts.coefficients.static_friction import sticking
from sandbox.physics.contacts.direct.rows.contact_outlines import Figure, Figures
from sandbox.physics.contacts.direct.rows.row_layout import Surfaces
from sandbox.physics.contacts.shapes.pymunk_shapes import DIRECT_SKIN, INSET
from sandbox.physics.engine.pymunk_bodies import center_of, local_points
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.geometry.curve_contacts import middle_line_of
from sandbox.physics.geometry.outline_distance import surfaces
from sandbox.physics.state.joint_anchors import Complexes

SLOP = 1e-7
"""m, the default overlap that is left alone: it is larger than `PROUD`, so that bodies stay in
contact."""

CORRECTION = 0.5
"""The default share of an overlap that a step removes. It may be large, since the velocities stay
unchanged, but bodies that overlap deeply at the start should not jump apart."""

NONE: Complexes = np.zeros(0, dtype=complex)


def surfaces_of(level: Level, values: Values, bodies: Sequence[pymunk.Body]) -> Surfaces:
    """Return the contact properties of a level's bodies for the given parameters."""
    names = list(level.bodies)
    friction = pair_coefficients(level, values, "friction")
    static = friction.copy()
    for (a, b), pair in sticking(level, values).items():
        i, j = names.index(a), names.index(b)
        static[i, j] = static[j, i] = pair.static
    contact = level.effects.contact
    correction, slop = (contact.correction, contact.slop) if contact else (None, None)
    restitution = pair_coefficients(level, values, "restitution")
    return Surfaces(
        Figures([_figure(body, values) for body in level.bodies.values()]),
        friction,
        static,
        restitution,
        surfaces(bodies),
        CORRECTION if correction is None else correction(values),
        SLOP if slop is None else slop(values),
        _left_to_it(level),
        in_sequence=_in_sequence(level),
    )


def _in_sequence(level: Level) -> bool:
    """Return whether impacts at the same time come one after the other.

    So do those that a level asks to locate, so that a row of balls passes a shot on, unless there
    is friction, which needs them all at once.
    """
    effects = level.effects
    located = effects.contact is not None and effects.contact.located is not None
    alone = located and effects.restitution is not None and effects.friction is None
    return effects.in_sequence or alone


def _left_to_it(level: Level) -> Booleans:
    """Return which pairs, (n, n), do not stick, and so need not wait for a step."""
    sticking, names = level.effects.sticking, list(level.bodies)
    left = np.ones((len(names), len(names)), dtype=bool)
    for pair in sticking.pairs if sticking else ():
        a, b = (names.index(name) for name in pair.bodies)
        left[a, b] = left[b, a] = False
    return left


def _figure(spec: Body, values: Values) -> Figure:
    match spec.shape:
        case Disc(radius=radius):
            return Figure(radius(values), NONE, NONE, 0.0)
        case Hoop(radius=radius):
            return Figure(radius(values), NONE, NONE, 0.0, inner=radius(values))
        case Arc(radius=radius, thickness=thickness) as arc:
            middle, half = radius(values), thickness(values) / 2
            return Figure(
                middle + half,
                NONE,
                NONE,
                half,
                inner=middle - half,
                center=center_of(arc, spec, values),
                ends=True,
            )
        case Curve(thickness=thickness) as curve:
            half, middle_line = thickness(values) / 2, middle_line_of(curve, values)
            return Figure(0.0, NONE, NONE, half, middle_line=middle_line)
        case Segment(thickness=thickness) | Polyline(thickness=thickness):
            points = np.array([complex(*point) for point in local_points(spec, values)])
            both = np.concatenate((sides := np.diff(points), -sides))
            return Figure(0.0, _normals(both), points, thickness(values) / 2)
    corners = np.array([complex(*point) for point in local_points(spec, values)])
    sides = np.roll(corners, -1) - corners
    around = float((corners.conj() * np.roll(corners, -1)).imag.sum())
    rounding = DIRECT_SKIN if isinstance(spec.shape, Polygon) else INSET + DIRECT_SKIN
    return Figure(0.0, _normals(sides * np.sign(around)), corners, rounding)


def _normals(sides: Complexes) -> Complexes:
    """Return the unit normals to the right of sides: outward for a counter-clockwise outline."""
    return np.asarray(-1j * sides / np.abs(sides))
