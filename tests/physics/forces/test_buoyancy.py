"""What a liquid carries is what is displaced, whatever the outline and however it is turned."""

from math import pi, sqrt

import numpy as np
import pytest

from sandbox.model.errors import LevelError
from sandbox.physics.forces.buoyancy import DiscOutline, PolygonOutline
from sandbox.physics.run import build, simulate
from tests.physics.scenes import GRAVITY, G, box, disc, level

ARROW = [(-1.0, -0.5), (1.0, -0.5), (0.2, 0.0), (1.0, 0.8), (-1.0, 0.5)]
"""Not convex: it may rise above the surface in two places."""


def counted(inside: np.ndarray, x: np.ndarray, y: np.ndarray, cell: float) -> list[float]:
    """Return area, moment and depth by counting small cells."""
    wet = inside & (y < 0)
    return [float(np.sum(part * wet)) * cell for part in (1.0, x, -y)]


@pytest.mark.parametrize("height", [-2.0, -0.3, 0.0, 0.2, 0.6, 2.0])
@pytest.mark.parametrize("angle", [0.0, 0.7, 2.5])
def test_what_an_outline_displaces_is_what_lies_below(height: float, angle: float) -> None:
    """Counted in 1,600² cells of 4 mm², to 1e-3: whole rows of them lie on the surface."""
    outline = PolygonOutline.of(ARROW)
    side = np.linspace(-2, 2, 1601)[1:] - 1 / 800
    x, y = np.meshgrid(side, side)
    own = (x + 1j * y) * np.exp(-1j * angle)
    inside = np.zeros(x.shape, dtype=bool)
    for a, b in zip(outline.corners, np.roll(outline.corners, -1), strict=True):
        crosses = (a.imag > own.imag) != (b.imag > own.imag)
        with np.errstate(divide="ignore", invalid="ignore"):
            where = a.real + (own.imag - a.imag) / (b.imag - a.imag) * (b.real - a.real)
        inside ^= crosses & (own.real < where)

    found = outline.displaced(np.array(height), np.array(angle))

    assert [float(part) for part in found] == pytest.approx(
        counted(inside, x, y + height, (4 / 1600) ** 2), abs=5e-3
    )


@pytest.mark.parametrize("height", [-3.0, -1.0, -0.4, 0.0, 0.9, 1.0, 2.0])
def test_a_disc_displaces_what_a_polygon_of_many_corners_does(height: float) -> None:
    """Of 5,000: smaller by (2 π / 5000)² / 6, 2.6e-7."""
    turns = np.linspace(0, 2 * pi, 5001)[:-1]
    many = PolygonOutline.of(
        [(float(x), float(y)) for x, y in zip(np.cos(turns), np.sin(turns), strict=True)]
    )

    assert DiscOutline(1.0).displaced(np.array(height), np.array(0.0)) == pytest.approx(
        many.displaced(np.array(height), np.array(0.0)), abs=1e-5
    )


@pytest.mark.sweep
def test_a_disc_of_half_the_density_floats_with_its_centre_at_the_surface() -> None:
    """Lightly damped, it comes to rest there: to e^(−20) of the depth it began at."""
    liquid = {"buoyancy": {"density": 1000, "gravity": G, "surface": 1}, "drag": {"linear": 4000}}
    ball = disc((0, 0.8), radius=0.5, mass=500 * pi * 0.25)
    trace = simulate(
        level({"ball": ball}, {**GRAVITY, **liquid}, stepping={"rate": 240}),
        duration=20,
        record=["ball.position.y"],
    )

    assert trace.columns["ball.position.y"][-1] == pytest.approx(1, abs=1e-8)


@pytest.mark.sweep
@pytest.mark.parametrize(("width", "rights"), [(1.3, True), (1.15, False)])
def test_a_block_floats_upright_only_if_it_is_wide_enough(width: float, rights: bool) -> None:
    """The metacentre of a square-cut block, half in: w² / (12 d) above d / 2 from the keel.

    For h = 1 of half the density it stands if w² / 6 > 1 / 4: from 1.2247 m on.
    """
    assert (width > sqrt(1.5)) is rights
    block = box((0, 0), size=(width, 1), mass=500 * width, angle=0.01)
    liquid = {"buoyancy": {"density": 1000, "gravity": G}, "rotation": {}}
    trace = simulate(
        level({"block": block}, {**GRAVITY, **liquid}, stepping={"rate": 480}),
        duration=8,
        record=["block.angle"],
    )

    assert bool(np.abs(trace.columns["block.angle"]).max() < 0.0101) is rights


def test_what_has_no_area_sinks_and_is_not_named() -> None:
    hoop = {"shape": {"type": "hoop", "radius": 1}, "mass": 1}
    liquid = {"density": 1, "gravity": 1}
    scene = level({"hoop": hoop, "ball": disc((5, -9))}, {"buoyancy": liquid})
    assert build(scene).advance(3).velocity[:, 1].tolist()[0] == 0

    with pytest.raises(LevelError, match="'hoop' is a hoop, which displaces no liquid"):
        level({"hoop": hoop}, {"buoyancy": {**liquid, "bodies": ["hoop"]}})
    with pytest.raises(LevelError, match="nothing displaces the liquid: no dynamic disc, box or"):
        level({"hoop": hoop}, {"buoyancy": liquid})


def test_a_liquid_of_no_scene_is_not_loaded() -> None:
    assert not build(level({"ball": disc()}, GRAVITY)).scene.laws
