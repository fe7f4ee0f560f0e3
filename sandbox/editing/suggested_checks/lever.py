"""Weights on a horizontal plank on a pin, at release: α = g Σ m l / I, and balance if Σ m l = 0.

A weight that lies flat turns with the plank. With sufficient friction it also moves around the pin;
without friction, only its vertical motion is that of the plank.
"""

from collections.abc import Iterator, Sequence
from math import sqrt
from typing import NamedTuple

from sandbox.editing.bodies_at_start import PlacedBody
from sandbox.editing.inserted_value_layout import plain
from sandbox.editing.suggested_checks.incline import friction, side
from sandbox.editing.suggested_checks.recogniser_input import (
    TOUCHING,
    Scene,
    Suggestion,
    as_factor,
    check,
    opposite,
    rate_of,
)
from sandbox.model.expressions import Expression
from sandbox.model.joints import Joint, Pivot, body_of
from sandbox.model.shapes import Box, Disc, Point
from sandbox.physics.geometry.outline_distance import Gap

NEAR = 1e-4
"""The tolerance of the check at the rate below, as the plank turns a little in the first step."""

STEPS = 2000.0
"""The square of the rate over the angular acceleration."""

FLAT = 1e-7
"""The tolerance of the normal between a body and the horizontal plank."""

PRESSED = 0.05
"""The least normal force on the plank, as a share of the weight, for it to stay on the plank."""

ROUND = 9
"""The decimals of a lever arm, to a nanometre."""

STICKS = 0.8
"""The largest friction needed, as a share of the largest available."""


class Weight(NamedTuple):
    """A body that turns about a pin: its mass, lever arms and moment of inertia, as formulas."""

    name: str
    mass: str
    across: str
    """m, the horizontal lever arm, positive to the right"""
    up: str
    """m, the vertical lever arm; 0 if friction does not carry the body around the pin"""
    moment: str
    """kg m², about its centre of mass; 0 if it does not turn with the plank"""

    @property
    def inertia(self) -> list[str]:
        """Its terms in I."""
        arms = [f"{arm}**2" for arm in (self.across, self.up) if arm != "0"]
        square = f"({' + '.join(arms)})" if len(arms) > 1 else "".join(arms)
        carried = [f"{self.mass}*{square}"] if arms else []
        return carried + [self.moment] * (self.moment != "0")


def suggestions(scene: Scene) -> Iterator[Suggestion]:
    """Yield the closed forms for levers."""
    fall, effects = scene.gravity_y, scene.level.effects
    if fall is None or not scene.only("gravity", "contact", "friction", "rotation"):
        return
    if effects.contact is None or effects.rotation is None:
        return
    for joint in scene.level.joints.values():
        weights = _weights(scene, joint)
        if len(weights) < 2:
            continue
        pulls = " + ".join(f"{one.mass}*{one.across}" for one in weights if one.across != "0")
        inertia = " + ".join(term for one in weights for term in one.inertia)
        form = f"-{opposite(fall)}*({pulls or '0'})/({inertia})"
        if all(_stay(each, joint, weights, form) for each in scene.everywhere):
            yield _lever(scene, weights, form)


def _lever(scene: Scene, weights: Sequence[Weight], form: str) -> Suggestion:
    """Return the suggestion for a lever."""
    label, quantity = "angular acceleration", f"{weights[0].name}.angular_acceleration"
    fastest = max(abs(Expression(form)(each.known_values)) for each in scene.everywhere)
    checks = (check(label, quantity, form, NEAR, scale="1", at=0),)
    about = tuple(one.name for one in weights)
    return Suggestion("lever", about, checks, rate_of(sqrt(STEPS * fastest)))


def _weights(scene: Scene, joint: Joint) -> list[Weight]:
    """Return a horizontal plank pinned to the plane, and the bodies on it; else nothing."""
    if not isinstance(joint, Pivot):
        return []
    plank, pin = joint.ends if body_of(joint.ends[0]) else joint.ends[::-1]
    name = body_of(plank)
    if name is None or not isinstance(pin, tuple):
        return []
    lying = _lying(scene, name)
    if not lying or not scene.is_at_rest(name, *lying):
        return []
    found = [_weight(scene, one, pin, name if one != name else None) for one in (name, *lying)]
    return [one for one in found if one] if all(found) else []


def _weight(scene: Scene, name: str, pin: Point, plank: str | None) -> Weight | None:
    """Return a body on a plank, or the plank itself; None if it has no short formula."""
    body, moment = scene.level.bodies[name], _moment(scene, name)
    across, up = (_minus(position, at) for position, at in zip(body.position, pin, strict=True))
    if plank:
        rubs, rolls = friction(scene, name, plank), isinstance(body.shape, Disc)
        if rubs is None or (rolls and rubs != "0"):
            return None
        up, moment = "0" if rubs == "0" else up, "0" if rolls else moment
    return Weight(name, scene.mass(name), across, up, moment) if moment else None


def _lying(scene: Scene, plank: str) -> list[str]:
    """Return the bodies on a plank; none if it is not horizontal, or anything else touches."""
    level, board = scene.level, scene.where[plank]
    straight = isinstance(board.body.shape, Box) and abs(board.rotation.imag) < FLAT
    if not straight or len(scene.joints[plank]) != 1 or board.body.type != "dynamic":
        return []
    touching = [name for name in level.bodies if name != plank and _touch(scene, plank, name)]
    for name in touching:
        others = (one for one in level.bodies if one not in (plank, name))
        is_held = scene.joints[name] or level.bodies[name].type != "dynamic"
        if is_held or not _lies(scene.where[name], board):
            return []
        if any(_touch(scene, name, one) for one in others):
            return []
    return touching


def _touch(scene: Scene, one: str, other: str) -> bool:
    return not scene.where[other].body.sensor and scene.distance(one, 0j, other) < TOUCHING


def _lies(weight: PlacedBody, board: PlacedBody) -> bool:
    """Return whether a disc, or a body with a whole side, lies on top of a plank."""
    under, enough = _under(weight, board), 1 if isinstance(weight.body.shape, Disc) else 2
    return abs(under.normal + 1j) < FLAT and len(under.points) == enough


def _under(weight: PlacedBody, board: PlacedBody) -> Gap:
    """Return the gap between a weight and a plank."""
    found = [side(own, board.cores[0], weight.radius) for own in weight.cores]
    return min(found, key=lambda one: one.distance)


def _moment(scene: Scene, name: str) -> str | None:
    """Return the moment of inertia about the centre as a formula; None if it has no short one."""
    body = scene.level.bodies[name]
    if body.moment is not None:
        return as_factor(body.moment)
    match body.shape:
        case Disc(radius=radius):
            return f"{scene.mass(name)}*{as_factor(radius)}**2/2"
        case Box(width=width, height=height):
            return f"{scene.mass(name)}*({as_factor(width)}**2 + {as_factor(height)}**2)/12"
    return None


def _minus(one: Expression, other: Expression) -> str:
    """Return a difference as a formula; a number if both are numbers."""
    if not one.names and not other.names:
        number = plain(round(one({}) - other({}), ROUND))
        return f"({number!r})" if number < 0 else f"{number!r}" if number else "0"
    return (
        as_factor(one)
        if not other.names and not other({})
        else f"({as_factor(one)} - {as_factor(other)})"
    )


def _stay(scene: Scene, joint: Joint, weights: Sequence[Weight], form: str) -> bool:
    """Return whether the same weights lie on the plank, and stay as it begins to turn."""
    if _weights(scene, joint) != list(weights):
        return False
    alpha = Expression(form)(scene.known_values)
    return all(_stays(scene, one, weights[0].name, alpha) for one in weights[1:])


def _stays(scene: Scene, weight: Weight, plank: str, alpha: float) -> bool:
    """Return whether a weight stays pressed on a plank that begins to turn, and does not tip."""
    assert scene.gravity_y is not None
    formulas = weight.mass, weight.across, weight.up, weight.moment
    mass, across, up, moment = (Expression(formula)(scene.known_values) for formula in formulas)
    g = -scene.gravity_y(scene.values)
    presses = g + alpha * across
    if presses < PRESSED * g:
        return False
    rubs = Expression(friction(scene, weight.name, plank) or "0")(scene.known_values)
    placed, board = scene.where[weight.name], scene.where[plank]
    base = sorted(point.real for point in _under(placed, board).points)
    high = placed.center.imag - board.bounds[1].imag  # above the surface, where friction acts
    at = placed.center.real + alpha * (moment / mass + high * up) / presses
    sticks = abs(alpha * up) <= STICKS * rubs * presses
    return sticks and base[0] - FLAT <= at <= base[-1] + FLAT
