"""The geometry of shapes."""

import math

import pytest
from pydantic import TypeAdapter

from sandbox.model.shapes import Polygon, Shape, fault

Points = list[tuple[float, float]]

SQUARE: Points = [(0, 0), (2, 0), (2, 2), (0, 2)]
ARROW: Points = [(0, 0), (4, 0), (4, 4), (2, 1)]
BOW: Points = [(0, 0), (1, 1), (1, 0), (0, 1)]
PENTAGRAM: Points = [
    (math.cos(4 * math.pi * i / 5), math.sin(4 * math.pi * i / 5)) for i in range(5)
]
CIRCLE: Points = [
    (math.cos(2 * math.pi * i / 200), math.sin(2 * math.pi * i / 200)) for i in range(200)
]


def polygon(points: Points, scale: float = 1, shift: float = 0) -> Polygon:
    vertices = [[scale * x + shift, scale * y + shift] for x, y in points]
    return Polygon.model_validate({"type": "polygon", "vertices": vertices}, strict=False)


@pytest.mark.parametrize("scale", [1e-6, 1, 1e6])
@pytest.mark.parametrize("shift", [0, 1000])
@pytest.mark.parametrize("points", [SQUARE, SQUARE[::-1], ARROW, CIRCLE, SQUARE[:3]])
def test_a_simple_polygon_is_accepted(points: Points, scale: float, shift: float) -> None:
    assert fault(polygon(points, scale, shift * scale), {}) is None


@pytest.mark.parametrize(
    ("points", "told"),
    [
        (BOW, "crosses itself"),
        (PENTAGRAM, "crosses itself"),
        ([(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)], "crosses itself"),
        ([(0, 0), (4, 0), (2, 0), (2, 2)], "crosses itself"),
        ([(0, 0), (1, 0), (2, 0)], "no area"),
        ([(0, 0), (2, 0), (1, 0)], "no area"),
        ([(0, 0), (1, 0), (1, 0), (0, 1)], "the points 1 and 2 are the same"),
        ([(0, 0), (1, 0), (0, 1), (0, 0)], "the points 3 and 0 are the same"),
    ],
)
def test_a_polygon_without_an_inside_is_refused(points: Points, told: str) -> None:
    assert told in str(fault(polygon(points), {}))


def test_a_polygon_may_cross_itself_for_some_parameters_only() -> None:
    shape = Polygon.model_validate(
        {"type": "polygon", "vertices": [[0, 0], [1, 0], ["x", 1], [0, 1]]}, strict=False
    )

    assert fault(shape, {"x": 1}) is None
    assert fault(shape, {"x": -1}) is not None


@pytest.mark.parametrize(
    ("data", "told"),
    [
        ({"type": "segment", "start": [0, 0], "end": [1, 0]}, None),
        ({"type": "segment", "start": [1, 0], "end": [1, 0]}, "0 and 1 are the same"),
        ({"type": "polyline", "points": [[0, 0], [1, 0], [0, 0]]}, None),
        ({"type": "polyline", "points": [[0, 0], [1, 0], [1, 0]]}, "1 and 2 are the same"),
        ({"type": "disc", "radius": 1}, None),
    ],
)
def test_a_line_needs_a_length(data: dict[str, object], told: str | None) -> None:
    shape: Shape = TypeAdapter[Shape](Shape).validate_python(data, strict=False)

    found = fault(shape, {})

    assert found is None if told is None else told in str(found)
