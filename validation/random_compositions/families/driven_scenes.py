"""Driven scenes: cars with motors, belts, lifts on rods that change length, pistons."""

from itertools import pairwise

from validation.random_compositions.scene_builder import Draft, body_point


def motor_car(draft: Draft) -> None:
    """Build a car with a motor on its rear wheel, on a rough floor, perhaps against a box."""
    draft.rough(0.3, 1)
    draft.floor()
    radius, wide = draft.number(0.1, 0.24), draft.number(1, 2)
    base = 2 * radius + 0.05
    wheel_mass = draft.number(1, 10)
    chassis = draft.box("chassis", (0, base + 0.1), (wide, 0.2), wheel_mass * draft.scaled(1, 100))
    for name, side in (("rear", -1), ("front", 1)):
        x = side * (wide / 2 - radius)
        draft.disc(name, (x, radius), radius, wheel_mass)
        axle = body_point(chassis, x, radius - base - 0.1)
        if side < 0:
            draft.join("motor", "motor", axle, name, rate=draft.number(-4, -0.5))
        else:
            draft.join("axle", "pivot", axle, name)
    if draft.chance():
        draft.box("box", (wide / 2 + 1, 0.2), (0.4, 0.4), draft.ratio())


def belt(draft: Draft) -> None:
    """Build bodies tied together, which ride on a belt."""
    draft.rough(0.3, 1)
    draft.block("belt", (0, -0.5), (40, 1))
    draft.effects["belt"] = [{"body": "belt", "velocity": [draft.number(-3, 3), 0]}]
    names = []
    for i in range(draft.count(2, 3)):
        size = draft.number(0.1, 0.4)
        names.append(draft.box(f"box{i}", (0.7 * i, size / 2), (size, size), draft.mass()))
    for a, b in pairwise(names):
        draft.join(f"{a}_{b}", draft.pick(("rod", "rope", "weld")), a, b)
    if draft.chance():
        draft.join("leash", "rope", names[0], [-1, 0.2])


def lift(draft: Draft) -> None:
    """Build a platform between rails on a rod of changing length, with a box on it."""
    draft.rotation = False
    if draft.chance():
        draft.rough()
    draft.box("platform", (0, 1), (1, 0.1), draft.mass())
    swing = f"1 + {draft.number(0.02, 0.1)}*sin({draft.number(2, 6)}*t)"
    draft.join("piston", "rod", [0, 0], "platform", length=swing)
    draft.join("rail", "rail", "platform", [0, 0], direction=[0, 1])
    size = draft.number(0.1, 0.4)
    draft.box("box", (0, 1.05 + size / 2), (size, size), draft.mass())


def pusher(draft: Draft) -> None:
    """Build a kinematic wall that pushes boxes with bars between them."""
    draft.surfaces()
    draft.floor()
    shape = {"type": "box", "width": 0.2, "height": 1}
    draft.add("wall", shape, (-1, 0.55), type="kinematic", velocity=[draft.number(0.5, 2), 0])
    for i in range(2):
        size = draft.number(0.1, 0.4)
        draft.box(f"box{i}", (0.7 * i, size / 2), (size, size), draft.mass())
    draft.join("bar", draft.pick(("rod", "weld", "rope")), "box0", "box1")
