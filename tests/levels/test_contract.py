"""What holds for every level that comes with the project: a new file joins by being there."""

import subprocess
import sys
from collections.abc import Iterator
from hashlib import sha256
from itertools import islice
from math import inf
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from sandbox.model import catalog
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.loading import load, parse
from sandbox.model.rules import corners
from sandbox.physics.checks import grade
from sandbox.physics.measure import Meter
from sandbox.physics.snapshot import Snapshot
from sandbox.physics.trace import count_steps, simulate
from sandbox.physics.world import World, build

NAMES = catalog.textbook()

HARD = sorted(set(catalog.names()) - set(NAMES))
"""The hard cases have no parameters, and `validation stability` runs each to its end."""

FEW = 60
"""Steps of a hard case that are taken here."""


LONG = 500
"""Steps after which a run that is not the same in another process has shown it."""


class Played(NamedTuple):
    """A level that ran to its end, and its states at every step."""

    world: World
    states: Snapshot


@pytest.fixture(
    scope="module", params=[pytest.param(n, marks=pytest.mark.xdist_group(n)) for n in NAMES]
)
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def level(name: str) -> Level:
    return load(catalog.find(name))


@pytest.fixture(scope="module")
def played(level: Level) -> Played:
    world = build(level)
    return Played(world, Snapshot.stack(list(run(world))))


def run(world: World, most: float = inf) -> Iterator[Snapshot]:
    """Yield the state at every step of a level's duration, or of so many."""
    yield world.snapshot
    for _ in range(int(min(count_steps(world), most))):
        yield world.advance()


def fingerprint(name: str) -> str:
    """Return a hash of everything that moved in a run."""
    states = Snapshot.stack(list(run(build(load(catalog.find(name))), LONG)))
    parts = (states.position, states.velocity, states.angle, states.tension)
    return sha256(b"".join(part.tobytes() for part in parts)).hexdigest()


def test_there_are_levels() -> None:
    assert len(NAMES) >= 17


def test_says_what_it_is(level: Level) -> None:
    assert level.summary.endswith(".")
    assert level.reference[0].isdigit(), "the reference names a section of the chapter"
    assert level.checks, "a level carries its own checks"
    assert all(check.label for check in level.checks)
    assert all(parameter.label for parameter in level.parameters.values())


def test_survives_a_round_trip_through_json(level: Level) -> None:
    assert parse(level.model_dump_json(by_alias=True)) == level


def test_stays_finite_and_keeps_its_time(level: Level, played: Played) -> None:
    world, states = played

    assert np.isfinite(states.position).all()
    assert np.isfinite(states.velocity).all()
    assert world.t >= level.duration(level.defaults) * (1 - 1e-12)
    assert world.t == world.steps * world.dt


def test_passes_its_checks_at_the_corners_of_its_parameters(level: Level) -> None:
    """The first corner is the defaults."""
    applied: set[int] = set()
    for values in islice(corners(level), 100):
        for index, result in enumerate(grade(simulate(level, values))):
            assert result.verdict in ("passed", "not applicable"), (values, result)
            if result.verdict == "passed":
                applied.add(index)

    assert applied == set(range(len(level.checks))), "a check that never applies checks nothing"


def test_ghosts_go_where_the_bodies_go(level: Level, played: Played) -> None:
    """Exactly, but for impacts, which a run finds up to a step late."""
    world, states = played
    speed = np.hypot(states.velocity[..., 0], states.velocity[..., 1]).max()
    late = 2 * speed * world.dt if level.effects.contact else 1e-3
    for name, formulas in level.ghosts.items():
        body = list(level.bodies).index(name)
        for axis, formula in enumerate(formulas):
            ghost = formula.over(level.defaults, states.t)
            assert np.abs(ghost - states.position[:, body, axis]).max() <= late + 1e-9


def test_a_landscape_is_the_potential_that_the_body_has(level: Level, played: Played) -> None:
    """To the last digits: the same formula, once written by the level and once by the law."""
    landscape = level.view.landscape
    if landscape is None:
        return
    world, states = played
    name = f"{landscape.body}.potential_energy"
    measured = Meter(world, [name])(states)[name]
    place = states.position[:, list(level.bodies).index(landscape.body), 0]

    _, curve = landscape.curve(level.defaults)
    expected = landscape.potential.over(level.defaults, place)

    assert np.abs(measured - expected).max() <= 1e-9 * np.ptp(curve)
    assert landscape.x[0](level.defaults) <= place.min()
    assert place.max() <= landscape.x[1](level.defaults)


def test_runs_the_same_however_it_is_stepped(level: Level) -> None:
    one, many = build(level), build(level)
    steps = min(count_steps(one), 120)
    for _ in range(steps):
        one.advance()
    many.advance(steps)

    for field in ("position", "velocity", "angle", "acceleration", "normal", "tension"):
        assert np.array_equal(getattr(one.snapshot, field), getattr(many.snapshot, field))


def test_all_run_the_same_in_another_process() -> None:
    code = (
        "from sandbox.model import catalog\n"
        "from tests.levels.test_contract import fingerprint\n"
        "for name in catalog.textbook(): print(name, fingerprint(name))"
    )
    here = [f"{name} {fingerprint(name)}" for name in NAMES]

    there = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=True,
        cwd=Path(__file__).parents[2],
    )

    assert there.stdout.splitlines() == here


def test_pays_only_for_what_it_declares(level: Level) -> None:
    """No shape without contact, no callback without a force law, a string or a sequence."""
    world = build(level)
    effects = level.effects
    forces = ("attraction", "gravitation", "centrifugal", "drag", "force", "thrust", "accretion")
    laws = set(effects.declared).intersection(forces)
    pairs = (effects.friction.pairs if effects.friction else ()) or effects.sticking
    sticky = any(body.static_friction for body in level.bodies.values())
    sequence = effects.in_sequence

    assert bool(world.scene.space.shapes) == (effects.contact is not None)
    early = level.stepping.scheme == "explicit-euler"  # its forces act before the step
    hooked = level.joints or (laws and not early) or pairs or sticky or sequence
    assert bool(world.hooks) == bool(hooked)


def test_every_quantity_can_be_measured(level: Level) -> None:
    """At the start, where Euler's schemes know no acceleration yet, or after the first step."""
    from sandbox.model.quantities import quantities

    world = build(level)
    meter = Meter(world, [found.name for found in quantities(level) if not found.booked])

    start = world.snapshot if level.stepping.scheme == "leapfrog" else world.advance()
    for name, value in meter(start).items():
        assert np.ndim(value) == 0, name
        assert np.isfinite(value), name


def test_every_account_can_be_kept(level: Level) -> None:
    from sandbox.model.quantities import quantities

    names = [found.name for found in quantities(level) if found.booked]

    trace = simulate(level, duration=3 / level.stepping.rate, record=names)

    assert list(trace.columns) == names
    assert all(np.isfinite(column).all() for column in trace.columns.values())


def values_between(level: Level, share: float) -> Values:
    """Return parameters at a share of the way through each range."""
    return {n: p.min + share * (p.max - p.min) for n, p in level.parameters.items()}


@pytest.mark.parametrize("share", [0.2, 0.5, 0.8])
def test_passes_its_checks_inside_its_ranges(level: Level, share: float) -> None:
    for result in grade(simulate(level, values_between(level, share))):
        assert result.verdict in ("passed", "not applicable"), result


@pytest.mark.parametrize("name", HARD)
def test_a_hard_case_says_what_it_is_and_starts_well(name: str) -> None:
    """For some steps, within the bounds of those of its checks that hold at every step."""
    level = load(catalog.find(name))
    assert level.summary.endswith(".")
    assert level.reference[0].isdigit()
    assert all(check.label for check in level.checks)
    assert not level.parameters
    assert parse(level.model_dump_json(by_alias=True)) == level

    trace = simulate(level, duration=FEW / level.stepping.rate)

    results = [r for r in grade(trace) if r.check.at is None]
    assert all(result.verdict == "passed" for result in results), results


@pytest.mark.parametrize("name", HARD)
def test_a_hard_case_runs_the_same_twice(name: str) -> None:
    level = load(catalog.find(name))
    one, other = (build(level).advance(FEW) for _ in range(2))

    for field in ("position", "velocity", "angle", "tension"):
        assert np.array_equal(getattr(one, field), getattr(other, field))
