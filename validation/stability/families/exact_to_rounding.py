"""Scenes that should be exact: falls, pulleys, rolling, a pair on a pivot, and repetition."""

from collections.abc import Iterator
from hashlib import sha256

import numpy as np

from sandbox.model.level import Level
from sandbox.model.level_catalog import find
from sandbox.model.loading import load
from sandbox.parallel_processes import spread
from sandbox.physics.run import build
from validation.stability.hard_case import HardCase, watch
from validation.stability.run_measures import Run, measured, naive_of

BALLS = 25
PUSH = 150.0  # N


def fall(run: Run) -> float:
    """Return the error of a fall from Galileo's law, relative to its height."""
    p, t = run.level.defaults, run.states.t
    expected = p["height"] - p["g"] * t**2 / 2
    return float(np.abs(measured(run, "ball.position.y") - expected).max() / p["height"])


def late(scene: Level, duration: float) -> float:
    """Return the relative error of naive pymunk's fall from a fall that is late by half a step."""
    run = watch(scene, naive_of(scene), duration, every_step=True)
    p, t = scene.defaults, run.states.t
    error = measured(run, "ball.position.y") - (p["height"] - p["g"] * t**2 / 2)
    expected = p["g"] * t * run.world.dt / 2  # too high: a step drifts before it falls
    return float(np.abs(error - expected).max() / expected.max())


def atwood(run: Run) -> float:
    """Return the error of an Atwood machine from its closed form, relative to its distance."""
    p, t = run.level.defaults, run.states.t
    y = measured(run, "left.position.y")
    distance = (p["m2"] - p["m1"]) * p["g"] / (p["m1"] + p["m2"]) * t**2 / 2
    return float(np.abs(y - y[0] - distance).max() / np.abs(distance).max())


def rolls(run: Run) -> float:
    """Return the relative error of a sliding disc's final speed, 2/3 of the initial one."""
    speed = measured(run, "disc.velocity.x")
    return float(abs(speed[-1] / (2 / 3 * speed[0]) - 1))


def rollers(run: Run) -> float:
    """Return the error of the box's velocity from a t, relative to its final one.

    The rollers move at half the box's speed, and turn: M v²/2 + n (3/2) m (v/2)²/2 = F x, and so
    a = F / (M + 3 n m / 8).
    """
    expected = PUSH * run.states.t / (10 + 3 / 8 * BALLS)
    return float(np.abs(measured(run, "box.velocity.x") - expected).max() / expected[-1])


def linear(run: Run) -> float:
    """Return the relative change of momentum after the start."""
    p = np.stack([measured(run, f"system.momentum.{axis}") for axis in "xy"], axis=1)[1:]
    return float(np.abs(p - p[0]).max() / np.abs(p).max())


def angular(run: Run) -> float:
    """Return the relative change of angular momentum after the start."""
    turning = measured(run, "system.angular_momentum")[1:]
    return float(np.abs(turning - turning[0]).max() / np.abs(turning).max())


def fingerprint(scene: Level, steps: int = 600) -> str:
    """Return a hash of all positions, angles and velocities after some steps."""
    world = build(scene)
    state = world.advance(steps)
    parts = state.position, state.angle, state.velocity, state.angular_velocity
    return sha256(b"".join(part.tobytes() for part in parts)).hexdigest()


def differing(scene: Level, _duration: float) -> float:
    """Return how many of three runs here and one in a new process differ from the first run."""
    here = [fingerprint(scene) for _ in range(3)]
    ((_, there),) = spread(_fingerprint_elsewhere, ["hard/144-boxes"], 1)
    return float(sum(other != here[0] for other in (*here[1:], there)))


def _fingerprint_elsewhere(name: str) -> str:
    return fingerprint(load(find(name)))


def cases() -> Iterator[HardCase]:
    """Yield the cases that should be exact."""
    yield HardCase(
        name="free fall, 2 s at 60 Hz", group="A", level="kinematics/free-fall",
        criterion="h - g t²/2, to rounding", figure=fall, bound=1e-12, duration=2,
        every_step=True,
    )  # fmt: skip
    yield HardCase(
        name="the same naively: late by half a step", group="A",
        level="kinematics/free-fall", duration=2,
        criterion="the error is g t dt / 2 and nothing else: proof that the check can fail",
        special=late, bound=1e-9,
    )  # fmt: skip
    for level_name, ratio in (("atwood", 1.5), ("atwood-thousand-to-one", 1e6)):
        yield HardCase(
            name=f"Atwood 1 : {ratio:,.10g}", group="A",
            level=f"newton/{level_name}",
            criterion="(m2 - m1) g / (m1 + m2), whatever the masses", figure=atwood, bound=1e-9,
            parameters={} if ratio == 1.5 else {"m1": 1, "m2": ratio}, every_step=True,
        )  # fmt: skip
    yield HardCase(
        name="from sliding to rolling", group="A", level="rotation/slide-to-roll",
        criterion="a disc ends at 2/3 of its speed: its angular momentum about the floor is kept",
        figure=rolls, bound=1e-9,
    )  # fmt: skip
    yield HardCase(
        name="SimBenchmark: rolling", group="A", level="hard/rollers",
        criterion="a = F / (M + 3 n m / 8), as long as all rollers are pressed: for 0.9 s",
        figure=rollers, bound=1e-12, duration=0.8, every_step=True,
    )  # fmt: skip
    yield HardCase(
        name="two boxes on a pivot: momentum", group="A", level="hard/free-pair",
        criterion="nothing outside acts", figure=linear, bound=1e-12, duration=20, quick=5,
    )  # fmt: skip
    yield HardCase(
        name="two boxes on a pivot: angular momentum", group="A",
        level="hard/free-pair", criterion="nothing outside acts", figure=angular, bound=1e-5,
        duration=20, quick=5,
    )  # fmt: skip
    yield HardCase(
        name="144 boxes, 600 steps, four runs", group="A", level="hard/144-boxes",
        criterion="not one bit differs, in this process or another", special=differing, bound=0,
    )  # fmt: skip
