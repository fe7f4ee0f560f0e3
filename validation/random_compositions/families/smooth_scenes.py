"""Smooth scenes without impacts, whose errors show an order: linkages, pendulums, springs."""

from itertools import pairwise
from math import cos, sin

from validation.random_compositions.scene_builder import Draft, body_point


def _untouched(draft: Draft) -> None:
    draft.contact = False
    draft.duration = 1.0


def pendulums(draft: Draft) -> None:
    """Build several bobs below each other, on rods or pinned sticks."""
    _untouched(draft)
    x = y = 0.0
    above: object = [0.0, 0.0]
    pinned = draft.chance()
    draft.rotation = pinned
    for i in range(draft.count(1, 4)):
        long, angle, mass = draft.number(0.3, 1), draft.number(-1, 1), draft.mass()
        dx, dy = long * sin(angle), -long * cos(angle)
        if pinned:
            draft.add(
                f"bob{i}", {"type": "box", "width": 0.05, "height": long}, (x + dx / 2, y + dy / 2),
                mass=mass, angle=angle,
            )  # fmt: skip
            draft.join(f"pin{i}", "pivot", above, body_point(f"bob{i}", 0, long / 2))
            above = body_point(f"bob{i}", 0, -long / 2)
        else:
            draft.disc(f"bob{i}", (x + dx, y + dy), 0.05, mass)
            draft.join(f"rod{i}", "rod", above, f"bob{i}")
            above = f"bob{i}"
        x, y = x + dx, y + dy


def four_bar(draft: Draft) -> None:
    """Build a linkage of two cranks and a coupler, which turns."""
    _untouched(draft)
    long, wide = draft.number(0.4, 1), draft.number(0.6, 1.5)
    angles = draft.number(0.2, 1), draft.number(0.2, 1)
    ends = []
    for name, x, angle in (("a", 0.0, angles[0]), ("b", wide, angles[1])):
        dx, dy = long * sin(angle), -long * cos(angle)
        shape = {"type": "box", "width": 0.05, "height": long}
        draft.add(name, shape, (x + dx / 2, dy / 2), mass=draft.mass(), angle=angle)
        draft.join(f"pin_{name}", "pivot", [x, 0], body_point(name, 0, long / 2))
        ends.append((x + dx, dy))
    draft.join("coupler", "rod", body_point("a", 0, -long / 2), body_point("b", 0, -long / 2))
    bob = ends[1][0], ends[1][1] - 0.5
    draft.disc("bob", bob, 0.1, draft.mass())
    draft.join("hanger", "rod", body_point("b", 0, -long / 2), "bob")


def springs(draft: Draft) -> None:
    """Build bodies hung from springs and rods."""
    _untouched(draft)
    draft.rotation = False
    names = []
    for i in range(draft.count(2, 4)):
        mass = draft.mass()
        names.append(draft.disc(f"bob{i}", (0.7 * i, -1), 0.1, mass))
        draft.join(
            f"spring{i}", "spring", names[-1], [0.7 * i, 0], stiffness=draft.scaled(20, 300) * mass,
            length=draft.number(0.7, 1.1),
        )  # fmt: skip
    for a, b in pairwise(names):
        draft.join(f"{a}_{b}", draft.pick(("rod", "rod", "spring")), a, b)
        if draft.joints[f"{a}_{b}"]["type"] == "spring":
            draft.joints[f"{a}_{b}"]["stiffness"] = draft.scaled(5, 50)


def machine(draft: Draft) -> None:
    """Build weights on strings over pegs, over wheels, and under a movable pulley."""
    _untouched(draft)
    draft.rotation = False
    masses = [draft.mass() for _ in range(3)]
    for i, (x, mass) in enumerate(zip((0, 1, 2), masses, strict=True)):
        draft.disc(f"weight{i}", (x, -30), 0.1, mass)
    over = [[0, 0], [0.5, 0], "weight1", [1.5, 0], [2, 0]]
    draft.join("string", "pulley", "weight0", "weight2", over=over)


def bead(draft: Draft) -> None:
    """Build a bead with a pendulum on a bowl-shaped wire."""
    _untouched(draft)
    draft.rotation = False
    start = draft.number(-1.5, 1.5)
    draft.disc("bead", (start, 0.3 * start**2), 0.05, draft.mass())
    draft.joints["wire"] = {
        "type": "wire", "bead": "bead", "curve": ["s", "0.3*s**2"], "s": [-6, 6],
    }  # fmt: skip
    draft.disc("bob", (start + 0.3, 0.3 * start**2 - 0.8), 0.05, draft.mass())
    draft.join("rod", "rod", "bead", "bob")
