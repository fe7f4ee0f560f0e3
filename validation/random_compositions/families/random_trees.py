"""Random trees: bodies of any shape, joined at random, dropped on the scenery below."""

from math import cos, hypot, pi, sin

from validation.random_compositions.scene_builder import Draft, body_point

ROOM = 0.05
"""The least distance between bodies at the start [m]."""


def tree(draft: Draft) -> None:
    """Build a tree of joints above a floor with walls, inclines or a valley."""
    draft.surfaces()
    if draft.chance(0.15):
        draft.effects["drag"] = {"linear": draft.number(0.01, 0.1)}
    _ground(draft)
    placed: list[tuple[float, float, float]] = []
    size = draft.scaled(0.1, 0.4)
    for i in range(draft.count(2, 7)):
        reach = size * draft.scaled(0.3, 3) / 2
        parent = draft.count(0, i - 1) if i else None
        x, y = _place(draft, placed, reach, parent)
        _body(draft, f"body{i}", (x, y), reach)
        placed.append((x, y, reach))
        if parent is not None:
            _joint(draft, parent, i, placed)
    low = min(y - reach for _, y, reach in placed)
    lift = draft.number(0.1, 0.8) - low + 1.0
    for i in range(len(placed)):
        body = draft.bodies[f"body{i}"]
        body["position"] = [body["position"][0], round(body["position"][1] + lift, 9)]


def _ground(draft: Draft) -> None:
    kind = draft.pick(("floor", "floor", "valley", "incline", "walls"))
    if kind in ("floor", "walls"):
        draft.floor()
    if kind == "walls":
        draft.block("wall_left", (-2.5, 2), (0.5, 4))
        draft.block("wall_right", (2.5, 2), (0.5, 4))
    if kind == "valley":
        points = [[-10, 2], [-3, 0.7], [-1, 0.1], [1, 0.0], [4, 0.8], [10, 2.2]]
        draft.add("valley", {"type": "polyline", "points": points}, (0, 0), type="static")
    if kind == "incline":
        shape = {"type": "box", "width": FAR, "height": 1}
        angle = draft.number(-0.5, 0.5)
        draft.add("incline", shape, (0, -0.5), type="static", angle=angle)


FAR = 30.0
"""The length of an incline [m]."""


def _place(
    draft: Draft, placed: list[tuple[float, float, float]], reach: float, parent: int | None
) -> tuple[float, float]:
    """Return a free position and angle for a body near its parent."""
    if parent is None:
        return 0.0, 0.0
    x, y, wide = placed[parent]
    for attempt in range(100):
        far = wide + reach + ROOM + draft.number(0, 0.3) + 0.05 * attempt
        angle = draft.number(0, 2 * pi)
        place = round(x + far * cos(angle), 6), round(y + far * sin(angle), 6)
        if all(hypot(place[0] - a, place[1] - b) > r + reach + ROOM for a, b, r in placed):
            return place
    return x + 3 * (wide + reach), y


def _body(draft: Draft, name: str, place: tuple[float, float], reach: float) -> None:
    """Add a body of any shape, with a given reach, at a random angle."""
    shape: dict[str, object]
    match draft.pick(("disc", "box", "polygon")):
        case "disc":
            shape = {"type": "disc", "radius": reach}
        case "box":
            slim = draft.number(0.2, 1)
            wide = 2 * reach / hypot(1, slim)
            shape = {"type": "box", "width": wide, "height": slim * wide}
        case _:
            count = draft.count(3, 6)
            turns = [2 * pi * (i + draft.number(-0.3, 0.3)) / count for i in range(count)]
            round_ = 0.6 * reach
            shape = {
                "type": "polygon",
                "vertices": [[round(round_ * cos(a), 6), round(round_ * sin(a), 6)] for a in turns],
            }
    draft.add(
        name, shape, place, mass=draft.mass(), angle=0.0 if "radius" in shape else
        draft.number(-3, 3),
    )  # fmt: skip


def _joint(draft: Draft, parent: int, child: int, placed: list[tuple[float, float, float]]) -> None:
    """Connect a body to its parent by a joint."""
    (x, y, wide), (a, b, reach) = placed[parent], placed[child]
    names = f"body{parent}", f"body{child}"
    kind = draft.pick(("rod", "rod", "rope", "pivot", "pivot", "weld", "spring"))
    if kind == "pivot":
        far = hypot(a - x, b - y)
        share = (wide + (far - wide - reach) / 2) / far
        point = x + share * (a - x), y + share * (b - y)
        ends = [_local(draft, name, point) for name in names]
        draft.join(f"joint{child}", "pivot", *ends)
    elif kind == "spring":
        light = min(draft.bodies[name]["mass"] for name in names)
        draft.join(
            f"joint{child}", "spring", *names, stiffness=draft.scaled(20, 500) * light,
            damping=draft.pick((0.0, draft.number(0, 2) * light)),
        )  # fmt: skip
    else:
        draft.join(f"joint{child}", kind, *names)


def _local(draft: Draft, name: str, point: tuple[float, float]) -> object:
    """Return a point of the plane as a point of a body."""
    body = draft.bodies[name]
    angle = float(body.get("angle", 0.0))
    dx, dy = point[0] - body["position"][0], point[1] - body["position"][1]
    return body_point(name, cos(angle) * dx + sin(angle) * dy, cos(angle) * dy - sin(angle) * dx)
