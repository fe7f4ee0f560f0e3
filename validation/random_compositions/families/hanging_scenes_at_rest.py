"""Hanging scenes that stay at rest: cranes, platforms, weights over pegs and on wheels."""

from validation.random_compositions.scene_builder import Draft, body_point


def relieved(draft: Draft) -> None:
    """Build a box on the floor, relieved by a lighter weight over a peg."""
    draft.is_at_rest = True
    if draft.chance():
        draft.rough()
    draft.floor()
    size, mass = draft.number(0.2, 1), draft.mass()
    draft.box("box", (0, size / 2), (size, size), mass)
    draft.disc("weight", (1.5, 1.5), 0.1, round(mass * draft.scaled(0.001, 0.9), 8))
    draft.join("string", "pulley", "box", "weight", over=[[0, 3], [1.5, 3]])
    if draft.chance(0.3):
        draft.box("rider", (0, size + 0.1), (0.2, 0.2), draft.mass())


def crane(draft: Draft) -> None:
    """Build a mast on the ground, a boom pinned to it, a tie, and a load on a rope."""
    draft.is_at_rest = True
    draft.floor()
    if draft.chance(0.5):
        draft.rough()
    high, long = draft.number(2, 4), draft.number(1, 3)
    mast = draft.box("mast", (0, 0.02 + high / 2), (0.2, high), draft.number(5, 50))
    draft.join("base", "weld", [0, 0], mast)
    boom = draft.box("boom", (0.15 + long / 2, 0.6 * high), (long, 0.1), draft.number(1, 20))
    draft.join(
        "hinge", "pivot", body_point(mast, 0.15, 0.1 * high - 0.02), body_point(boom, -long / 2, 0)
    )
    tie = draft.pick(("rod", "rope"))
    draft.join("tie", tie, body_point(mast, 0, high / 2), body_point(boom, 0.4 * long, 0))
    drop = draft.number(0.3, 0.4) * high
    draft.disc("load", (0.15 + long, 0.6 * high - drop), 0.1, draft.scaled(1, 1000))
    draft.join("rope", "rope", body_point(boom, long / 2, 0), "load")


def platform(draft: Draft) -> None:
    """Build a platform on ropes or rods, with a stack on it."""
    draft.is_at_rest = True
    draft.rough(0.6, 1)
    wide, thick = draft.number(1, 2), 0.1
    draft.box("platform", (0, 0), (wide, thick), draft.number(1, 5))
    kind, splay = draft.pick(("rope", "rod")), draft.pick((0.0, 0.0, -0.2))
    for name, side in (("left", -1), ("right", 1)):
        x = side * wide / 2
        draft.join(name, kind, body_point("platform", x, 0), [round(x + side * splay, 12), 2.5])
    y = thick / 2
    for i in range(draft.count(1, 3)):
        size = draft.number(0.15, 0.3)
        draft.box(f"box{i}", (0, y + size / 2), (size, size), draft.ratio())
        y += size


def braked_wheel(draft: Draft) -> None:
    """Build a load on a string that is wound on a wheel, which is held by a rod."""
    draft.is_at_rest = True
    draft.contact = False
    radius = draft.number(0.1, 0.5)
    draft.disc("wheel", (0, 0), radius, draft.mass())
    draft.join("axle", "pivot", "wheel", [0, 0])
    draft.disc("load", (radius, -2), 0.1, draft.mass())
    draft.join("string", "winding", "load", "wheel", radius=radius, unwinds="clockwise")
    draft.join("brake", "rod", body_point("wheel", -radius, 0), [-radius, -1])


def trolley(draft: Draft) -> None:
    """Build a bead on a level wire, or a body on a rail, with a load on a rod below it."""
    draft.is_at_rest = True
    draft.contact = False
    draft.disc("trolley", (0, 0), 0.05, draft.mass())
    if draft.chance():
        draft.joints["wire"] = {
            "type": "wire", "bead": "trolley", "curve": ["s", "0.1*s**2"], "s": [-3, 3],
        }  # fmt: skip
    else:
        draft.join("rail", "rail", "trolley", [0, 0], direction=[1, 0])
    draft.disc("load", (0, -draft.number(0.3, 2)), 0.1, draft.mass())
    draft.join("rod", draft.pick(("rod", "rope")), "trolley", "load")
    draft.rotation = False


def pressed(draft: Draft) -> None:
    """Build a box on the floor under a loaded spring, guided by a rail."""
    draft.is_at_rest, draft.rotation = True, False
    draft.rough(0.2, 1)  # or the box would buckle out
    draft.floor()
    size, load = draft.number(0.1, 0.5), draft.mass()
    mass = max(draft.mass(), load / 1000)
    draft.box("box", (0, size / 2), (size, size), mass)
    stiffness = draft.scaled(10, 1000) * load
    high = size + draft.number(0.4, 1)
    draft.disc("load", (0, high), 0.1, load)
    slack = high - size / 2 + load * 9.81 / stiffness
    spring = {"stiffness": stiffness, "length": slack}
    if draft.chance():
        spring["damping"] = round(0.2 * (stiffness * load) ** 0.5, 6)
    draft.join("spring", "spring", "box", "load", **spring)
    draft.join("rail", "rail", "load", [0, high], direction=[0, 1])
