"""Strings over pegs: exact on a line, and of their length wherever they swing."""

import json
from collections.abc import Iterator
from math import hypot

import numpy as np
import pytest

from sandbox.model import contact_solver_choice
from sandbox.model.joints import Joint, bodies_of
from sandbox.model.level import Level
from sandbox.model.loading import parse
from sandbox.physics.joints import pulley as pulley_string
from sandbox.physics.quantities.meter import Meter
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import SimulationError
from tests.physics.scenes import (
    GRAVITY,
    G,
    atwood,
    box,
    disc,
    fixed,
    level,
    measured,
    path_length,
    pulley,
    run,
    table,
    worst,
)

RATIOS = [1, 1.5, 10, 1e3, 1e6]
HOOK = {"type": "disc", "radius": 0.05}


@pytest.mark.parametrize("ratio", RATIOS)
def test_an_atwood_machine_is_exact_at_any_ratio_of_masses(ratio: float) -> None:
    """a = g (m2 - m1) / (m1 + m2), T = 2 g m1 m2 / (m1 + m2), until an end is at its peg.

    The tension and the accelerations are known to the rounding of the velocities, eps v / dt; from
    the lengths, twice differenced, they would be to eps L / dt² = 5e-12 m/s² for 6 m at 60 Hz.
    """
    moves = ("left.position.y", "left.velocity.y", "left.acceleration.y", "right.position.y")
    found = measured(build(atwood(1, ratio)), 42, *moves, "string.tension", "t")
    t, acceleration = found["t"], G * (ratio - 1) / (ratio + 1)
    rise = acceleration * t**2 / 2

    assert worst(found["left.position.y"], rise) <= 1e-12  # 4e-15
    assert worst(-found["right.position.y"], rise) <= 1e-12  # 4e-15
    assert worst(found["left.velocity.y"], acceleration * t) <= 1e-12  # 3e-15
    assert worst(found["string.tension"], 2 * G * ratio / (1 + ratio)) <= 1e-13  # 1e-14
    if ratio > 1:
        assert worst(found["left.acceleration.y"], acceleration) <= 2e-13  # 2e-14


def test_a_steady_pull_is_found_at_the_first_look(monkeypatch: pytest.MonkeyPatch) -> None:
    """Newton's method starts from the last pull; from none it would take two more looks."""
    world = build(atwood(1, 1.5))
    world.advance(2)
    monkeypatch.setattr(pulley_string, "MAX_ITERATIONS", 1)
    world.advance(30)
    world.scene.bodies["left"].position -= (0, 1e-3)  # and what is not steady is not

    with pytest.raises(SimulationError, match="no tension keeps 'string' at its length"):
        world.advance()


@pytest.mark.parametrize(("off", "jerk"), [(1e-15, 1 / 64), (1e-12, 1), (1e-3, 1)])
def test_a_length_that_is_off_is_taken_back_at_once_unless_it_is_rounding(
    off: float, jerk: float
) -> None:
    """The kick's acceleration along the string is off / dt², but a 64th of that for rounding."""
    world = build(atwood(1, 1.5))
    world.advance(5)
    world.scene.bodies["left"].position -= (0, off)
    more = world.advance().tension[0] - 2 * G * 1.5 / 2.5
    length = path_length(world.advance(), [(-0.5, 3), (0.5, 3)])

    assert more == pytest.approx(jerk * off * 60**2 / (1 + 1 / 1.5), rel=1e-2, abs=1e-13)
    assert abs(length - 7) <= 3e-15  # 1e-15


def test_an_atwood_machine_started_naively_is_late_by_half_a_step() -> None:
    stepping = {"rate": 60, "scheme": "symplectic-euler"}
    world = build(atwood(1, 1.5, stepping=stepping))
    rise = world.advance(60).position[0, 1]

    assert abs(rise / (G * 0.2 / 2) - 1) > 1e-3  # 1.7e-2: the check can fail


def test_equal_masses_stay_where_they_are() -> None:
    end = build(atwood(2, 2)).advance(6000)

    assert worst(end.position, np.array([[-0.5, 0], [0.5, 0]])) <= 1e-12  # 0


@pytest.mark.parametrize("friction", [None, 0.3])
def test_a_weight_pulls_a_block_over_a_table(friction: float | None) -> None:
    """a = g (m2 - mu m1) / (m1 + m2), T = m1 m2 g (1 + mu) / (m1 + m2); here m1 = 1, m2 = 0.5."""
    mu = friction or 0.0
    found = measured(build(table(friction)), 60, "block.position.x", "string.tension", "t")
    acceleration = G * (0.5 - mu) / 1.5

    assert (
        worst(found["block.position.x"] + 5, acceleration * found["t"] ** 2 / 2) <= 1e-10
    )  # 8e-15
    assert worst(found["string.tension"], 0.5 * G * (1 + mu) / 1.5) <= 1e-10  # 1e-13


@pytest.mark.sweep
def test_a_block_that_friction_holds_does_not_creep_towards_the_edge() -> None:
    """mu m1 > m2: held. A residue of 1e-11 m/s² in the start would be 5e-10 m after 10 s."""
    world = build(table(0.6))
    end = world.advance(600)

    assert abs(end.position[0, 0] + 5) <= 1e-9  # 1e-14
    assert end.tension[0] == pytest.approx(0.5 * G, rel=1e-10)
    assert end.friction[0] == pytest.approx(0.5 * G, rel=1e-10)


PEGS = [(0, 3), (2, 3)]


@pytest.mark.parametrize("rate", [60, 240])
def test_a_swinging_atwood_machine_keeps_the_length_of_its_string(rate: int) -> None:
    """The length is solved at position level: nothing but rounding may add up, and it does not."""
    scene = level(
        {"light": disc((-1, 1)), "heavy": disc((2, 1), mass=1.5)},
        GRAVITY,
        joints={"string": pulley(["light", "heavy"], PEGS)},
        stepping={"rate": rate},
    )
    swing = run(build(scene), 20 * rate)

    assert np.ptp(swing.position[:, 0, 0]) > 1  # it does swing
    assert worst(path_length(swing, PEGS), hypot(1, 2) + 2 + 2) <= 1e-12  # 3e-16
    assert (swing.tension > 0).all()


@pytest.mark.parametrize("hook", [(-1.0, 3.0), (0.0, 3.0)], ids=["beside the peg", "at the peg"])
def test_a_string_tied_to_a_wall_is_a_pendulum(hook: tuple[float, float]) -> None:
    """It keeps its length; its energy swings with an error of (omega dt)² and does not drift."""
    scene = level(
        {"hook": fixed(HOOK, hook), "bob": disc((1, 2))},
        GRAVITY,
        joints={"string": pulley(["hook", "bob"], [(0, 3)])},
    )
    world = build(scene)
    swing = run(world, 1200)
    energy = Meter(world, ["bob.energy"])(swing)["bob.energy"] - 2 * G

    assert worst(path_length(swing, [(0, 3)]), hypot(1, 1) - hook[0]) <= 1e-12  # 3e-16
    assert np.abs(energy).max() < 1e-3 * G * hypot(1, 1)  # 2e-4
    assert np.abs(energy[600:]).max() == pytest.approx(np.abs(energy[:600]).max(), rel=0.05)


def test_a_kinematic_hand_reels_a_load_in() -> None:
    """What moves by itself pulls as hard as it takes: at constant speed, T = m g."""
    scene = level(
        {
            "winch": {"type": "kinematic", "shape": HOOK, "velocity": [0, -0.5]},
            "load": disc((1, 0)),
        },
        GRAVITY,
        joints={"string": pulley(["winch", "load"], [(0, 3), (1, 3)])},
    )
    haul = run(build(scene), 60)

    assert worst(haul.position[:, 1, 1], 0.5 * haul.t) <= 1e-12  # 4e-16
    assert worst(haul.tension[1:, 0], G) <= 1e-11  # at rest it had to be jerked into motion


def test_a_string_goes_slack_and_tightens_again_and_never_pushes() -> None:
    """The left mass is thrown up at 2 m/s. Gravity takes as much from both arms, so the slack

    of 0.2 m + 2 m/s t − g t² grows, shrinks, and ends; then both move on with the mean of 1 m/s.
    """
    scene = level(
        {"left": disc((0, -3), velocity=[0, 2]), "right": disc((1, 0))},
        GRAVITY,
        joints={"string": pulley(["left", "right"], [(0, 3), (1, 3)], length=10.2)},
    )
    flight = run(build(scene), 90)
    length, slack = path_length(flight, [(0, 3), (1, 3)]), flight.tension[:, 0] == 0
    falls = flight.t**2 * G / 2

    assert (flight.tension >= 0).all()
    assert slack[0]
    assert not slack.all()
    assert (length <= 10.2 * (1 + 1e-14)).all()
    first = int(np.argmin(slack))  # one kick takes the end to the length, the next on along it
    assert worst(flight.position[:first, 1, 1], -falls[:first]) <= 1e-12  # free until then
    assert worst(flight.velocity[first + 2 :, :, 1], np.array([1.0, -1.0])) <= 1e-12  # 3e-15
    assert worst(flight.tension[first + 2 :], G) <= 1e-11  # 5e-13


def test_a_slack_end_may_fly_past_its_peg() -> None:
    scene = level(
        {"thrown": disc((0.01, 2.5), velocity=[0, 9]), "held": fixed(HOOK, (1, 0))},
        {},
        joints={"string": pulley(["thrown", "held"], [(0, 3), (1, 3)], length=20)},
    )
    end = build(scene).advance(60)

    assert end.position[0] == pytest.approx([0.01, 11.5])


def test_an_end_that_runs_into_its_peg_stops_the_run() -> None:
    """The light end is 3 m below its peg and rises with g/2: it arrives after √(12/g) = 1.1 s."""
    world = build(atwood(1, 3))
    with pytest.raises(SimulationError, match="'string' has run into a peg") as caught:
        run(world, 200)

    assert caught.value.subject == "string"
    assert caught.value.time == pytest.approx((12 / G) ** 0.5, abs=2 / 60)
    assert world.snapshot.t == pytest.approx(caught.value.time - 1 / 60)
    with pytest.raises(SimulationError):  # a world that has ended stays so
        world.step()


@pytest.mark.parametrize("rate", [60, 960])
def test_a_string_solved_with_contacts_runs_into_its_peg(rate: int) -> None:
    """The drift before it is divided first, which is no reason to name another cause."""
    scene = level(
        {"left": box((-0.5, 0), mass=1), "right": box((0.5, 0), mass=3)},
        {**GRAVITY, "contact": {}},
        joints={"string": pulley(["left", "right"], [(-0.5, 3), (0.5, 3)])},
        stepping={"rate": rate},
    )
    world = build(scene)
    with pytest.raises(SimulationError, match="'string' has run into a peg") as caught:
        run(world, 2 * rate)

    assert caught.value.time == pytest.approx((12 / G) ** 0.5, abs=2 / rate)


@pytest.mark.parametrize("rate", [60, 1000])
def test_a_movable_wheel_that_runs_into_its_peg_stops_the_run(rate: int) -> None:
    """No rate is short enough for a wheel of 1 kg that a load of 4 kg pulls up to its peg.

    It rises with g (2 · 4 − 1)/(4 · 4 + 1), and has 3 m to go.
    """
    world = build(
        level(
            {"wheel": disc((0, -3)), "load": disc((2, -5), mass=4)},
            GRAVITY,
            joints={
                "string": {
                    "type": "pulley",
                    "ends": [[0, 0], "load"],
                    "over": ["wheel", [0, 0], [2, 0]],
                }
            },
            stepping={"rate": rate},
        )
    )
    with pytest.raises(SimulationError, match="'string' has run into a peg") as caught:
        run(world, 2 * rate)

    assert caught.value.time == pytest.approx((6 / (G * 7 / 17)) ** 0.5, abs=2 / rate)


def test_momentum_along_a_string_is_passed_on_without_loss() -> None:
    """Two pucks without gravity, one pulled along: m1 v1 - m2 v2 changes by no pull along it."""
    scene = level(
        {"fast": disc((0, -1), velocity=[0, -1]), "slow": disc((2, -1), mass=3)},
        {},
        joints={"string": pulley(["fast", "slow"], PEGS)},
    )
    flight = run(build(scene), 60)
    left, right = flight.velocity[1:, :, 1].T

    assert worst(left, -0.25) <= 1e-12  # the jerk is over within the first step
    assert worst(right, 0.25) <= 1e-12


def between(left: float, load: float, right: float, apart: float = 0.0) -> Level:
    """A load on two strings that run up to pegs, over others, and down to a weight on each side."""
    return level(
        {
            "load": disc(mass=load),
            "left": disc((-4, 0), mass=left),
            "right": disc((4, 0), mass=right),
        },
        GRAVITY,
        joints={
            "one": pulley(["left", "load"], [(-4, 3), (-apart, 3)]),
            "two": pulley(["right", "load"], [(4, 3), (apart, 3)]),
        },
    )


@pytest.mark.parametrize("masses", [(1, 1, 1), (1, 1e-4, 3), (2, 1e3, 1), (1e-3, 1, 1e-3)])
def test_two_strings_on_one_body_share_its_load(masses: tuple[float, float, float]) -> None:
    """Straight up: a = g (m1 + m2 − M) / (m1 + m2 + M) and T_i = m_i (g − a).

    The tension is known from where the ends are, to eps L / dt² in their acceleration.
    """
    left, load, right = masses
    flight = run(build(between(*masses)), 30)
    acceleration = G * (left + right - load) / (left + right + load)

    assert worst(flight.position[:, 0, 1], acceleration * flight.t**2 / 2) <= 1e-12  # 1e-15
    tension = np.array([left, right]) * (G - acceleration)
    assert np.abs(flight.tension - tension).max() <= 1e-11 * max(left, right)  # 3e-12


def test_two_slanting_strings_keep_their_lengths_and_their_symmetry() -> None:
    flight = run(build(between(1, 1.2, 1, apart=1)), 90)
    one = path_length(flight, [(-4, 3), (-1, 3)], (1, 0))
    two = path_length(flight, [(4, 3), (1, 3)], (2, 0))

    assert np.ptp(flight.position[:, 0, 1]) > 0.3
    assert worst(flight.position[:, 0, 0], 0.0) <= 1e-12  # 1e-16
    assert worst(one, one[0]) <= 1e-12  # 4e-16
    assert worst(two, one[0]) <= 1e-12
    assert worst(flight.tension[:, 0], flight.tension[:, 1]) <= 1e-12


def test_one_of_two_strings_on_a_body_may_be_slack() -> None:
    scene = between(1, 1, 1)
    said = scene.model_dump(mode="json", by_alias=True)
    said["joints"]["two"]["length"] = 11
    flight = run(build(parse(json.dumps(said))), 20)

    assert (flight.tension[:, 1] == 0).all()
    assert worst(flight.tension[:, 0], G) <= 1e-10
    assert worst(flight.position[:, 2, 1], -G * flight.t**2 / 2) <= 1e-12


def test_a_chain_of_strings_pulls_through() -> None:
    """A weight over a peg lifts a body that lifts another: T = m (g − a), T2 = m2 (g + a)."""
    scene = level(
        {"weight": disc((-2, 0), mass=3), "upper": disc(), "lower": disc((0, -2))},
        GRAVITY,
        joints={
            "long": pulley(["weight", "upper"], [(-2, 3), (0, 3)]),
            "short": pulley(["upper", "lower"], [(0, -1)]),
        },
    )
    end = build(scene).advance(3)

    assert end.tension[0] == pytest.approx(3 * (G - G / 5), rel=1e-10)
    assert end.position[0, 1] == pytest.approx(-G / 5 * 0.05**2 / 2, rel=1e-10)


def test_many_strings_are_made_in_a_time_that_grows_as_they_do(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """300 strings over 19 pegs took 4.5 s: each asked anew which strings are alone."""
    looked = 0

    def counted(joint: Joint) -> Iterator[str]:
        nonlocal looked
        looked += 1
        return bodies_of(joint)

    monkeypatch.setattr(contact_solver_choice, "bodies_of", counted)
    count = 40
    bodies = {f"b{i}": disc((i, 0)) for i in range(2 * count)}
    ends = [(f"b{2 * i}", f"b{2 * i + 1}") for i in range(count)]
    strings = {f"s{i}": pulley(pair, [(2 * i, 3)]) for i, pair in enumerate(ends)}
    build(level(bodies, GRAVITY, joints=strings))

    assert 0 < looked <= 20 * count
