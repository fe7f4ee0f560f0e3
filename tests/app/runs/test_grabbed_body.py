"""A hand on a body that hangs on rods: it moves as the rods allow, and the run continues."""

from math import hypot

import numpy as np
import pytest

from sandbox.app.runs.session import Session
from sandbox.model import level_catalog
from sandbox.model.joints import Wire
from sandbox.model.loading import load
from sandbox.model.wire_points import along
from tests.app.person import Person
from tests.levels.playing import fingerprint

PIVOTS = {"ball1": 0.0, "ball2": 0.2, "ball5": 0.8}  # m, at a height of 1 m; the rods are 1 m long


def where(session: Session, body: str) -> tuple[float, float]:
    x, y = session.world.snapshot.position[list(session.level.bodies).index(body)].tolist()
    return x, y


def lift(person: Person, body: str, to: tuple[float, float]) -> None:
    person.drag(person.on_screen(where(person.session, body)), person.on_screen(to))


@pytest.mark.parametrize(
    ("body", "to"), [("ball5", (1.2, 0.15)), ("ball1", (-0.7, 0.3)), ("ball2", (-0.4, 0.6))]
)
def test_a_ball_that_is_lifted_while_time_stands_stays_on_its_rod(
    person: Person, body: str, to: tuple[float, float]
) -> None:
    person.window.open_level("momentum/cradle")
    person.wait()

    lift(person, body, to)

    x, y = where(person.session, body)
    assert person.session.failure is None
    assert hypot(x - PIVOTS[body], y - 1) == pytest.approx(1, rel=1e-12)
    along = complex(to[0] - PIVOTS[body], to[1] - 1)
    assert abs(along / abs(along) - complex(x - PIVOTS[body], y - 1)) < 0.03  # four pixels at 0.7 m


def test_a_bead_that_is_moved_while_time_stands_stays_on_its_wire(person: Person) -> None:
    """It stood beside the wire until the run was played."""
    person.window.open_level("lagrange/bead-on-a-wire")
    person.wait()
    session = person.session
    wire = session.level.joints["high_wire"]
    assert isinstance(wire, Wire)
    x, y = where(session, "high")

    lift(person, "high", (x / 2, y + 0.2))

    bead = complex(*where(session, "high"))
    assert abs(bead - complex(x, y)) > 0.3
    assert abs(along(wire, session.values) - bead).min() < 1e-12
    session.step()
    assert session.failure is None


def test_two_balls_that_are_lifted_by_hand_send_two_off_on_the_other_side(person: Person) -> None:
    person.window.open_level("momentum/cradle")
    person.wait()
    lift(person, "ball1", (-0.7, 0.28))
    lift(person, "ball2", (-0.4, 0.2))
    session = person.session
    highest = np.zeros(5)
    for _ in range(900):
        session.step()
        highest = np.maximum(highest, session.world.snapshot.position[1:, 1])

    assert session.failure is None
    assert (highest[3:] > 0.1).all()
    assert highest[2] < 0.05


@pytest.mark.sweep
def test_in_the_middle_of_a_swing_too() -> None:
    session = Session(load(level_catalog.find("momentum/cradle")))
    for _ in range(150):
        session.step()
    session.grab("ball1", where(session, "ball1"))
    session.drag((-0.8, 0.2))
    session.release()
    for _ in range(100):
        session.step()

    x, y = where(session, "ball1")
    assert session.failure is None
    assert hypot(x, y - 1) == pytest.approx(1, rel=1e-9)


def test_a_run_goes_on_from_where_it_stood_after_a_body_could_not_be_put_elsewhere(
    person: Person,
) -> None:
    """A chassis moved without its wheels stopped the run for good, and advised a useless rate."""
    person.window.open_level("machines/car-over-bumps")
    session = person.session
    for _ in range(20):
        session.step()
    x, y = where(session, "chassis")
    state = fingerprint(session.world.snapshot)

    lift(person, "chassis", (x - 0.2, y + 0.3))
    while session.sought is not None:
        person.wait()

    assert session.failure is None
    assert fingerprint(session.world.snapshot) == state
    assert not session.actions
    assert "it cannot be put there: nothing keeps" in person.window.banner._note
    session.step()
    assert session.world.steps == 21
