"""The parts that the scenes of hard cases are made of."""

from collections.abc import Sequence
from typing import Any

Document = dict[str, Any]
"""A level, or a part of one, as in its file."""

Place = Sequence[float]
"""[x, y] in m."""

G = 9.81  # m/s²
GRAVITY: Document = {"gravity": {"acceleration": [0, -G]}}

SLOP = 0.01
"""The overlap that is left alone in a pile, as a share of the bodies' size: correcting it pushes
bodies apart, which rocks the pile. pymunk's own, 0.1, was made for pixels."""

WATCHED = 4000
"""The most steps of a level with a high rate, which takes seconds in the app and in the tour."""

NEWTON = "4. Newton's laws: gravity, friction and the normal force"
MOMENTUM = "7. Momentum, impulse, and collisions: elastic vs inelastic collisions"
ROTATION = "8. Rotational dynamics: torque and moment of inertia"
LAGRANGE = "9. Lagrangian mechanics: constraints and pendulums"


def pile(size: float, *, overlaps: bool = False) -> Document:
    """Return the effects of a pile of bodies of a size [m], which may overlap at the start.

    Its contacts are left to sweeps, since that is hard.
    """
    contact: Document = {"solver": "iterative", "slop": SLOP * size}
    if overlaps:
        contact["overlaps"] = True
    return {**GRAVITY, "contact": contact, "friction": {}, "rotation": {}}


def text_of(number: float) -> str:
    """Return a large number as people write it."""
    return f"{number:,.0f}"


def box(
    position: Place, width: float, height: float, mass: float = 1.0, **rest: object
) -> Document:
    """Return a dynamic box; m and kg."""
    shape = {"type": "box", "width": width, "height": height}
    return {"shape": shape, "mass": mass, "position": rounded(position), **rest}


def disc(position: Place, radius: float, mass: float = 1.0, **rest: object) -> Document:
    """Return a dynamic disc; m and kg."""
    shape = {"type": "disc", "radius": radius}
    return {"shape": shape, "mass": mass, "position": rounded(position), **rest}


def block(position: Place, width: float, height: float, **rest: object) -> Document:
    """Return a static box; m."""
    shape = {"type": "box", "width": width, "height": height}
    return {"type": "static", "shape": shape, "position": rounded(position), **rest}


def ground(half: float, friction: float = 0.6, **rest: object) -> Document:
    """Return a static floor with its surface at y = 0, and given its extent to either side [m]."""
    return block((0, -0.5), 2 * half, 1, friction=friction, **rest)


def rod(first: object, second: object) -> Document:
    """Return a rod between two ends."""
    return {"type": "rod", "ends": [first, second]}


def rounded(position: Place) -> list[float]:
    """Return coordinates with as many digits as a reader can use [m]."""
    return [round(float(x), 12) for x in position]


def check(
    quantity: str, value: float | str, tolerance: float, label: str, **rest: object
) -> Document:
    """Return a check of a level."""
    return {
        "label": label, "quantity": quantity, "formula": value, "tolerance": tolerance, **rest
    }  # fmt: skip


def level(title: str, summary: str, reference: str, **parts: object) -> Document:
    """Return a level in the first version of the format."""
    head = {"format": 1, "title": title, "summary": summary, "reference": reference}
    return {"$schema": "../level.schema.json", **head, **parts}
