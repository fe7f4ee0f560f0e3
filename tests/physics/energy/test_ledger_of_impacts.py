"""What impacts, jerks and overlaps leave in the books."""

import numpy as np
import pytest

from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.engine.space_arrays import NO_CONTACTS
from sandbox.physics.events.impact_response import DriftImpacts, Impact
from sandbox.physics.events.joint_cuts_and_force_switches import EventEntries
from sandbox.physics.events.joint_impacts import Jolt
from sandbox.physics.joints.joint_forces import JointForces
from sandbox.physics.run import build
from sandbox.physics.stepping.world import World
from tests.physics.energy.test_ledger import rest, watched
from tests.physics.scenes import GRAVITY, G, box, disc, floor, level


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.8])
def test_an_impact_takes_what_its_restitution_says(restitution: float) -> None:
    """(1 − e²)/2 of the reduced mass times the speed of approach squared."""
    bounce = {"restitution": restitution}
    scene = level(
        {"a": disc((-1, 0), mass=2, velocity=[3, 0], **bounce), "b": disc((1, 0), restitution=1)},
        {"contact": {}, "restitution": {}},
    )

    books = watched(build(scene), 60)

    assert books[-1].loss["impacts"] == pytest.approx((1 - restitution**2) / 3 * 9, rel=1e-12)
    assert rest(books) < 1e-12


def test_impacts_in_sequence_take_the_speed_at_the_step() -> None:
    """Where pymunk's own speed is half a step old; a ball falls 1 m and bounces, e = 0.5."""
    ball = disc((0, 1.5), restitution=0.5)
    scene = level(
        {"ball": ball, "floor": floor(restitution=1)},
        {**GRAVITY, "contact": {}, "restitution": {"impacts": "sequence"}},
        stepping={"rate": 480},
    )

    books = watched(build(scene), 240)

    assert books[-1].loss["impacts"] == pytest.approx(0.75 * G, rel=1e-2)  # v dt late
    assert rest(books) < 1e-12


@pytest.mark.parametrize("anchor", [[0, 0], "static", "kinematic"])
def test_a_rope_that_is_jerked_taut_takes_energy_as_an_impact_does(anchor: str | list[int]) -> None:
    """Wherever it is tied: a body that does not move does no work."""
    hook = {"shape": {"type": "disc", "radius": 0.1}}
    scene = level(
        {
            "bob": disc((0.5, 0), mass=2, velocity=[3, 0]),
            "static": {"type": "static", **hook},
            "kinematic": {"type": "kinematic", **hook},
        },
        {},
        joints={"rope": {"type": "rope", "ends": [anchor, "bob"], "length": 1}},
    )

    books = watched(build(scene), 60)

    assert books[-1].loss["impacts"] == pytest.approx(9, rel=1e-12)
    assert books[-1].impulse["supports"] == pytest.approx([-6, 0, 0])


def test_what_impacts_cannot_give_is_unexplained() -> None:
    """Of elastic discs that touch, sweeps do not settle the impacts: 0.05 % of the energy goes."""
    rows = [(x, y) for x in range(5) for y in range(x + 1)]
    discs = {
        f"d{i}": disc((x * 0.75**0.5, y - x / 2), restitution=1) for i, (x, y) in enumerate(rows)
    }
    cue = disc((-3, 0.1), velocity=[5, 0], restitution=1)
    bodies = {"cue": cue, **discs}
    swept = level(bodies, {"contact": {"solver": "iterative"}, "restitution": {}})
    together = level(bodies, {"contact": {}, "restitution": {}})
    sequence = level(bodies, {"contact": {}, "restitution": {"impacts": "sequence"}})

    assert rest(watched(build(swept), 60)) > 1e-4
    assert rest(watched(build(together), 60)) < 1e-12
    assert rest(watched(build(sequence), 60)) < 1e-12


def test_taking_an_overlap_back_is_unexplained() -> None:
    """Two boxes are lifted apart: nothing in the scene gives the energy for it."""
    scene = level(
        {"low": box((0, 0.25)), "high": box((0, 0.65)), "floor": floor()},
        {**GRAVITY, "contact": {"overlaps": True}},
    )

    books = watched(build(scene), 120)

    assert books[-1].unexplained == pytest.approx(G * 0.1, rel=1e-3)


def struck() -> tuple[World, Ledger]:
    """Return a world after a kick in which two balls have lost 2.25 J, and its books."""
    world = build(level({"a": disc((-1, 0), velocity=[3, 0]), "b": disc((1, 0))}, {"contact": {}}))
    ledger = Ledger(world)
    while not ledger.balance.loss["impacts"]:
        world.advance()
        ledger.note()
    world.advance()
    return world, ledger


@pytest.mark.parametrize(("works", "lost"), [((1.0,), 2.25), ((-2.0, 1.0), 4.25)])
def test_no_impact_in_a_drift_takes_back_what_another_or_a_kick_lost(
    monkeypatch: pytest.MonkeyPatch, works: tuple[float, ...], lost: float
) -> None:
    world, ledger = struck()
    impacts = [
        Impact((0, 1), 0.0, 1 + 0j, (0j,), 0j, 0.0, 0.0, 0.0, work, np.zeros(3)) for work in works
    ]
    cut = DriftImpacts(impacts, world.scene.batch.velocity(), 0.0, np.zeros(3))
    monkeypatch.setattr(World, "last", world.last._replace(impacts=cut))
    ledger.note()

    assert ledger.balance.loss["impacts"] == pytest.approx(lost)


def test_no_jolt_takes_back_what_the_kick_before_it_lost(monkeypatch: pytest.MonkeyPatch) -> None:
    """A joint gives 1 N s along the way of a ball of 1 kg that goes on at 1.5 m/s: 2 J."""
    world, ledger = struck()
    begun = world.scene.batch.velocity()
    along = np.zeros((1, *begun.shape))
    along[0, 1, 0] = 1.0
    no = np.array([False])
    pulls = JointForces(along, np.array([-1.0]), no, no, np.array(["rod"]))
    place = world.scene.batch.state()[:, :3]
    jolt = Jolt(world.last.t, place, begun, begun + along[0], pulls, NO_CONTACTS, elastic=False)
    acted = EventEntries(begun, 0.0, (), (), np.zeros(3), 0.0, (jolt,))
    monkeypatch.setattr(World, "last", world.last._replace(events=acted))
    ledger.note()

    assert ledger.balance.loss["impacts"] == pytest.approx(2.25)
