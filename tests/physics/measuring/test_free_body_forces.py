"""The forces on a body add up to mass times acceleration, and are those of the textbook."""

from collections.abc import Callable, Mapping
from math import cos, hypot, inf, pi, sin
from typing import Any, NamedTuple

import numpy as np
import pytest

from sandbox.model import level_catalog
from sandbox.model.effects import EFFECTS
from sandbox.model.joints import KINDS
from sandbox.model.level import Level
from sandbox.physics.contacts.direct.solver import DirectSolver
from sandbox.physics.measuring.free_body import FRICTION, NORMAL, AppliedForce, FreeBody
from sandbox.physics.measuring.free_body_forces import FreeBodies
from sandbox.physics.run import build
from sandbox.physics.state.simulation_errors import NoForces, SimulationError
from sandbox.physics.stepping.world import World
from tests.effects import BODIES, examples
from tests.physics import scenes
from tests.physics.joints.test_register import least
from tests.physics.scenes import box, disc, fixed, floor, level
from validation.case import textbook

G = 9.81
BOUND = 1e-6
"""Of the strongest force; seen are 4e-15."""

ROUNDING = 1e-15
"""The share of a velocity by which it is known, twice: a force is a difference of them, over h."""

MOST_STEPS, MOST_BODIES = 200, 8
"""Of a level in the sweep."""

SAMPLE = (
    "newton/incline-with-friction",
    "newton/incline-breaks-loose",
    "newton/table-and-pulley-with-friction",
    "newton/atwood-massive-pulley",
    "newton/block-on-a-belt",
    "newton/magnetic-drift",
    "newton/rocket-launch",
    "newton/cart-under-hopper",
    "newton/projectile-with-drag",
    "energy/kepler-ellipse",
    "energy/damped-spring",
    "energy/helix",
    "momentum/sticking",
    "momentum/cradle",
    "rotation/yo-yo",
    "lagrange/double-pendulum",
    "lagrange/euler-pendulum",
    "machines/belt-drive",
    "machines/trebuchet",
    "machines/ragdoll",
)

OVERLAPPING = {
    "hard/10000-on-five",
    "hard/10000-on-one",
    "hard/144-boxes",
    "hard/deep-overlap",
    "hard/three-pyramids",
}
"""Where pymunk rubs at two points of a side that overlap by more than a hair, each by another
amount: it tells the sum of their impulses alone, so that torques are known to 4e-2 at worst."""


class Sums(NamedTuple):
    """How the diagrams of a run add up, at worst.

    Attributes
    ----------
    force, torque
        By how much sums are off, over the strongest force, or the largest torque of one.
    seen
        How many diagrams that is.
    """

    force: float
    torque: float
    seen: int


def sums(run: Level, steps: float = inf) -> Sums:
    """Look at every body at every step, but those with an impact, as long as a level lasts."""
    world = build(run)
    bodies = [n for n, m in zip(world.scene.bodies, world.scene.mass, strict=True) if m]
    bodies = bodies[: MOST_BODIES // 2] + bodies[MOST_BODIES // 2 :][-MOST_BODIES // 2 :]
    diagrams, force, torque, seen = FreeBodies(world), 0.0, 0.0, 0
    for _ in range(int(min(run.duration(world.values) * world.stepping.rate, steps)) + 1):
        for found in filter(None, map(diagrams.of, bodies)):
            if not (found.struck or found.is_completed):
                force, seen = max(force, forces_off(found, world)), seen + 1
                torque = max(torque, torques_off(found, world))
        world.advance()
    return Sums(force, torque, seen)


def forces_off(found: FreeBody, world: World) -> float:
    """Return by how much forces are off, beyond rounding, over the strongest."""
    speed = hypot(*world.snapshot.velocity[list(world.scene.bodies).index(found.body)])
    blur = ROUNDING * found.mass * speed / world.dt
    return max(found.imbalance - blur, 0.0) / max(
        found.largest, hypot(*found.mass_times_acceleration), 1e-300
    )


def torques_off(found: FreeBody, world: World) -> float:
    """Return the same of torques, over the largest; near the centre none is known better."""
    if not found.moment:
        return 0.0
    spin = found.moment * found.angular_acceleration
    largest = max((abs(acting.torque(found.center)) for acting in found.forces), default=0.0)
    row = list(world.scene.bodies).index(found.body)
    turns = found.moment * abs(float(world.snapshot.angular_velocity[row])) / world.dt
    blur = ROUNDING * turns + 1e-9 * found.largest
    return max(abs(found.torque - spin) - blur, 0.0) / max(largest, abs(spin), 1e-300)


def diagram(scene: Level, body: str, steps: int = 1) -> FreeBody:
    world = build(scene)
    scenes.run(world, steps)
    found = FreeBodies(world).of(body)
    assert found
    return found


def force(found: FreeBody, name: str) -> AppliedForce:
    (acting,) = [each for each in found.forces if each.name == name]
    return acting


@pytest.mark.parametrize("name", SAMPLE)
def test_forces_add_up_to_mass_times_acceleration(name: str) -> None:
    found = sums(textbook(name), 60)

    assert found.seen
    assert found.force < BOUND
    assert found.torque < BOUND


@pytest.mark.sweep
@pytest.mark.parametrize("name", level_catalog.names())
def test_forces_add_up_in_every_level(name: str) -> None:
    found = sums(textbook(name), MOST_STEPS)

    assert found.seen or name in NOTHING_TO_SEE
    assert found.force < BOUND
    assert found.torque < (0.1 if name in OVERLAPPING else BOUND)


@pytest.mark.sweep
def test_forces_add_up_where_a_block_breaks_loose_within_a_step() -> None:
    """Its friction was told to be the static limit, which it had for a part of the step only."""
    whole = sums(textbook("newton/breaking-loose"))

    assert whole.seen > 600
    assert whole.force < BOUND
    assert whole.torque < BOUND


NOTHING_TO_SEE = {"hard/net-of-20"}
"""Its joints are pymunk's own: what they give is known from the sum alone."""


def test_a_force_that_is_left_out_is_missed() -> None:
    """So that the sums above can fail: without the friction the block would go faster."""
    found = diagram(textbook("newton/incline-with-friction"), "block")

    others = [acting.force for acting in found.forces if acting.name != FRICTION]

    x, y = np.sum(others, axis=0) - found.mass_times_acceleration
    assert hypot(x, y) == pytest.approx(force(found, FRICTION).magnitude, rel=1e-12)
    assert hypot(x, y) > 0.1 * found.largest


def test_forces_read_with_the_velocity_of_the_drift_miss() -> None:
    """Drag at the velocity half a step ago, as pymunk has it, is off by a · dt/2 · dF/dv."""
    world = build(textbook("newton/projectile-with-drag"))
    world.advance()
    found = FreeBodies(world).of("ball")
    assert found

    (law,) = world.scene.laws
    wrench = np.zeros((len(world.scene.bodies), 3))
    early = world.snapshot
    row = list(world.scene.bodies).index("ball")
    early.velocity[row] = world.last.pre_kick_velocity[row, :2]
    law.add(early, wrench)

    x, y = wrench[row, :2] - force(found, "drag").force
    assert hypot(x, y) > 100 * BOUND * found.largest


def test_a_block_held_on_an_incline() -> None:
    """N = m g cos α across it, and friction m g sin α up along it."""
    found = diagram(textbook("newton/incline-that-holds"), "block", 30)

    weight, normal, friction = (force(found, name) for name in ("weight", NORMAL, FRICTION))
    (x, y), *_ = found.surface_directions
    slope = -(weight.force[0] * x + weight.force[1] * y)  # how far weight points down along it

    assert normal.force[0] * x + normal.force[1] * y == pytest.approx(0, abs=1e-12)
    assert normal.magnitude == pytest.approx(hypot(normal.force[0], normal.force[1]))
    assert friction.force[0] * x + friction.force[1] * y == pytest.approx(slope, rel=1e-9)
    assert found.net == pytest.approx((0, 0), abs=1e-9)


def test_an_atwood_machine() -> None:
    """T = 2 m₁ m₂ g / (m₁ + m₂), on both."""
    scene = scenes.atwood(1, 3)

    for body, mass in zip(scene.bodies, (1, 3), strict=True):
        found = diagram(scene, body)
        assert force(found, "tension").force == pytest.approx((0, 1.5 * G), rel=1e-12)
        assert force(found, "weight").force == pytest.approx((0, -mass * G))


def test_a_rolling_disc_is_rubbed_where_it_touches() -> None:
    """Down a slope of α, friction is m g sin α / 3, and its lever is the radius."""
    angle = 20 * pi / 180
    scene = level(
        {
            "slope": fixed({"type": "segment", "start": [-50, 0], "end": [50, 0]}, angle=-angle,
                           friction=1),
            "disc": disc((0.5 * sin(angle), 0.5 * cos(angle)), friction=1),
        },
        {"gravity": {"acceleration": [0, -G]}, "contact": {}, "friction": {}, "rotation": {}},
    )  # fmt: skip
    found = diagram(scene, "disc", 20)

    friction = force(found, FRICTION)
    assert friction.magnitude == pytest.approx(G * sin(angle) / 3, rel=1e-6)
    assert abs(friction.torque(found.center)) == pytest.approx(friction.magnitude * 0.5, rel=1e-6)
    assert found.torque == pytest.approx(found.moment * found.angular_acceleration, rel=1e-6)


@pytest.mark.parametrize("direct", [False, True])
def test_a_box_that_is_pushed_above_rests_on_its_far_side(direct: bool) -> None:
    """Pushed by F at a height of h above its centre, N acts where N x = F h + F · half."""
    push, weight = 2.0, G
    bodies = {"floor": floor(friction=1), "box": box((0, 0.5), size=(1, 1), friction=1)}
    effects = {
        "gravity": {"acceleration": [0, -G]},
        "contact": {"solver": "direct"} if direct else {},
        "friction": {},
        "rotation": {},
        "force": [{"body": "box", "force": [push, 0], "at": [0, 0.25]}],
    }
    found = diagram(level(bodies, effects, stepping={"rate": 500}), "box", 100)

    normal, pushing = force(found, NORMAL), force(found, "applied force")
    assert pushing.at == pytest.approx((found.center[0], 0.75), abs=1e-3)
    assert normal.at[0] - found.center[0] == pytest.approx(push * 0.75 / weight, rel=1e-3)


def test_a_rod_pulls_at_the_point_where_it_holds() -> None:
    scene = level(
        {"plank": box((0, 0), size=(2, 0.2))},
        {"gravity": {"acceleration": [0, -G]}, "rotation": {}},
        joints={"rod": {"type": "rod", "ends": [[1, 2], {"body": "plank", "at": [1, 0]}]}},
    )
    found = diagram(scene, "plank")

    rod = force(found, "rod force")
    assert rod.at == pytest.approx((1, 0), abs=1e-3)
    assert rod.couple == pytest.approx(0, abs=1e-9)


def test_a_string_that_is_wound_pulls_at_the_rim() -> None:
    """Its line of action touches the circle on which it is wound."""
    scene = textbook("rotation/yo-yo")
    world = build(scene)
    world.advance()
    (name,) = world.scene.joints.radii
    body = next(b for b, m in zip(scene.bodies, world.scene.mass, strict=True) if m)
    found = FreeBodies(world).of(body)
    assert found

    at = force(found, "tension").at
    away = hypot(at[0] - found.center[0], at[1] - found.center[1])
    assert away == pytest.approx(world.scene.joints.radii[name], rel=1e-9)


def test_an_impact_is_marked() -> None:
    scene = level(
        {"floor": floor(restitution=1), "ball": disc((0, 0.6), velocity=[0, -3], restitution=1)},
        {"contact": {}, "restitution": {"impacts": "sequence"}},
    )
    world = build(scene)
    diagrams = FreeBodies(world)
    struck = []
    for _ in range(6):
        world.advance()
        found = diagrams.of("ball")
        assert found
        struck.append(found.struck)

    assert struck.count(True) == 1


def test_a_hand_is_known_from_the_rest_and_says_so() -> None:
    world = build(level({"ball": disc()}, {"gravity": {"acceleration": [0, -G]}}))
    world.grab("ball", (0, 0))
    world.advance(60)
    found = FreeBodies(world).of("ball")
    assert found

    assert found.is_completed
    assert force(found, "hand").force[1] == pytest.approx(G, rel=0.05)


def test_what_nothing_moves_has_no_diagram() -> None:
    world = build(level({"floor": floor(), "ball": disc((0, 2))}, {"contact": {}}))

    assert FreeBodies(world).of("floor") is None
    with pytest.raises(ValueError, match="nobody"):
        FreeBodies(world).of("nobody")


def test_a_scheme_that_begins_without_half_a_kick_knows_no_forces_at_first() -> None:
    world = build(textbook("lagrange/euler-pendulum"))
    diagrams, body = FreeBodies(world), next(iter(world.scene.bodies))

    assert diagrams.of(body) is None
    world.advance()
    assert diagrams.of(body)


def test_looking_leaves_the_run_as_it_is() -> None:
    def run(look: Callable[[World], object]) -> bytes:
        world = build(textbook("machines/ragdoll"))
        for _ in range(50):
            world.advance()
            look(world)
        return world.snapshot.position.tobytes()

    assert run(lambda world: FreeBodies(world).of("head")) == run(lambda _: None)


@pytest.mark.parametrize("name", [effect.name for effect in EFFECTS.values() if effect.is_force])
def test_every_force_that_there_is_is_in_the_diagram(name: str) -> None:
    """From the register: an effect that is added is drawn under its name, and closes the sum."""
    bodies = {
        body: disc((1.2 * i - 1, 0.3 * i * i), mass=3 + i, velocity=[1, 0.4], angular_velocity=0.1)
        for i, body in enumerate(BODIES)
    }
    for said in examples(name, 1.5):
        effects = {"rotation": {}, name: said}
        world = build(level(bodies, effects, stepping={"rate": 1000}))
        world.advance(3)
        diagrams = [FreeBodies(world).of(body) for body in BODIES]
        called = {acting.name for found in diagrams if found for acting in found.forces}

        assert called == {EFFECTS[name].shown_force_name}
        assert all(found and forces_off(found, world) < BOUND for found in diagrams)


STOPS: Mapping[str, Any] = {
    "stop": {"force": [{"body": "b", "force": [-3, 3]}]},
    "angle_stop": {"torque": [{"body": "b", "torque": -0.3}]},
}
"""What presses the second body against the stop at the end of its range."""


@pytest.mark.parametrize("kind", KINDS)
def test_every_joint_that_there_is_is_in_the_diagram(kind: str) -> None:
    """The second goes round the first, so that even what only pulls has to; or into its stop."""
    way = [0.3, 0.3] if kind == "pulley" else [0, 0.3]  # about its peg
    bodies = {"a": disc(), "b": disc((3, 0), mass=2, velocity=way, angular_velocity=0.1)}
    tie, effects = least(kind), {"gravity": {"acceleration": [0, -G]}, "rotation": {}}
    if kind in STOPS:
        bodies["b"] = disc((3, 0), mass=2)
        tie, effects = {**tie, "range": [0, 1]}, {**effects, **STOPS[kind]}
    scene = level(bodies, effects, joints={"tie": tie}, stepping={"rate": 240})
    world = build(scene)
    world.advance(3)
    diagrams = list(filter(None, map(FreeBodies(world).of, "ab")))
    by = {acting.by: acting.name for found in diagrams for acting in found.forces}

    assert by["tie"] == KINDS[kind].force_name
    assert all(forces_off(found, world) < BOUND for found in diagrams)
    assert all(torques_off(found, world) < BOUND for found in diagrams)


def test_after_a_step_that_failed_the_forces_of_the_last_whole_one_are_told(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def fail(_: DirectSolver) -> None:
        raise NoForces(0, 1)

    scene = level(
        {"floor": floor(), "box": box((0, 0.5), mass=3)},
        {"gravity": {"acceleration": [0, -G]}, "contact": {"solver": "direct"}},
    )
    world = build(scene)
    world.advance(20)
    monkeypatch.setattr(DirectSolver, "_solve_all", fail)
    with pytest.raises(SimulationError):
        world.advance(1)

    found = FreeBodies(world).of("box")

    assert found
    assert force(found, NORMAL).magnitude == pytest.approx(3 * G, rel=1e-9)
