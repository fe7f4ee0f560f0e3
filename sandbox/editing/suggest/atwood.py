"""Two bodies on a string over pegs: a = (m2 − m1) g / (m1 + m2), T = 2 m1 m2 g / (m1 + m2)."""

from collections.abc import Iterator
from math import sqrt

from sandbox.editing.suggest.scene import SAFE, Scene, Suggestion, check, instant, opposite
from sandbox.model.joint_ends import place
from sandbox.model.joints import Pulley, body_of

EXACT = 1e-9
"""The bound of the check: string and gravity are exact to rounding."""

STRAIGHT = 1e-9
"""m, by which a body may hang off the vertical below its peg."""


def suggestions(scene: Scene) -> Iterator[Suggestion]:
    """Yield the closed forms of the Atwood machines."""
    fall = scene.fall
    if fall is None or not scene.only("gravity", "contact", "rotation", "friction", "restitution"):
        return
    for name, joint in scene.level.joints.items():
        if not isinstance(joint, Pulley):
            continue
        one, other = (body_of(end) or "" for end in joint.ends)
        if not (one and other and _hangs(scene, joint, (one, other))):
            continue
        m1, m2, g = scene.mass(one), scene.mass(other), opposite(fall)
        a = f"({m2} - {m1})*{g}/({m1} + {m2})"
        until = min(_until(each, joint, (one, other)) for each in scene.everywhere)
        at = None if until >= scene.lasts else instant(SAFE * until)
        yield Suggestion(
            "Atwood machine",
            (one, other),
            (
                check("acceleration", f"{one}.acceleration.y", a, EXACT, scale=g, at=at),
                check("tension", f"{name}.tension", f"2*{m1}*{m2}*{g}/({m1} + {m2})", EXACT, at=at),
                check("speed", f"{one}.velocity.y", f"{a}*t", EXACT, scale=1, at=at),
            ),
        )


def _hangs(scene: Scene, joint: Pulley, names: tuple[str, str]) -> bool:
    """Whether two bodies hang at rest on the ends of a taut string, straight below fixed pegs."""
    level = scene.level
    if joint.ends != names or any(body_of(peg) for peg in joint.over) or joint.length is not None:
        return False
    if not scene.rests(*names):
        return False
    for name, peg in zip(names, (joint.over[0], joint.over[-1]), strict=True):
        up = place(peg, level.bodies, scene.values) - scene.where[name].center
        alone = level.bodies[name].type == "dynamic" and len(scene.joints[name]) == 1
        if not (alone and abs(up.real) <= STRAIGHT and up.imag > 0):
            return False
    return True


def _until(scene: Scene, joint: Pulley, names: tuple[str, str]) -> float:
    """Return when the machine runs into a peg or into something that is in its way [s]."""
    m1, m2 = (scene.level.bodies[name].mass for name in names)
    assert m1 is not None
    assert m2 is not None
    assert scene.fall is not None
    fall = scene.fall(scene.values)
    one, other = m1(scene.values), m2(scene.values)
    a = (one - other) * fall / (one + other)
    until = [
        scene.free_until(names[0], lambda t: 1j * a * t * t / 2, names[1:]),
        scene.free_until(names[1], lambda t: -1j * a * t * t / 2, names[:1]),
    ]
    if a:
        rises, peg = (names[0], joint.over[0]) if a > 0 else (names[1], joint.over[-1])
        way = place(peg, scene.level.bodies, scene.values) - scene.where[rises].center
        until.append(sqrt(2 * abs(way) / abs(a)))
    return min(until)
