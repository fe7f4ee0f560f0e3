"""What may have passed through others between two steps is told."""

import pymunk
import pytest

from sandbox.model.level import Level
from sandbox.physics.geometry import outline_distance
from sandbox.physics.guarding import least_step_rate
from sandbox.physics.measuring.recording import Recorder
from sandbox.physics.run import build, simulate
from tests.physics.scenes import Spec, box, disc, fixed, level


def shot(rate: float, **contact: object) -> Level:
    """A bullet of 4 cm flies at 100 m/s through a wall of 10 cm."""
    bodies: dict[str, Spec] = {
        "wall": fixed({"type": "box", "width": 0.1, "height": 4}, (0, 0)),
        "bullet": disc((-3, 0), radius=0.02, mass=0.01, velocity=[100, 0]),
        "bystander": box((-3, 3), size=(1, 1), velocity=[1, 0]),
    }
    return level(bodies, {"contact": contact}, stepping={"rate": rate}, duration=0.1)


def test_a_bullet_that_steps_over_a_wall_is_named_with_the_rate_it_needs() -> None:
    (need,) = simulate(shot(240, solver="iterative")).missed_passages

    assert need.subject == "the body 'bullet'"
    assert need.rate == pytest.approx(100 / 0.04)


@pytest.mark.parametrize(
    "scene",
    [shot(20_000, solver="iterative"), shot(240, located=["bullet"]), shot(240)],
    ids=["fine", "located", "direct by default"],
)
def test_where_no_impact_is_missed_nobody_is_named(scene: Level) -> None:
    assert simulate(scene).missed_passages == ()


def test_without_contact_there_is_nothing_to_miss() -> None:
    thrown = {"ball": disc((0, 0), radius=0.02, velocity=[100, 0])}

    assert simulate(level(thrown, {}, duration=0.1)).missed_passages == ()


def test_how_wide_bodies_are_is_measured_once_in_a_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """A pyramid's took 40 ms each time that the window graded its run."""
    measured: list[object] = []
    width = outline_distance.width

    def counted(shape: pymunk.Shape) -> float:
        measured.append(shape)
        return width(shape)

    monkeypatch.setattr(least_step_rate, "width", counted)
    world = build(shot(240, solver="iterative"))
    measured.clear()  # the start has its own limits
    recorder = Recorder(world, [])
    for _ in range(10):
        world.step()
        recorder.note()
        assert len(recorder.trace.missed_passages) == 1
    assert len(measured) == 3  # one for each body
