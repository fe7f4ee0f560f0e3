"""Standing scenes that stay at rest: struts, frames, tables, cars, ladders."""

from itertools import pairwise
from math import cos, pi, sin, tan

from validation.random_compositions.scene_builder import Draft, body_point


def _grip(draft: Draft, needed: float) -> None:
    """Give all pairs more friction than the coefficient they need to stand."""
    root = (1.3 * needed) ** 0.5
    draft.rough(root, max(1.0, 1.2 * root))


def strut(draft: Draft) -> None:
    """Build a heavy body on a light one through a rod, kept upright by a rail and friction."""
    draft.is_at_rest, draft.rotation = True, False
    draft.rough(0.2, 1)
    draft.floor()
    size = draft.number(0.1, 0.4)
    foot = draft.box("foot", (0, size / 2), (size, size), draft.number(0.5, 5))
    mass = draft.bodies[foot]["mass"] * draft.ratio()
    high = size + draft.number(0.3, 1.5)
    top = draft.disc("load", (0, high), 0.1, mass)
    draft.join("rod", "rod", foot, top)
    draft.join("rail", "rail", top, [0, high], direction=[0, 1])


def a_frame(draft: Draft) -> None:
    """Build a load on two rods whose feet are held by friction alone."""
    draft.is_at_rest, draft.rotation = True, draft.chance()
    spread, high, size = draft.number(0.3, 0.7), draft.number(0.8, 1.5), 0.2
    _grip(draft, spread / (high - size / 2))
    draft.floor()
    feet = [
        draft.box(name, (x, size / 2), (1.5 * size, size), draft.number(1, 5))
        for name, x in (("left", -spread), ("right", spread))
    ]
    load = draft.disc("load", (0, high), 0.1, draft.ratio())
    for foot in feet:
        draft.join(f"{foot}_rod", "rod", foot, load)


def table(draft: Draft) -> None:
    """Build a table top on two welded legs, with loads on it."""
    draft.is_at_rest = True
    if draft.chance(0.7):
        draft.rough()
    draft.floor()
    wide, high, thick = draft.number(1, 3), draft.number(0.5, 1.2), 0.1
    top = draft.box("top", (0, high + thick / 2), (wide, thick), draft.number(1, 10))
    for name, side in (("left", -1), ("right", 1)):
        x = side * (wide / 2 - 0.1)
        leg = draft.box(name, (x, high / 2), (0.1, high), draft.number(1, 2))
        draft.join(f"{name}_weld", "weld", top, leg)
    _loads(draft, wide - 0.4, high + thick, draft.count(1, 3))


def _loads(draft: Draft, wide: float, base: float, count: int) -> None:
    """Put boxes beside each other on a surface."""
    room = wide / count
    for i in range(count):
        size = min(draft.number(0.1, 0.4), 0.8 * room)
        x = -wide / 2 + (i + 0.5) * room
        draft.box(f"load{i}", (x, base + size / 2), (size, size), draft.ratio())


def car(draft: Draft) -> None:
    """Build a loaded chassis on two wheels, at rest on level ground."""
    draft.is_at_rest = True
    if draft.chance(0.8):
        draft.rough()
    draft.floor()
    radius, wide, thick = draft.number(0.1, 0.22), draft.number(1, 2), 0.2
    base = 2 * radius + 0.05
    chassis = draft.box("chassis", (0.0, base + thick / 2), (wide, thick), draft.ratio())
    for name, side in (("rear", -1), ("front", 1)):
        at = side * (wide / 2 - radius)
        wheel = draft.disc(name, (at, radius), radius, draft.number(1, 10))
        draft.join(
            f"{name}_axle", "pivot", body_point(chassis, at, radius - base - thick / 2), wheel
        )
    _loads(draft, wide - 2 * radius, base + thick, draft.count(0, 2) or 1)


def ladder(draft: Draft) -> None:
    """Build a ladder between a rough floor and a wall, with a load on a rope."""
    draft.is_at_rest = True
    draft.rough(1, 1)
    long, thick, lean = draft.number(2, 4), 0.06, draft.number(58, 75) * pi / 180
    draft.floor()
    reach_x, reach_y = (
        long / 2 * cos(lean) + thick / 2 * sin(lean),
        long / 2 * sin(lean) + thick / 2 * cos(lean),
    )
    shape = {"type": "box", "width": long, "height": thick}
    draft.add("ladder", shape, (0, reach_y), mass=draft.number(5, 20), angle=lean)
    draft.block("wall", (reach_x + 0.5, 5), (1, 10), friction=draft.number(0, 0.5))
    at = draft.number(-0.4, 0.1) * long
    x, y = at * cos(lean), reach_y + at * sin(lean)
    radius = 0.05
    rope = 0.35 / cos(lean) * 0.5 + 0.1
    if y - rope > radius + 0.02:
        draft.disc("load", (x, y - rope), radius, draft.scaled(1, 1000))
        draft.join("rope", "rope", body_point("ladder", at, 0), "load")


def beam(draft: Draft) -> None:
    """Build a beam on two posts, or on a pin and a post, with loads on it."""
    draft.is_at_rest = True
    if draft.chance(0.7):
        draft.rough()
    wide, thick = draft.number(2, 4), 0.1
    draft.block("right", (wide / 2 - 0.1, 0.5), (0.2, 1))
    place = (0, 1 + thick / 2)
    draft.box("beam", place, (wide, thick), draft.number(1, 20))
    if draft.chance():
        draft.join("pin", "pivot", body_point("beam", -wide / 2, 0), [-wide / 2, place[1]])
    else:
        draft.block("left", (-wide / 2 + 0.1, 0.5), (0.2, 1))
    _loads(draft, wide - 0.6, 1 + thick, draft.count(1, 3))


def dumbbell_at_rest(draft: Draft) -> None:
    """Build two boxes on the floor, with a rod, a weld or a taut rope between them."""
    draft.is_at_rest = True
    if draft.chance():
        draft.rough()
    draft.floor()
    for name, x in (("left", -0.6), ("right", 0.6)):
        size = draft.number(0.1, 0.5)
        draft.box(name, (x, size / 2), (size, size), draft.mass())
    draft.join("bar", draft.pick(("rod", "weld", "rope")), "left", "right")


def bracket(draft: Draft) -> None:
    """Build boxes welded to each other and to the plane, with loads on them."""
    draft.is_at_rest = True
    if draft.chance(0.7):
        draft.rough()
    count, wide, thick = draft.count(1, 3), 0.5, 0.2
    names = [
        draft.box(f"arm{i}", (wide * (i + 0.5), 1), (wide, thick), draft.number(1, 5))
        for i in range(count)
    ]
    draft.join("wall", "weld", [0, 1], names[0])
    for a, b in pairwise(names):
        draft.join(f"{a}_{b}", "weld", a, b)
    size = draft.number(0.1, 0.3)
    draft.box("load", (wide * count - 0.2, 1 + thick / 2 + size / 2), (size, size), draft.ratio())


def scissor(draft: Draft) -> None:
    """Build a scissor lift with a load on its platform, its feet held at a distance."""
    draft.is_at_rest = True
    if draft.chance(0.7):
        draft.rough()
    half, lean, stages = draft.number(0.4, 0.8), draft.number(30, 60) * pi / 180, draft.count(1, 2)
    # so that sums are written to the last digit: pins apart by 1e-12 m pull when they are joined
    x, y = round(half * cos(lean), 9), round(half * sin(lean), 9)
    names = []
    for stage in range(stages):
        for way, sign in (("rising", 1), ("falling", -1)):
            place = (0.05 * sign, (2 * stage + 1) * y)
            name = f"{way}{stage}"
            draft.disc(name, place, 0.02, draft.number(1, 2), moment=0.1)
            names.append(name)
        a, b = names[-2:]
        draft.join(f"middle{stage}", "pivot", body_point(a, -0.05, 0), body_point(b, 0.05, 0))
    ends = {1: (-0.05 + x, y), -1: (-0.05 - x, -y), 2: (0.05 - x, y), -2: (0.05 + x, -y)}
    for stage in range(stages - 1):
        low, high = f"rising{stage}", f"falling{stage + 1}"
        draft.join(f"right{stage}", "pivot", body_point(low, *ends[1]), body_point(high, *ends[-2]))
        low, high = f"falling{stage}", f"rising{stage + 1}"
        draft.join(f"left{stage}", "pivot", body_point(low, *ends[2]), body_point(high, *ends[-1]))
    draft.join("foot", "pivot", body_point("rising0", *ends[-1]), [-x, 0])
    draft.join("track", "rail", body_point("falling0", *ends[-2]), [x, 0], direction=[1, 0])
    draft.join("bar", "rod", body_point("rising0", *ends[-1]), body_point("falling0", *ends[-2]))
    _platform(draft, x, 2 * stages * y, stages - 1, ends)


def _platform(
    draft: Draft, x: float, y: float, stage: int, ends: dict[int, tuple[float, float]]
) -> None:
    """Put a platform on a lift, and a load on it."""
    thick = 0.1
    draft.box("platform", (0, y + thick), (2 * x + 0.2, thick), draft.number(1, 5))
    top = body_point("platform", -x, -thick)
    draft.join("top_pin", "pivot", body_point(f"falling{stage}", *ends[2]), top)
    slide = body_point(f"rising{stage}", *ends[1])
    draft.join("top_track", "rail", slide, body_point("platform", x, -thick), direction=[1, 0])
    size = draft.number(0.1, 0.4)
    place = (draft.number(-0.5, 0.5) * x, y + 1.5 * thick + size / 2)
    draft.box("load", place, (size, size), draft.ratio())


def wedged(draft: Draft) -> None:
    """Build a box on an incline, held by friction and by a weight over a peg at the top."""
    draft.is_at_rest = True
    lean = draft.number(10, 40) * pi / 180
    _grip(draft, tan(lean))
    half = draft.number(0.1, 0.3)
    shape = {"type": "box", "width": 6, "height": 1}
    draft.add("incline", shape, (0, 0), type="static", angle=lean)
    normal = 0.5 + half
    place = (-normal * sin(lean), normal * cos(lean))
    mass = draft.mass()
    draft.add(
        "box", {"type": "box", "width": 2 * half, "height": 2 * half}, place, mass=mass, angle=lean
    )
    peg = (place[0] + 4 * cos(lean), place[1] + 4 * sin(lean))
    draft.disc("weight", (peg[0] + 0.5, peg[1] - 1), 0.1, mass * draft.number(0.1, 1.2) * sin(lean))
    draft.join("string", "pulley", "box", "weight", over=[list(peg), [peg[0] + 0.5, peg[1]]])
