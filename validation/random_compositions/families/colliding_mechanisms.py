"""Moving scenes with impacts: pendulums, seesaws, dumbbells, ragdolls, trains, wrecking balls."""

from itertools import pairwise
from math import cos, pi, sin

from validation.random_compositions.scene_builder import Draft, body_point


def pendulum_at_a_wall(draft: Draft) -> None:
    """Build a bob on a rod or a rope that swings against a wall, or against another bob."""
    draft.surfaces()
    draft.rotation = draft.chance()
    long, radius, drawn = draft.number(0.5, 2), draft.number(0.1, 0.3), draft.number(0.3, 1.4)
    bob = draft.disc("bob", (-long * sin(drawn), -long * cos(drawn)), radius, draft.mass())
    draft.join("rod", draft.pick(("rod", "rope")), bob, [0, 0])
    if draft.chance():
        draft.block("wall", (radius + 0.1, -long), (0.2, 3))
        return
    other = draft.disc("other", (2 * radius, -long), radius, draft.mass())
    draft.join("other_rod", draft.pick(("rod", "rope")), other, [2 * radius, 0])


def dumbbell(draft: Draft) -> None:
    """Build two bodies with a rod, a weld or a rope between them, dropped at an angle."""
    draft.surfaces()
    if not draft.friction:
        draft.conserved_momenta = ("x",)
    draft.floor()
    lean, long, high = draft.number(-1.4, 1.4), draft.number(0.5, 1.5), draft.number(0.3, 1.5)
    speed = draft.number(-2, 2)
    for name, side in (("left", -1), ("right", 1)):
        x, y = side * long / 2 * cos(lean), side * long / 2 * sin(lean) + long / 2 + high
        size = draft.number(0.05, 0.2)
        mass, velocity = draft.mass(), [speed, 0]
        if draft.chance():
            draft.disc(name, (x, y), size, mass, velocity=velocity)
        else:
            draft.box(name, (x, y), (size, size), mass, velocity=velocity)
    draft.join("bar", draft.pick(("rod", "rod", "weld", "rope")), "left", "right")


def seesaw(draft: Draft) -> None:
    """Build a plank on a pin; a box lies on one end, and another is dropped on the other."""
    draft.surfaces()
    draft.floor()
    half, high, thick = draft.number(1, 2), draft.number(0.6, 1), 0.1
    draft.box("plank", (0, high), (2 * half, thick), draft.mass())
    draft.join("pin", "pivot", "plank", [0, high])
    for name, side, drop in (("lying", -1, 0.0), ("dropped", 1, draft.number(0.1, 1))):
        size = draft.number(0.1, 0.4)
        place = (side * (half - 0.3), high + thick / 2 + size / 2 + drop)
        draft.box(name, place, (size, size), draft.mass())


def ragdoll(draft: Draft) -> None:
    """Build a trunk with a head, arms and legs, dropped on the floor."""
    draft.surfaces()
    draft.floor()
    scale, y = draft.number(0.5, 1.5), draft.number(1.5, 2.5)
    trunk = draft.box("trunk", (0, y), (0.3 * scale, 0.6 * scale), draft.mass())
    head = draft.disc("head", (0, y + 0.5 * scale), 0.12 * scale, draft.mass())
    draft.join(
        "neck", "pivot", body_point(trunk, 0, 0.34 * scale), body_point(head, 0, -0.16 * scale)
    )
    for side in (-1, 1):
        for name, at, low in (("arm", 0.2, 0.28), ("leg", 0.1, -0.32)):
            limb = f"{name}{'lr'[side > 0]}"
            size = (0.08 * scale, draft.number(0.4, 0.5) * scale)
            drop = low - 0.02 - size[1] / 2 / scale
            place = (side * at * scale, y + drop * scale)
            draft.box(limb, place, size, draft.mass())
            top = size[1] / 2 + 0.01 * scale
            draft.join(
                f"{limb}_joint", "pivot",
                body_point(trunk, side * at * scale, (low - 0.01) * scale),
                body_point(limb, 0, top),
            )  # fmt: skip


def cart_downhill(draft: Draft) -> None:
    """Build a cart that rolls down an incline on to the floor, perhaps with a trailer."""
    draft.rough(0.3, 1)
    if draft.chance(0.3):
        draft.bouncy()
    lean = draft.number(5, 30) * pi / 180
    draft.add(
        "incline", {"type": "box", "width": 20, "height": 1}, (0, 0), type="static", angle=-lean
    )
    radius, wide = draft.number(0.1, 0.19), draft.number(0.8, 1.5)
    base, light = 2 * radius + 0.05, draft.number(1, 2)

    def up(along: float, high: float) -> tuple[float, float]:
        high += 0.5
        return along * cos(lean) + high * sin(lean), -along * sin(lean) + high * cos(lean)

    size = {"type": "box", "width": wide, "height": 0.2}
    draft.add("chassis", size, up(0, base + 0.1), mass=draft.ratio(), angle=-lean)
    for name, side in (("rear", -1), ("front", 1)):
        along = side * (wide / 2 - radius)
        wheel = draft.disc(name, up(along, radius), radius, light)
        axle = body_point("chassis", along, radius - base - 0.1)
        draft.join(f"{name}_axle", "pivot", axle, wheel)
    if draft.chance():
        block = {"type": "box", "width": 0.3, "height": 0.3}
        draft.add("trailer", block, up(-wide / 2 - 0.6, 0.15), mass=draft.ratio(), angle=-lean)
        draft.join(
            "bar", draft.pick(("rod", "rope")), body_point("chassis", -wide / 2, 0), "trailer"
        )


def block_and_weight(draft: Draft) -> None:
    """Build a block on a level or inclined table, drawn by a weight over a peg."""
    if draft.chance(0.7):
        draft.rough()
    if draft.chance(0.3):
        draft.bouncy()
    lean = draft.pick((0.0, draft.number(0.1, 0.6)))
    draft.add("table", {"type": "box", "width": 50, "height": 1}, (0, 0), type="static", angle=lean)
    half = draft.number(0.1, 0.4)
    height = 0.5 + half
    place = (-height * sin(lean) - cos(lean), height * cos(lean) - sin(lean))
    draft.add(
        "block", {"type": "box", "width": 2 * half, "height": 2 * half}, place, mass=draft.mass(),
        angle=lean,
    )  # fmt: skip
    peg = (place[0] + 14 * cos(lean), place[1] + 14 * sin(lean))
    end = 14 * cos(lean) + 12  # m; beyond the table
    draft.disc("weight", (end, peg[1] - 13), 0.1, draft.mass())
    draft.join("string", "pulley", "block", "weight", over=[list(peg), [end, peg[1]]])
    if draft.chance(0.4):
        draft.block("ground", (end, peg[1] - 13 - draft.number(0.3, 2)), (1, 0.2))


def chain_dropped(draft: Draft) -> None:
    """Build a chain of discs or of links, dropped on the floor, perhaps with a load at its end."""
    draft.surfaces()
    draft.floor()
    count, radius, lean = draft.count(3, 7), draft.number(0.03, 0.08), draft.number(0, 1.5)
    pitch, mass, high = 3 * radius, draft.scaled(0.1, 1), draft.number(0.2, 1)
    kind = draft.pick(("rod", "rope", "rod"))
    for i in range(count):
        heavy = mass * draft.ratio() if i == count - 1 and draft.chance() else mass
        place = (i * pitch * cos(lean), high + i * pitch * sin(lean))
        draft.disc(f"link{i}", place, radius, heavy)
        if i:
            draft.join(f"joint{i}", kind, f"link{i - 1}", f"link{i}")
    if not draft.friction:
        draft.conserved_momenta = ("x",)


def train(draft: Draft) -> None:
    """Build boxes with bars between them that slide on a floor against a wall."""
    draft.surfaces()
    draft.floor()
    draft.block("wall", (1.5, 1), (0.5, 2))
    speed, x, names = draft.number(0.5, 4), 1.1, []
    for i in range(draft.count(2, 4)):
        size = draft.number(0.1, 0.4)
        x -= size / 2
        name = f"wagon{i}"
        draft.box(name, (x, size / 2), (size, size), draft.mass(), velocity=[speed, 0])
        x -= size / 2 + 0.2
        names.append(name)
    for a, b in pairwise(names):
        draft.join(f"{a}_{b}", draft.pick(("rod", "rope", "weld")), a, b)


def wrecking_ball(draft: Draft) -> None:
    """Build a heavy ball on a rope that hits a stack."""
    draft.surfaces()
    if not draft.friction:
        draft.rough(0.3, 1)
    draft.floor()
    size, count = 0.3, draft.count(1, 3)
    for i in range(count):
        draft.box(f"box{i}", (0, size * (i + 0.5)), (size, size), draft.mass())
    long, drawn = 2.0, draft.number(0.3, 1)
    peg = (-0.15 - 0.2, size * count / 2 + long + 0.05)
    place = (peg[0] - long * sin(drawn), peg[1] - long * cos(drawn))
    draft.disc("ball", place, 0.2, draft.scaled(1, 100))
    draft.join("rope", draft.pick(("rope", "rod")), "ball", list(peg))


def bolas(draft: Draft) -> None:
    """Build bodies tied together that fly about in space, and hit each other."""
    draft.gravity, draft.conserved_momenta = (0.0, 0.0), ("x", "y", "angle")
    draft.surfaces()
    count = draft.count(2, 4)
    for i in range(count):
        velocity = [draft.number(-2, 2), draft.number(-2, 2)]
        draft.disc(
            f"ball{i}", (0.8 * i, 0), draft.number(0.05, 0.3), draft.mass(), velocity=velocity
        )
        if i:
            draft.join(f"tie{i}", draft.pick(("rope", "rope", "rod")), f"ball{i - 1}", f"ball{i}")
    speeds = [body["velocity"] for body in draft.bodies.values()]
    for body in draft.bodies.values():  # equal velocities, so that no joint is jerked at first
        body["velocity"] = list(speeds[0])
    stray = [draft.number(-4, 4), draft.number(-4, -1)]
    draft.disc("stray", (0.4 * count, 1.5), 0.2, draft.mass(), velocity=stray)


def yo_yo(draft: Draft) -> None:
    """Build a weight that unwinds its string from a wheel, and lands; or a falling wheel."""
    draft.surfaces()
    draft.floor()
    radius, mass = draft.number(0.1, 0.4), draft.mass()
    if draft.chance():
        draft.disc("wheel", (0, 3), radius, mass)
        draft.join("axle", "pivot", "wheel", [0, 3])
        draft.disc("load", (radius, draft.number(0.3, 1.5)), 0.1, draft.mass())
        draft.join("string", "winding", "load", "wheel", radius=radius, unwinds="clockwise")
        return
    draft.disc("wheel", (0, radius + draft.number(0.2, 1.5)), radius, mass)
    draft.join("string", "winding", [radius, 4], "wheel", radius=radius, unwinds="counterclockwise")


def bead_and_block(draft: Draft) -> None:
    """Build a bead that slides along a wire, and drags or lifts a block on the floor."""
    draft.surfaces()
    draft.rotation = draft.chance()
    draft.floor()
    start = draft.number(-1.2, -0.4)
    draft.disc("bead", (start, 1.5 + 0.4 * start**2), 0.05, draft.mass())
    draft.joints["wire"] = {
        "type": "wire", "bead": "bead", "curve": ["s", "1.5 + 0.4*s**2"], "s": [-4, 4],
    }  # fmt: skip
    size = draft.number(0.1, 0.4)
    draft.box("block", (start, size / 2), (size, size), draft.mass())
    draft.join("tie", draft.pick(("rope", "rod")), "bead", "block")


def collapse(draft: Draft) -> None:
    """Build a table whose legs have pins at both ends and the knee; it collapses under its load."""
    draft.surfaces()
    draft.floor()
    wide, long = draft.number(0.8, 1.6), 0.5
    y = 2 * long + 0.06
    draft.box("top", (0, y), (wide, 0.1), draft.mass())
    for name, side in (("l", -1), ("r", 1)):
        x = side * (wide / 2 - 0.1)
        size = (0.08, long - 0.04)
        draft.box(f"thigh{name}", (x, 1.5 * long - 0.01), size, draft.mass())
        draft.box(f"shin{name}", (x, 0.5 * long - 0.02), size, draft.mass())
        draft.join(
            f"hip{name}",
            "pivot",
            body_point("top", x, -0.06),
            body_point(f"thigh{name}", 0, long / 2 + 0.01),
        )
        knee = (
            body_point(f"thigh{name}", 0, -long / 2),
            body_point(f"shin{name}", 0, long / 2 + 0.01),
        )
        draft.join(f"knee{name}", "pivot", *knee)
    draft.bodies["top"]["velocity"] = [0.0, 0.0]
    draft.disc("load", (0, y + 0.05 + 0.2 + draft.number(0.1, 1)), 0.2, draft.mass())


def fluid(draft: Draft) -> None:
    """Build pinned bodies that swing in a fluid, down to the floor."""
    draft.surfaces()
    draft.floor()
    masses = [draft.mass() for _ in range(3)]
    draft.effects["drag"] = {
        draft.pick(("linear", "quadratic")): draft.number(0.1, 3) * min(masses)
    }
    for i, mass in enumerate(masses):
        draft.box(f"rod{i}", (0.25 + 0.5 * i, 1.2), (0.4, 0.08), mass)
    draft.join("nail", "pivot", body_point("rod0", -0.25, 0), [0, 1.2])
    for i in (1, 2):
        draft.join(
            f"pin{i}", "pivot", body_point(f"rod{i - 1}", 0.25, 0), body_point(f"rod{i}", -0.25, 0)
        )
