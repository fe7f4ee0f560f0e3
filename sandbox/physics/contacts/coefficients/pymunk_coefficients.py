"""The coefficients that pymunk's solver uses for pairs with their own."""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np
import pymunk

from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.physics.contacts.coefficients.pair_coefficients import pair_coefficients
from sandbox.physics.contacts.coefficients.static_friction import Sticking, sticking
from sandbox.physics.contacts.shapes.arc_contact_correction import Hollows
from sandbox.physics.contacts.shapes.pymunk_shapes import SKIN

if TYPE_CHECKING:
    from sandbox.physics.contacts.shapes.one_way_surfaces import Gates

Collision = Callable[[pymunk.Arbiter, pymunk.Space, object], None]


def take_bounces(space: pymunk.Space, level: Level, values: Values) -> np.ndarray:
    """Disable restitution in pymunk's solver; return the coefficients of pairs: (n, n).

    Discs get a skin, too, so that touching discs are in contact whatever the rounding.
    """
    for shape in space.shapes:
        shape.elasticity = 0.0
    add_skin(space)
    return pair_coefficients(level, values, "restitution")


def add_skin(space: pymunk.Space) -> None:
    """Give discs a skin, as other shapes have."""
    for shape in space.shapes:
        if isinstance(shape, pymunk.Circle):
            shape.unsafe_set_radius(shape.radius + SKIN)


def give_coefficients(
    space: pymunk.Space,
    level: Level,
    values: Values,
    hollows: Hollows | None,
    gates: "Gates | None",
) -> tuple[int, dict[frozenset[int], Sticking]]:
    """Set the coefficients of pairs, and correct contacts that pymunk gets wrong.

    Return how many callbacks a step has if each pair has one contact, and the static friction of
    the pairs whose static coefficient is larger, by the indices of their bodies.
    """
    kinds = {name: index + 1 for index, name in enumerate(level.bodies)}
    coefficients: dict[tuple[str, str], dict[str, float]] = {}
    for attribute in ("friction", "restitution"):
        effect = getattr(level.effects, attribute)
        for pair in effect.pairs if effect else ():
            a, b = sorted(pair.bodies)
            coefficients.setdefault((a, b), {})[attribute] = pair.coefficient(values)
    sticky = sticking(level, values)
    corrected = {pair: (of, gate) for pair, of, gate in _corrected(hollows, gates)}
    watched = dict.fromkeys((*coefficients, *sticky, *corrected))
    for a, b in watched:
        chosen, stick = coefficients.get((a, b), {}), sticky.get((a, b))
        choose = _setter(chosen, stick, *corrected.get((a, b), (None, None)))
        space.on_collision(kinds[a], kinds[b], pre_solve=choose, post_solve=_judge(stick))
    numbered = {frozenset(kinds[name] - 1 for name in pair): s for pair, s in sticky.items()}
    return len(watched) + len(sticky), numbered


def correct_contacts(
    space: pymunk.Space, level: Level, hollows: Hollows | None, gates: "Gates | None"
) -> int:
    """Correct contacts that pymunk gets wrong; return the callbacks for one contact per pair."""
    kinds = {name: index + 1 for index, name in enumerate(level.bodies)}
    corrected = list(_corrected(hollows, gates))
    for (a, b), of, gate in corrected:
        space.on_collision(kinds[a], kinds[b], pre_solve=_setter({}, None, of, gate))
    return len(corrected)


def _corrected(
    hollows: Hollows | None, gates: "Gates | None"
) -> Iterator[tuple[tuple[str, str], Hollows | None, "Gates | None"]]:
    """Yield the pairs whose contacts differ from pymunk's, and the objects that correct them."""
    round_ = hollows.pairs if hollows else frozenset()
    passed = gates.pairs if gates else frozenset()
    for pair in sorted(round_ | passed):
        yield pair, hollows if pair in round_ else None, gates if pair in passed else None


def _setter(
    coefficients: dict[str, float],
    stick: Sticking | None,
    hollows: Hollows | None,
    gates: "Gates | None",
) -> Collision:
    def choose(arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: object) -> None:
        if hollows and not hollows.correct(arbiter):
            return
        if gates and not gates.admit(arbiter, accept=hollows is None):
            if hollows:
                hollows.leave(arbiter)
            return
        for attribute, value in coefficients.items():
            setattr(arbiter, attribute, value)
        if stick:
            stick.choose(arbiter)
        if hollows:
            hollows.follow(arbiter)

    return choose


def _judge(stick: Sticking | None) -> Collision | None:
    if stick is None:
        return None

    def judge(arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: object) -> None:
        stick.judge(arbiter)

    return judge
