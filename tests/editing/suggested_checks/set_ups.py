"""Set-ups with a closed form, made by edits as a person makes them."""

from cmath import rect
from math import copysign, pi, radians

from sandbox.editing.draft import Draft
from sandbox.editing.edits.bodies import add_box, add_disc, add_surface
from sandbox.editing.edits.effects import declare
from sandbox.editing.edits.joint_creation import Pick, add_joint
from sandbox.editing.edits.moving_and_aligning import turn
from sandbox.editing.edits.rope_wrapping import wrap
from sandbox.editing.text_patches import put, put_all, remove
from sandbox.model.loading import parse

EMPTY = Draft.empty().text


def disc(text: str, x: float, y: float, radius: float = 0.25) -> str:
    return add_disc(text, parse(text), (x, y), (x + radius, y)).text


def atwood(one: float, other: float) -> str:
    text = disc(disc(EMPTY, -1, 3), 1, 3)
    pegs = Pick((-1, 6)), Pick((1, 6))
    chosen = [Pick((-1, 3), "disc1"), *pegs, Pick((1, 3), "disc2")]
    text = add_joint(text, parse(text), "pulley", chosen).text
    return put_all(text, {("bodies", "disc1", "mass"): one, ("bodies", "disc2", "mass"): other})


def tackle(*pegs: tuple[float, float], hung: bool = False, at: float = 2) -> str:
    """Return a wheel in a string over pegs, the first of which is its end, and a box at the other.

    With `hung`, a box hangs on a rope below the wheel.
    """
    text = disc(EMPTY, 0, 5)
    text = add_box(text, parse(text), (at - 0.5, 3), (at + 0.5, 4)).text
    first, *rest = (Pick(peg) for peg in pegs)
    chosen = [first, Pick((0, 5), "disc1"), *rest, Pick((at, 3.5), "box1")]
    text = add_joint(text, parse(text), "pulley", chosen).text
    if hung:
        text = add_box(text, parse(text), (-0.5, 2), (0.5, 3)).text
        text = add_joint(text, parse(text), "rope", [Pick((0, 5), "disc1"), Pick((0, 3), "box2")])[
            0
        ]
    return text


def loop() -> str:
    """Return a disc in a string that is tied to the plane at both ends."""
    text = disc(EMPTY, 0, 5)
    chosen = [Pick((-1, 8)), Pick((0, 5), "disc1"), Pick((1, 8))]
    return add_joint(text, parse(text), "pulley", chosen).text


def capstan(m1: float, m2: float, mu: float | None = None, x: float = 1.04) -> str:
    """Return two boxes that hang on a rope over a drum, simulated for a short time."""
    text = disc(EMPTY, 0, 4, 1)
    for side in (-x, x):
        text = add_box(text, parse(text), (side - 0.3, 1), (side + 0.3, 1.6)).text
    masses = {("bodies", "box1", "mass"): m1, ("bodies", "box2", "mass"): m2}
    text = put_all(text, masses | {("duration",): 0.3})
    if mu is not None:
        text = declare(text, parse(text), "friction")
        text = put_all(text, {("bodies", "disc1", "friction"): mu})
    return wrap(text, parse(text), ["disc1", "box1", "box2"]).text


def cradle(count: int, drawn: int, *, angle: float = 30, rods: float = 3, kind: str = "rod") -> str:
    """Return elastic balls that hang in a row; some of them, the last if < 0, are pulled aside."""
    text, balls = EMPTY, range(1, count + 1)
    for i in balls:
        text = disc(text, i, 2, 0.5)
        ends = [Pick((i, 2), f"disc{i}"), Pick((i, 2 + rods))]
        text = add_joint(text, parse(text), kind, ends).text
    text = declare(text, parse(text), "restitution")
    text = put_all(text, {("bodies", f"disc{i}", "restitution"): 1 for i in balls})
    way = rect(rods, -pi / 2 - copysign(radians(angle), drawn))
    aside = balls[:drawn] if drawn > 0 else balls[drawn:]
    for i in aside:
        place = [i + way.real, 2 + rods + way.imag]
        text = put(text, ("bodies", f"disc{i}", "position"), place)
    return text


def walled(text: str, x: float) -> str:
    return add_surface(text, parse(text), [(x, 1), (x, 4)]).text


def row(velocities: list[float]) -> str:
    """Return elastic balls on a line, without gravity; those that are alike touch."""
    text, x = EMPTY, -4.0
    for i, v in enumerate(velocities):
        x += 0.5 + (0.7 if i and v != velocities[i - 1] else 0)
        text = disc(text, x, 4, 0.25)
    text = remove(declare(text, parse(text), "restitution"), ("effects", "gravity"))
    for i, v in enumerate(velocities):
        body = ("bodies", f"disc{i + 1}")
        text = put_all(text, {(*body, "restitution"): 1, (*body, "velocity"): [v, 0]})
    return text


def incline(angle: float, friction: float | None = None, *, turns: bool = False) -> str:
    text = add_surface(EMPTY, parse(EMPTY), [(-6, 6), (6, 6)]).text
    text = turn(text, parse(text), ["surface1"], angle)
    at = 6j + (rect(2, angle) if angle > 0 else rect(-2, angle)) + 0.25j * rect(1, angle)
    low, high = at - 0.5 - 0.25j, at + 0.5 + 0.25j
    text = add_box(text, parse(text), (low.real, low.imag), (high.real, high.imag)).text
    text = turn(text, parse(text), ["box1"], angle)
    if friction is not None:
        text = declare(text, parse(text), "friction")
        text = put_all(text, {("bodies", "box1", "friction"): friction})
    return declare(text, parse(text), "rotation") if turns else text


def pendulum(kind: str, x: float, y: float) -> str:
    text = disc(EMPTY, x, y)
    return add_joint(text, parse(text), kind, [Pick((0, 7)), Pick((x, y), "disc1")]).text


def damped(damping: float, y: float = 5) -> str:
    text = oscillator(0, y, 2, falls=True)
    return put_all(text, {("joints", "spring1", "damping"): damping})


def oscillator(x: float, y: float, length: float, *, falls: bool) -> str:
    text = disc(EMPTY, x, y)
    text = add_joint(text, parse(text), "spring", [Pick((0, 7)), Pick((x, y), "disc1")]).text
    text = put_all(text, {("joints", "spring1", "length"): length})
    return text if falls else remove(text, ("effects", "gravity"))


def collision(m1: float, v1: float, m2: float, v2: float, e: float | None) -> str:
    text = remove(disc(disc(EMPTY, -2, 4), 1, 4, 0.4), ("effects", "gravity"))
    if e is not None:
        text = declare(text, parse(text), "restitution")
        text = put_all(text, {("bodies", f"disc{i}", "restitution"): e for i in (1, 2)})
    masses = {("bodies", f"disc{i}", "mass"): m for i, m in ((1, m1), (2, m2))}
    return put_all(
        text, masses | {("bodies", f"disc{i}", "velocity"): [v, 0] for i, v in ((1, v1), (2, v2))}
    )


def thrown(x: float, y: float, u: float, v: float) -> str:
    return put_all(disc(EMPTY, x, y), {("bodies", "disc1", "velocity"): [u, v]})


def seesaw(
    boxes: dict[float, float],
    *,
    pin: tuple[float, float] = (0, 1.1),
    friction: float | None = None,
    discs: dict[float, float] | None = None,
) -> str:
    """Return a plank on a pin, with squares and discs of one size at given places."""
    text = add_box(EMPTY, parse(EMPTY), (-3, 1), (3, 1.2)).text
    for x, size in boxes.items():
        text = add_box(text, parse(text), (x - size / 2, 1.2), (x + size / 2, 1.2 + size)).text
    for x, radius in (discs or {}).items():
        text = disc(text, x, 1.2 + radius, radius)
    text = add_joint(text, parse(text), "pivot", [Pick(pin, "box1"), Pick(pin)]).text
    if friction is None:
        return text
    text = declare(text, parse(text), "friction")
    names = (name for name in parse(text).bodies if name.startswith("box"))
    return put_all(text, {("bodies", name, "friction"): friction for name in names})


def spring(x: float, y: float, stiffness: float) -> str:
    text = disc(EMPTY, x, y)
    text = add_joint(text, parse(text), "spring", [Pick((0, 7)), Pick((x, y), "disc1")]).text
    return put_all(text, {("joints", "spring1", "stiffness"): stiffness})


MADE = {
    "Atwood machine": [atwood(2, 3.7), atwood(5, 0.3), atwood(1, 1), atwood(1e3, 1)],
    "block and tackle": [
        tackle((0, 8), (0, 8), (2, 8)),
        tackle((0, 8), (0, 8), (2, 8), hung=True),
        tackle((-0.5, 8), (0.5, 8), (2, 8)),
        tackle((-1, 8), (1, 8), (3, 8), hung=True, at=3),
        loop(),
    ],
    "capstan": [
        capstan(5, 10),
        capstan(5, 5),
        capstan(5, 10, 0.25),
        capstan(5, 15, 0.25),
        capstan(30, 10, 0.25),
        capstan(3, 100, 0.4, x=1.2),
        capstan(5, 5, 0.1, x=0.9),
    ],
    "Newton's cradle": [
        cradle(3, 1),
        cradle(5, -2, angle=45),
        cradle(4, 1, rods=5, kind="rope", angle=10),
        row([2, 0, 0]),
        row([0, 0, 0, -3, -3]),
    ],
    "block on a slope": [
        incline(0.5),
        incline(-0.7),
        incline(0.6, 0.2),
        incline(-1.2, 0.7),
        incline(0.4, turns=True),
    ],
    "block that a slope holds": [incline(0.2, 0.5), incline(-0.3, 0.9)],
    "pendulum": [
        pendulum("rod", 1.5, 6),
        pendulum("rod", -0.2, 5),
        pendulum("rope", 1, 5.5),
        pendulum("rod", 1.5, 8),
    ],
    "oscillator": [
        oscillator(2, 7, 1.5, falls=False),
        oscillator(-3, 7, 3.5, falls=False),
        oscillator(0, 5, 2, falls=True),
        oscillator(0, 4.5, 2, falls=True),
        damped(0.5),
        damped(5),
        damped(15, 4.5),
    ],
    "lever": [
        seesaw({-2: 0.8, 1.75: 0.5}),
        seesaw({-2: 0.6}),
        seesaw({-2: 0.8, 2: 0.8}),
        seesaw({-2: 0.8, 1.75: 0.5}, pin=(0.5, 1.15), friction=0.8),
        seesaw({}, discs={-2: 0.5, 1: 0.4}),
    ],
    "spring pendulum": [spring(2, 6, 77), spring(-1, 5.5, 300), spring(2, 9, 100)],
    "collision": [
        collision(1, 3, 2, 0, None),
        collision(3, 2, 0.4, -1, 1),
        collision(1, 5, 7, 2, 0.8),
    ],
    "thrown body": [thrown(0, 3, 2, 4), thrown(-3, 1, 7, 0.5), thrown(0, 9, -1, -1)],
    "falling body": [disc(EMPTY, 0, 5), disc(EMPTY, 3, 1)],
}
