"""The contract of every level of the catalog; a new file joins by being there."""

import os
import sys
from collections.abc import Iterator, Mapping
from itertools import chain
from subprocess import PIPE, Popen

import numpy as np
import pytest

from sandbox.model import level_catalog
from sandbox.model.effects import EFFECTS
from sandbox.model.expressions import Array, Values
from sandbox.model.joints import KINDS, Joint, Spring
from sandbox.model.ledger_accounts import damps
from sandbox.model.level import Level
from sandbox.physics.measuring.grading import grade
from sandbox.physics.measuring.recording import needed
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.run import build, simulate
from tests.elsewhere import PATIENCE, ROOT
from tests.levels.playing import Played, fingerprint, play
from tests.levels.sweep import marked, steps, swept
from tests.sample import is_quick
from validation.case import textbook

NAMES = [*level_catalog.textbook(), *level_catalog.challenges()]

HARD = sorted(set(level_catalog.names()) - set(NAMES))
"""The hard cases have no parameters, and `validation stability` runs each to its end."""

FEW = 60
"""Steps of a hard case that are taken here, if it lasts so long."""


def test_every_effect_and_every_joint_is_called_for_by_a_level() -> None:
    levels = [textbook(name) for name in NAMES]
    effects = {name for level in levels for name in level.effects.declared}
    joints = {joint.type for level in levels for joint in level.joints.values()}

    assert not EFFECTS.keys() - effects, "add a level with its checks that declares the effect"
    assert not KINDS.keys() - joints, "add a level with its checks that has a joint of the kind"


@pytest.fixture(
    scope="module",
    params=[
        marked(name, lambda level: steps(level, swept(level)), quick=quick)
        for name, quick in zip(NAMES, is_quick(NAMES, "run"), strict=True)
    ],
)
def name(request: pytest.FixtureRequest) -> str:
    """A level that is run to its end."""
    return str(request.param)


@pytest.fixture(scope="module")
def level(name: str) -> Level:
    return textbook(name)


@pytest.fixture(scope="module", params=NAMES)
def any_level(request: pytest.FixtureRequest) -> Level:
    """A level of which no steps or only a few are taken: the quick tests take all levels."""
    return textbook(str(request.param))


@pytest.fixture(scope="module")
def played(level: Level) -> Played:
    return play(level)


@pytest.fixture(scope="session")
def elsewhere() -> Iterator[Popen[str]]:
    """Another process: given the name of a level, it returns the fingerprint of its run.

    Sets and dictionaries have another order there.
    """
    code = (
        "import faulthandler, sys\n"
        "from validation.case import textbook\n"
        "from tests.levels.playing import LONG, fingerprint, play\n"
        "for name in sys.stdin:\n"
        f"    faulthandler.dump_traceback_later({PATIENCE}, exit=True)\n"
        "    print(fingerprint(play(textbook(name.strip()), LONG).states), flush=True)\n"
        "    faulthandler.cancel_dump_traceback_later()"
    )
    command = [sys.executable, "-c", code]
    environment = {**os.environ, "PYTHONHASHSEED": "1"}
    with Popen(command, stdin=PIPE, stdout=PIPE, text=True, cwd=ROOT, env=environment) as process:
        yield process


def test_there_are_levels() -> None:
    assert len(NAMES) >= 17


def test_says_what_it_is(any_level: Level) -> None:
    assert any_level.summary.endswith(".")
    assert any_level.reference[0].isdigit(), "the reference names a section of the chapter"
    assert any_level.checks, "a level carries its own checks"
    assert all(check.label for check in any_level.checks)
    assert all(parameter.label for parameter in any_level.parameters.values())


def test_stays_finite_and_keeps_its_time(level: Level, played: Played) -> None:
    world, states, _ = played

    assert np.isfinite(states.position).all()
    assert np.isfinite(states.velocity).all()
    assert world.t >= level.duration(level.defaults) * (1 - 1e-12)
    assert world.t == world.steps * world.dt


def test_passes_its_checks(played: Played) -> None:
    for result in grade(played.trace):
        assert result.verdict in ("passed", "not applicable"), result


@pytest.mark.sweep
def test_passes_its_checks_at_the_corners_of_its_parameters(level: Level, played: Played) -> None:
    """The first corner is the defaults."""
    applied: set[int] = set()
    defaults, *others = swept(level)
    assert defaults == played.trace.values
    for trace in (played.trace, *(simulate(level, values) for values in others)):
        for index, result in enumerate(grade(trace)):
            assert result.verdict in ("passed", "not applicable"), (trace.values, result)
            if result.verdict == "passed":
                applied.add(index)

    assert applied == set(range(len(level.checks))), "a check that never applies checks nothing"


def test_ghosts_go_where_the_bodies_go(level: Level, played: Played) -> None:
    world, states, _ = played
    rows = {name: list(level.bodies).index(name) for name in level.ghosts}
    _hold_ghosts(
        level,
        world.values,
        states.t,
        {name: states.position[:, row].T for name, row in rows.items()},
        float(np.hypot(states.velocity[..., 0], states.velocity[..., 1]).max()),
    )


def _hold_ghosts(
    level: Level, values: Values, t: Array, places: Mapping[str, Array], speed: float
) -> None:
    """Exactly, but for impacts, which a run finds up to a step late; places are (2, ...) [m]."""
    late = 2 * speed / level.stepping.rate if level.effects.contact else 1e-3
    for name, formulas in level.ghosts.items():
        for place, formula in zip(places[name], formulas, strict=True):
            assert np.abs(formula.over(values, t) - place).max() <= late + 1e-9, (name, values)


def test_a_landscape_is_the_potential_that_the_body_has(level: Level, played: Played) -> None:
    """To the last digits: the same formula is written in the level and in the law."""
    landscape = level.view.landscape
    if landscape is None:
        return
    world, states, _ = played
    name = f"{landscape.body}.potential_energy"
    measured = Meter(world, [name])(states)[name]
    place = states.position[:, list(level.bodies).index(landscape.body), 0]

    _, curve = landscape.curve(level.defaults)
    expected = landscape.potential.over(level.defaults, place)

    assert np.abs(measured - expected).max() <= 1e-9 * np.ptp(curve)
    assert landscape.x[0](level.defaults) <= place.min()
    assert place.max() <= landscape.x[1](level.defaults)


def test_runs_the_same_however_it_is_stepped(level: Level, played: Played) -> None:
    """One by one and observed, or many at once."""
    count = min(played.world.steps, 120)
    then = build(level).advance(count)

    for field in ("position", "velocity", "angle", "acceleration", "normal", "tension"):
        assert np.array_equal(getattr(played.states, field)[count], getattr(then, field))


@pytest.mark.sweep
def test_runs_the_same_in_another_process(name: str, played: Played, elsewhere: Popen[str]) -> None:
    assert elsewhere.stdin
    assert elsewhere.stdout
    elsewhere.stdin.write(f"{name}\n")
    elsewhere.stdin.flush()

    assert elsewhere.stdout.readline().strip() == fingerprint(played.states)


def test_pays_only_for_what_it_declares(any_level: Level) -> None:
    """No shape without contact, no Python without a law, a string, a sequence, a cut or a bend.

    Springs that neither damp nor let go are pulled by pymunk, where nothing touches.
    """
    world = build(any_level)
    effects = any_level.effects
    laws = any(effect.is_law for effect in effects.declarations)
    pairs = (effects.friction.pairs if effects.friction else ()) or effects.sticking
    sticky = any(body.static_friction for body in any_level.bodies.values())
    sequence = effects.in_sequence

    assert bool(world.scene.space.shapes) == (effects.contact is not None)
    jointed = any(effects.contact or not _is_plain(joint) for joint in any_level.joints.values())
    located = any(e and e.located for e in (effects.contact, effects.friction))
    direct = effects.contact is not None and effects.contact.solver == "direct"
    bends = any(body.shape.type in ("arc", "curve") for body in any_level.bodies.values())
    hooked = jointed or laws or pairs or sticky or sequence or located or direct or bends
    assert bool(world.hooks) == bool(hooked)


def _is_plain(joint: Joint) -> bool:
    return isinstance(joint, Spring) and not (damps(joint) or joint.pushes_only or joint.law)


def test_every_quantity_can_be_measured(any_level: Level) -> None:
    """At the start, where Euler's schemes know no acceleration yet, or after the first step."""
    from sandbox.model.quantities import quantities

    world = build(any_level)
    meter = Meter(world, [found.name for found in quantities(any_level) if not found.needs_ledger])

    start = world.snapshot if any_level.stepping.scheme == "leapfrog" else world.advance()
    for name, value in meter(start).items():
        assert np.ndim(value) == 0, name
        assert np.isfinite(value), name


def test_every_account_can_be_kept(any_level: Level) -> None:
    from sandbox.model.quantities import quantities

    names = [found.name for found in quantities(any_level) if found.needs_ledger]

    trace = simulate(any_level, duration=3 / any_level.stepping.rate, record=names)

    assert list(trace.columns) == names
    assert all(np.isfinite(column).all() for column in trace.columns.values())


@pytest.mark.sweep
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_passes_its_checks_inside_its_ranges(level: Level, seed: int) -> None:
    """At a point that is no corner, with every parameter at another share of its range.

    Its ghosts pass, too.
    """
    draw = np.random.default_rng(seed)
    values = {n: float(draw.uniform(p.min, p.max)) for n, p in level.parameters.items()}
    axes = {name: [f"{name}.position.{axis}" for axis in "xy"] for name in level.ghosts}
    speeds = [f"{name}.speed" for name in level.ghosts]

    trace = simulate(level, values, record=[*needed(level), *chain(*axes.values()), *speeds])

    for result in grade(trace):
        assert result.verdict in ("passed", "not applicable"), result
    places = {name: np.array([trace.columns[axis] for axis in axes[name]]) for name in axes}
    speed = max((float(trace.columns[name].max()) for name in speeds), default=0.0)
    _hold_ghosts(level, trace.values, trace.t, places, speed)


@pytest.fixture(scope="module", params=HARD)
def hard(request: pytest.FixtureRequest) -> Level:
    return textbook(str(request.param))


@pytest.fixture(scope="module")
def begun(hard: Level) -> Played:
    return play(hard, FEW)


def test_a_hard_case_says_what_it_is_and_starts_well(hard: Level, begun: Played) -> None:
    """For some steps, within the bounds of its checks that hold at every step."""
    assert hard.summary.endswith(".")
    assert hard.reference[0].isdigit()
    assert all(check.label for check in hard.checks)
    assert not hard.parameters

    results = [r for r in grade(begun.trace) if r.check.at is None]
    assert all(result.verdict == "passed" for result in results), results


@pytest.mark.sweep
def test_a_hard_case_passes_all_its_checks_at_its_end(hard: Level) -> None:
    for result in grade(simulate(hard)):
        assert result.verdict == "passed", result


def test_a_hard_case_runs_the_same_twice(hard: Level, begun: Played) -> None:
    again = build(hard).advance(begun.world.steps)

    for field in ("position", "velocity", "angle", "tension"):
        assert np.array_equal(getattr(begun.world.snapshot, field), getattr(again, field))
