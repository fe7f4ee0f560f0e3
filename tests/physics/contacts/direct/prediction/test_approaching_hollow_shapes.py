"""Landings in hoops and arcs and on curves, solved directly: each comes at its own time."""

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import pytest

from sandbox.model.expressions import Array
from sandbox.model.level import Level
from sandbox.physics.contacts.detection.time_of_impact import Path
from sandbox.physics.contacts.direct.prediction.approaching_hollow_shapes import HollowPairs
from sandbox.physics.contacts.direct.prediction.convex_parts import Pair
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, G, Spec, box, disc, fixed, level

DIRECT: Spec = {**GRAVITY, "contact": {"solver": "direct"}, "rotation": {}}

TRACKS: dict[str, Spec] = {
    "hoop": {"type": "hoop", "radius": 1},
    "half-pipe": {
        "type": "arc",
        "radius": 1,
        "start": "180*deg",
        "end": "360*deg",
        "thickness": 0.02,
    },
    "hill": {"type": "arc", "radius": 1, "start": 0, "end": "180*deg", "thickness": 0.02},
    "valley": {"type": "curve", "curve": ["s", "0.4*s**2"], "s": [-2, 2], "thickness": 0.02},
    "crest": {"type": "curve", "curve": ["s", "-0.3*s**2"], "s": [-2, 2], "thickness": 0.02},
}

STARTS = {
    "hoop": (0.4, 0.5),
    "half-pipe": (0.4, 0.5),
    "hill": (0.3, 1.7),
    "valley": (0.6, 1.2),
    "crest": (0.3, 0.7),
}

BALL = {name: disc(start, radius=0.1) for name, start in STARTS.items()}

DEEP = 2e-9
"""m: what lands comes 1e-9 m deep."""


def fallen(track: str, body: Spec, rate: float, e: float = 0.0, friction: float = 0.3) -> Level:
    """A body above a track that stands still."""
    bounces: Spec = {"restitution": e**0.5} if e else {}
    effects = {**DIRECT, "friction": {}, **({"restitution": {}} if e else {})}
    bodies = {
        name: {**spec, **bounces, "friction": friction**0.5}
        for name, spec in {"track": fixed(TRACKS[track]), "body": body}.items()
    }
    return level(bodies, effects, stepping={"rate": rate})


class Ended(NamedTuple):
    """Where a body is at the end, (3,) [m, rad], and how deep it has been [m]."""

    place: Array
    deepest: float


def run(scene: Level, seconds: float) -> Ended:
    """Run a level."""
    world, deepest = build(scene), 0.0
    for _ in range(round(seconds / world.dt)):
        world.advance()
        deepest = max(deepest, float(world.contacts.depth.max(initial=0.0)))
    last = world.snapshot
    return Ended(np.array([*last.position[1], last.angle[1]]), deepest)


@pytest.mark.parametrize("track", TRACKS)
def test_what_lands_on_a_bent_surface_and_goes_on_along_it_is_of_second_order(track: str) -> None:
    """Met where the step ended it was up to 53 mm deep, and 0.3 m off."""
    seen = [run(fallen(track, BALL[track], rate), 0.6) for rate in (60, 120, 240, 480)]
    errors = [np.abs(b.place - a.place).max() for a, b in pairwise(seen)]

    assert max(one.deepest for one in seen) <= DEEP
    assert errors[0] <= 2e-3
    assert all(before / after > 3.7 for before, after in pairwise(errors))


@pytest.mark.parametrize("rate", [60, 240])
@pytest.mark.parametrize("track", TRACKS)
def test_what_bounces_off_a_bent_surface_flies_on_as_exactly_as_it_fell(
    track: str, rate: int
) -> None:
    """Up to 18 cm off at 60 Hz: the normal is that of another point, and the time another."""
    seen = run(fallen(track, BALL[track], rate, e=0.6), 0.6)
    exact = run(fallen(track, BALL[track], 960, e=0.6), 0.6)

    assert seen.deepest <= DEEP
    assert seen.place == pytest.approx(exact.place, abs=1e-11)


@pytest.mark.parametrize("track", ["hoop", "half-pipe", "valley"])
def test_a_ball_that_bounces_at_the_lowest_point_is_where_the_formula_says(track: str) -> None:
    low = {"hoop": -0.9, "half-pipe": -0.89, "valley": 0.11}[track]
    ball = disc((0, low + 0.5), radius=0.1)

    seen = run(fallen(track, ball, 60, e=0.5), 0.5)

    drop, time = np.sqrt(2 * 0.5 / G), 0.5 - np.sqrt(2 * 0.5 / G)
    assert seen.place[1] == pytest.approx(low + 0.5 * G * drop * time - G * time**2 / 2, abs=5e-8)


@pytest.mark.parametrize("track", ["hoop", "half-pipe", "valley"])
def test_a_box_lands_with_one_corner_and_then_the_other_to_second_order(track: str) -> None:
    """The other corner came up to 2 cm deep, and the box was off by 1 cm."""
    body = box((0.3, 0.8 if track == "valley" else 0.3), size=(0.3, 0.2), angle=0.4)
    seconds = 0.5 if track == "valley" else 0.6  # before it comes to rest
    seen = [run(fallen(track, body, rate), seconds) for rate in (60, 120, 240)]
    errors = [np.abs(b.place - a.place).max() for a, b in pairwise(seen)]

    assert max(one.deepest for one in seen) <= DEEP
    assert errors[0] <= 1e-4
    assert errors[0] / errors[1] > 3.5


@pytest.mark.parametrize("angle", np.linspace(0, 2 * np.pi, 7)[:-1])
def test_what_is_shot_in_a_hoop_stays_in_it(angle: float) -> None:
    """It moves by five times its size in a step. It used to fly out."""
    bolt = disc((0.2, 0.1), radius=0.05, velocity=[30 * np.cos(angle), 30 * np.sin(angle)])
    seen = run(fallen("hoop", bolt, 60, e=1.0), 1.0)

    assert np.hypot(*seen.place[:2]) <= 0.95 + DEEP


@pytest.mark.parametrize("body", ["hoop", "half-pipe"])
def test_it_does_not_matter_which_of_the_two_moves(body: str) -> None:
    """A hoop or an arc that falls on a ball bounces as the ball does in it, upside down."""
    turned = {"hoop": 0.0, "half-pipe": np.pi}[body]
    effects = {"contact": {"solver": "direct"}, "restitution": {}, "rotation": {}}
    ball = disc((0.3, 0), radius=0.1, restitution=1, mass=2)
    hollow = {"shape": TRACKS[body], "mass": 1, "restitution": 1, "angle": turned}

    def ended(speeds: tuple[float, float]) -> Array:
        bodies = {
            "ball": {**ball, "velocity": [0, speeds[0]]},
            "hollow": {**hollow, "position": [0, 0], "velocity": [0, speeds[1]]},
        }
        if body == "half-pipe":
            bodies["hollow"]["position"] = [0, 2 / np.pi]
        last = build(level(bodies, effects, stepping={"rate": 60})).advance(40)
        return np.asarray(last.position[1] - last.position[0])

    assert ended((3.0, 0.0)) == pytest.approx(ended((0.0, -3.0)), abs=1e-12)


def test_what_passes_the_end_of_an_arc_is_not_stopped() -> None:
    """A ball flies out of the circle of which the arc is a part, where the arc is not."""
    ball = disc((-0.5, -0.2), radius=0.1, velocity=[0.5, 6.0])
    seen = run(fallen("half-pipe", ball, 240, e=0.5), 1.0)

    assert seen.place == pytest.approx([0.0, -0.2 + 6.0 - G / 2, 0.0], abs=1e-12)


def tipped(rate: float) -> Ended:
    """An arch that lands on one foot, and then on the other, and slides on."""
    ground = fixed({"type": "box", "width": 40, "height": 1}, (0, -0.5), friction=0.3)
    arch: Spec = {
        "shape": {"type": "arc", "radius": 0.6, "start": 0, "end": "180*deg", "thickness": 0.04},
        "mass": 1,
        "position": [0, 1.4],
        "velocity": [3, 0],
        "angle": 0.2,
        "friction": 0.3,
    }
    effects = DIRECT | {"friction": {}}
    return run(level({"ground": ground, "arch": arch}, effects, stepping={"rate": rate}), 0.65)


def test_an_arch_lands_on_one_foot_and_then_on_the_other() -> None:
    """It was refused: a corner of the ground, 20 m away, was 19.6 m deep in it."""
    coarse, fine = tipped(60), tipped(240)

    assert max(coarse.deepest, fine.deepest) <= DEEP
    assert coarse.place == pytest.approx(fine.place, abs=1e-11)


def test_what_moves_absurdly_far_in_a_step_is_looked_at_only_so_often(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A plane turns at 1e12 rad/s: the third step looked every few centimetres of 1e19 m."""
    looked: list[float] = []
    look = HollowPairs._times

    def counted(pairs: HollowPairs, path: Path, duration: float, pair: Pair) -> Iterator[float]:
        for time in look(pairs, path, duration, pair):
            looked.append(time)
            assert len(looked) < 20_000
            yield time

    monkeypatch.setattr(HollowPairs, "_times", counted)
    bodies: dict[str, Spec] = {
        "box": box(size=(0.5, 0.8)),
        "small": {"shape": {"type": "hoop", "radius": 0.1}, "mass": 1, "position": [0.7, 0]},
        "wide": box((0, 3), size=(10, 4)),
        "hoop": {"shape": {"type": "hoop", "radius": 0.56}, "mass": 1},
    }
    effects = {
        "contact": {},
        "centrifugal": {"rate": 1e12},
        "force": [{"body": "small", "force": ["t", "t"]}],
    }
    build(level(bodies, effects)).advance(5)

    assert len(looked) > 1000
