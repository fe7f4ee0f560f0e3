"""The landscape of a potential, as it is drawn."""

import numpy as np
import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.runs.session import Session
from sandbox.app.stage.potential_curve_with_body import turning_points
from sandbox.app.stage.stage import Stage
from sandbox.model.shapes import XY
from tests.app import scenes

SIZE = (640, 480)
BOTTOM, TOP = -3.0, 0.0
HIGHEST = 4.5  # J, at x = ±3


def oscillator(potential: str = "x**2/2") -> Session:
    """Return a ball of 1 kg on a spring of 1 N/m around x = 0, let go at x = 2: E = 2 J."""
    return Session(
        scenes.level(
            parameters={},
            effects={},
            bodies={
                "ball": {
                    "shape": {"type": "disc", "radius": 0.3},
                    "mass": 1,
                    "position": [2, 2],
                    "color": scenes.BALL,
                }
            },
            joints={
                "coil": {"type": "spring", "ends": [[-5, 2], "ball"], "stiffness": 1, "length": 5}
            },
            stepping={"rate": 240},
            checks=[],
            ghosts={},
            view={
                "center": [0, 0],
                "width": 10,
                "landscape": {
                    "body": "ball",
                    "potential": potential,
                    "x": [-3, 3],
                    "y": [BOTTOM, TOP],
                },
            },
        )
    )


def shown(pen: Pen, session: Session) -> tuple[Stage, pygame.Surface]:
    stage = Stage(pen, SIZE)
    stage.use(session.world)
    stage.fit()
    surface = pygame.Surface(SIZE)
    stage.draw(surface, session.trail)
    return stage, surface


def at(stage: Stage, x: float, energy: float) -> XY:
    """Return the pixel of a place and an energy."""
    return stage.camera.to_screen((x, BOTTOM + (TOP - BOTTOM) * energy / HIGHEST))


def colors(surface: pygame.Surface, pixel: XY, reach: int) -> set[tuple[int, ...]]:
    around = pygame.Rect(0, 0, 2 * reach + 1, 2 * reach + 1)
    around.center = round(pixel[0]), round(pixel[1])
    part = pygame.surfarray.array3d(surface.subsurface(around.clip(surface.get_rect())))
    return {tuple(int(c) for c in color) for color in part.reshape(-1, 3)}


def test_the_curve_runs_through_the_potential(pen: Pen) -> None:
    stage, surface = shown(pen, oscillator())

    for x in (-2.5, -1.0, 1.0, 2.5):
        assert theme.POTENTIAL in colors(surface, at(stage, x, x**2 / 2), 2)
        assert theme.POTENTIAL not in colors(surface, at(stage, x, x**2 / 2 + 0.8), 2)


def test_the_point_rides_where_the_body_is(pen: Pen) -> None:
    session = oscillator()
    for _ in range(190):  # a half and a bit of a quarter of the period, 2 pi s
        session.step()
    x = float(session.world.snapshot.position[0, 0])
    stage, surface = shown(pen, session)

    assert x == pytest.approx(2 * np.cos(190 / 240), abs=1e-3)
    assert theme.TEXT in colors(surface, at(stage, x, x**2 / 2), 1)
    assert theme.TEXT not in colors(surface, at(stage, -x, x**2 / 2), 3)
    assert theme.KINETIC in colors(surface, at(stage, x, (x**2 / 2 + 2) / 2), 2)


def test_the_turning_points_are_marked_on_the_line_of_energy(pen: Pen) -> None:
    session = oscillator()
    for _ in range(300):
        session.step()
    stage, surface = shown(pen, session)

    for x in (-2.0, 2.0):
        assert theme.TOTAL in colors(surface, at(stage, x, 2.0), 5)
    line = (max(map(sum, colors(surface, at(stage, x, 2.0), 8))) for x in (-1.0, 0.5))
    off = max(map(sum, colors(surface, at(stage, 0.5, 3.2), 8)))
    assert min(line) > 2 * off


def test_a_wrong_potential_leaves_the_point_off_its_curve(pen: Pen) -> None:
    """The point is measured, not put on the curve."""
    session = oscillator("x**2/2 + 1.5*(1 - (x/3)**2)")
    stage, surface = shown(pen, session)
    low, high = 1.5, HIGHEST
    curve = stage.camera.to_screen(
        (2, BOTTOM + (TOP - BOTTOM) * (2 + 1.5 * 5 / 9 - low) / (high - low))
    )

    assert theme.POTENTIAL in colors(surface, curve, 2)
    assert theme.TEXT not in colors(surface, curve, 3)


def test_turning_points_lie_between_the_places_that_are_looked_at() -> None:
    x = np.linspace(-3, 3, 241)

    assert turning_points(x, x**2 / 2, 2.0) == pytest.approx([-2, 2], abs=1e-3)
    assert turning_points(x, x**2 / 2, 9.0) == []
    assert turning_points(x, x**4 - 2 * x**2, -0.5) == pytest.approx(
        [-1.30656, -0.5412, 0.5412, 1.30656], abs=1e-3
    )


def test_a_flat_landscape_is_no_trouble(pen: Pen) -> None:
    stage, surface = shown(pen, oscillator("0"))

    assert theme.POTENTIAL in colors(surface, stage.camera.to_screen((0, BOTTOM)), 3)
