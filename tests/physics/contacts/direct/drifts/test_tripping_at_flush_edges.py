"""Bodies that slide or roll onto a body that carries on the one on which they move."""

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, fixed, level

LINES = (
    fixed({"type": "segment", "start": [-5, 0], "end": [0, 0]}),
    fixed({"type": "segment", "start": [0, 0], "end": [5, 0]}),
)
TABLES = (
    fixed({"type": "box", "width": 5, "height": 1}, (-2.5, -0.5)),
    fixed({"type": "box", "width": 5, "height": 1}, (2.5, -0.5)),
)
HIGHER = (TABLES[0], fixed({"type": "box", "width": 5, "height": 1}, (2.5, -0.5 + 5e-7)))
GROUNDS = {"lines": LINES, "tables": TABLES, "a little higher": HIGHER}

V = 2.0  # m/s

BAR: Spec = {"type": "segment", "start": [-0.1, 0], "end": [0.1, 0], "thickness": 0.1}

GUESTS = {
    "a box": box((-0.31, 0.05), size=(0.2, 0.1), velocity=[V, 0]),
    "a thick bar": {**box((-0.31, 0.05), size=(0.2, 0.1), velocity=[V, 0]), "shape": BAR},
    "a wheel": disc((-0.31, 0.35), radius=0.35, velocity=[V, 0], angular_velocity=-V / 0.35),
}


def scene(grounds: tuple[Spec, ...], guest: Spec, friction: float, rate: float = 60) -> Level:
    bodies = {**{f"ground{row}": ground for row, ground in enumerate(grounds)}, "guest": guest}
    rough = {name: {**body, "friction": friction**0.5} for name, body in bodies.items()}
    effects = {**GRAVITY, "contact": {"solver": "direct"}, "friction": {}, "rotation": {}}
    return level(rough, effects, stepping={"rate": rate})


@pytest.mark.parametrize("friction", [0.0, 0.3])
@pytest.mark.parametrize("guest", GUESTS)
@pytest.mark.parametrize("ground", GROUNDS)
def test_nothing_trips_over_the_edge_of_what_carries_a_surface_on(
    ground: str, guest: str, friction: float
) -> None:
    """The box turned head over heels, the wheel was thrown up by 1e-8 m."""
    world = build(scene(GROUNDS[ground], GUESTS[guest], friction))
    bound = 1e-6 if ground == "a little higher" else 1e-12

    world.advance(24)

    slows = friction * G if guest != "a wheel" else 0.0
    state, t = world.snapshot, 0.4
    assert state.position[-1, 0] == pytest.approx(-0.31 + V * t - slows * t**2 / 2, abs=bound)
    assert state.velocity[-1] == pytest.approx([V - slows * t, 0], abs=10 * bound)
    if guest != "a wheel":
        assert state.angle[-1] == pytest.approx(0, abs=10 * bound)


@pytest.mark.parametrize("rise", [1e-5, 0.05])
def test_a_box_runs_into_what_is_higher(rise: float) -> None:
    step = fixed({"type": "box", "width": 5, "height": 1}, (2.5, -0.5 + rise))
    world = build(scene((TABLES[0], step), GUESTS["a box"], 0.0))

    world.advance(12)

    assert world.snapshot.position[-1, 0] <= 0.0


def test_a_plank_runs_into_the_foot_of_a_wall() -> None:
    """Its lower end is level with the floor where it meets the wall."""
    wall = fixed({"type": "box", "width": 1, "height": 2}, (0.5, 1.0))
    plank: Spec = {"type": "polygon", "vertices": [[-0.5, 0.5], [0.5, -0.5], [0.5, -0.4]]}
    center = np.mean(plank["vertices"], axis=0)
    vertices = (np.array(plank["vertices"]) - center).tolist()
    low = min(y for _, y in vertices)
    guest = {
        **box((-0.3 - max(x for x, _ in vertices), -low), size=(1, 1), velocity=[V, 0]),
        "shape": {"type": "polygon", "vertices": vertices},
    }
    world = build(scene((TABLES[0], TABLES[1], wall), guest, 0.0))

    world.advance(12)

    assert world.snapshot.velocity[-1, 0] <= 0.6 * V
