"""Extremes, means and integrals: from a run, and of two bodies, points and pairs that touch."""

import json
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from sandbox.model.errors import LevelError
from sandbox.model.level import Level
from sandbox.model.loading import parse
from sandbox.model.quantities import OVER_TIME, QuantityError, mutual, quantity
from sandbox.physics.measuring.grading import grade
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.measuring.running_aggregates import over_time
from sandbox.physics.run import simulate

G = 10.0
BOX = {"shape": {"type": "box", "width": 1, "height": 1}, "friction": 0.5}
FLOOR = {
    "type": "static", "shape": {"type": "box", "width": 20, "height": 1}, "position": [0, -0.5],
    "friction": 1,
}  # fmt: skip


def level(bodies: dict[str, Any], **changes: Any) -> Level:  # noqa: ANN401
    return parse(json.dumps({
        "format": 1, "title": "x", "effects": {"gravity": {"acceleration": [0, -G]}},
        "bodies": bodies, "stepping": {"rate": 240}, "duration": 1, **changes,
    }))  # fmt: skip


def run(found: Level, *record: str, duration: float = 1.0) -> Trace:
    return simulate(found, duration=duration, record=list(record))


def stack() -> Level:
    """A light box under a heavy one, on a floor."""
    surfaces = {"gravity": {"acceleration": [0, -G]}, "contact": {}, "friction": {}}
    bodies = {
        "floor": FLOOR,
        "low": BOX | {"mass": 2, "position": [0, 0.5]},
        "high": BOX | {"mass": 30, "position": [0, 1.5]},
    }
    return level(bodies, effects=surfaces)


def test_each_pair_bears_what_lies_above_it() -> None:
    pairs = [("low", "floor"), ("low", "high"), ("high", "low"), ("high", "floor")]
    names = [f"{one}.contact.{other}.normal" for one, other in pairs]
    trace = run(stack(), *names, "low.contact.normal")
    last = {name: column[-1] for name, column in trace.columns.items()}

    assert last["low.contact.floor.normal"] == pytest.approx(320, rel=1e-3)
    assert last["low.contact.high.normal"] == pytest.approx(300, rel=1e-3)
    other = last["low.contact.high.normal"]
    assert last["high.contact.low.normal"] == pytest.approx(other, rel=1e-12)
    assert last["high.contact.floor.normal"] == 0
    both = last["low.contact.floor.normal"] + last["low.contact.high.normal"]
    assert last["low.contact.normal"] == pytest.approx(both, rel=1e-12), "what was known before"


@pytest.mark.parametrize("scheme", ["leapfrog", "symplectic-euler"])
def test_a_force_between_bodies_is_known_from_the_start_on(scheme: str) -> None:
    found = stack().model_copy(update={"stepping": stack().stepping.model_copy(
        update={"scheme": scheme})})  # fmt: skip
    trace = run(found, "low.contact.floor.normal", duration=0.1)

    assert np.isfinite(trace.columns["low.contact.floor.normal"]).all()


def spinning() -> Level:
    """A stick that is thrown spinning, and a ball that is thrown after it."""
    stick = {
        "shape": {"type": "box", "width": 2, "height": 0.1}, "mass": 3, "velocity": [1, 4],
        "angular_velocity": 3, "angle": 0.4, "points": {"tip": [1, 0]},
    }  # fmt: skip
    ball = {"shape": {"type": "disc", "radius": 0.1}, "mass": 1, "position": [3, 1]}
    effects = {"gravity": {"acceleration": [0, -G]}, "rotation": {}}
    return level({"stick": stick, "ball": ball | {"velocity": [-1, 2]}}, effects=effects)


def test_a_point_of_a_body_goes_round_its_centre() -> None:
    names = [f"stick.tip.{what}" for what in ("position.x", "position.y", "velocity.y")]
    trace = run(spinning(), *names)
    t, angle = trace.t, 0.4 + 3 * trace.t

    assert trace.columns[names[0]] == pytest.approx(t + np.cos(angle), abs=1e-9)
    assert trace.columns[names[1]] == pytest.approx(4 * t - G * t**2 / 2 + np.sin(angle), abs=1e-9)
    assert trace.columns[names[2]] == pytest.approx(4 - G * t + 3 * np.cos(angle), abs=1e-9)


def test_two_bodies_that_fall_move_evenly_as_seen_from_each_other() -> None:
    trace = run(spinning(), "ball.relative.stick.velocity.x", "ball.relative.stick.velocity.y",
                "ball.relative.stick.distance", "stick.relative.ball.position.x")  # fmt: skip
    t, columns = trace.t, trace.columns

    assert columns["ball.relative.stick.velocity.x"] == pytest.approx(np.full_like(t, -2), abs=1e-9)
    assert columns["ball.relative.stick.velocity.y"] == pytest.approx(np.full_like(t, -2), abs=1e-9)
    away = np.hypot(3 - 2 * t, 1 - 2 * t)
    assert columns["ball.relative.stick.distance"] == pytest.approx(away, abs=1e-9)
    assert columns["stick.relative.ball.position.x"] == pytest.approx(2 * t - 3, abs=1e-9)


def bead(curve: list[object]) -> Level:
    ball = {"shape": {"type": "disc", "radius": 0.1}, "mass": 2, "position": [0, 0]}
    return level({"bead": ball}, joints={"wire": {
        "type": "wire", "bead": "bead", "curve": curve, "s": [-5, 5]}})  # fmt: skip


@pytest.mark.parametrize(("curve", "sign"), [(["s", 0], 1), (["-s", 0], -1)])
def test_a_wire_pushes_to_its_left_or_to_its_right(curve: list[object], sign: int) -> None:
    trace = run(bead(curve), "wire.push", "wire.tension", duration=0.1)

    assert trace.columns["wire.push"] == pytest.approx(np.full_like(trace.t, sign * 2 * G))
    assert trace.columns["wire.tension"] == pytest.approx(np.full_like(trace.t, 2 * G))


def test_what_is_thrown_up_has_its_extremes_mean_and_integral() -> None:
    ball = {"shape": {"type": "disc", "radius": 0.1}, "mass": 1, "velocity": [0, 5]}
    trace = run(level({"ball": ball}), *(f"ball.position.y.{what}" for what in OVER_TIME))
    found = {name.rpartition(".")[2]: column[-1] for name, column in trace.columns.items()
             if name != "ball.position.y"}  # fmt: skip

    assert found["max"] == pytest.approx(1.25, abs=G / 240**2)
    assert found["min"] == pytest.approx(0, abs=1e-9)
    assert found["integral"] == pytest.approx(5 / 2 - G / 6, abs=1e-4)
    assert found["mean"] == pytest.approx(found["integral"])
    assert found["amplitude"] == pytest.approx(found["max"] / 2)
    assert trace.units["ball.position.y.integral"] == "m·s"


@pytest.mark.sweep
@given(y=arrays(float, st.integers(1, 30), elements=st.floats(-1e6, 1e6)))
def test_what_has_come_of_a_quantity_is_that_of_the_part_so_far(y: np.ndarray) -> None:
    t = np.arange(len(y)) / 7 + 3
    whole = {what: over_time(what, t, y) for what in OVER_TIME}

    for end in {1, len(y) // 2 or 1, len(y)}:
        part = y[:end]
        assert whole["max"][end - 1] == part.max()
        assert whole["min"][end - 1] == part.min()
        assert whole["largest"][end - 1] == np.abs(part).max()
        integral = np.trapezoid(part, t[:end])
        assert whole["integral"][end - 1] == pytest.approx(integral, rel=1e-9, abs=1e-6)


BOUNCING = {"shape": {"type": "disc", "radius": 0.1}, "mass": 1, "position": [0, 1.1],
            "restitution": 0.5}  # fmt: skip


def bouncing(located: bool, *checks: dict[str, Any]) -> Level:
    floor = FLOOR | {"restitution": 1}
    del floor["friction"]
    effects: dict[str, Any] = {"gravity": {"acceleration": [0, -G]}, "restitution": {}}
    effects["contact"] = {"located": ["ball"]} if located else {}
    return level({"ball": BOUNCING, "floor": floor}, effects=effects, checks=checks, duration=1.5)


def when(event: str, nth: object, **of: Any) -> dict[str, Any]:  # noqa: ANN401
    at = {"event": event, "bodies": ["floor", "ball"], "nth": nth}
    return {"quantity": "t", "tolerance": 1e-6, "at": at, **of}


FALL = np.sqrt(2 / G)


@pytest.mark.parametrize(("nth", "time"), [(1, FALL), (2, 2 * FALL), ("3", 2.5 * FALL)])
def test_the_nth_contact_of_a_pair_is_told_apart(nth: object, time: float) -> None:
    found = bouncing(True, when("contact", nth, formula=time))
    (result,) = grade(simulate(found))

    assert result.verdict == "passed", result


@pytest.mark.parametrize("nth", [1, 2])
def test_a_pair_parts_after_it_has_met(nth: int) -> None:
    """Without located impacts it meets up to a step late, and parts within three."""
    time = FALL * (1 if nth == 1 else 2)
    found = bouncing(False, when("separation", nth, formula=time, tolerance=1))
    (result,) = grade(simulate(found))

    assert result.t is not None
    assert time < result.t < time + 4 / 240


def test_a_pair_that_does_not_meet_so_often_is_waited_for() -> None:
    (result,) = grade(simulate(bouncing(True, when("contact", 100, formula=0))))

    assert result.verdict == "waiting"


@pytest.mark.parametrize("nth", [0, -1, 101, "x", 1.5, True, None])
def test_what_counts_no_times_is_refused(nth: object) -> None:
    with pytest.raises(LevelError, match="checks"):
        bouncing(True, when("contact", nth, formula=0))


def test_an_event_of_a_pair_needs_contact() -> None:
    bodies = {"ball": BOUNCING | {"restitution": None}, "floor": FLOOR}
    del bodies["ball"]["restitution"]
    floor = {key: said for key, said in FLOOR.items() if key != "friction"}
    with pytest.raises(LevelError, match="the effect 'contact' is not declared"):
        level(bodies | {"floor": floor}, checks=[when("separation", 1, formula=0)])


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("low.contact.flor.normal", "did you mean 'low.contact.floor.normal'?"),
        ("low.relative.hihg.distance", "did you mean 'low.relative.high.distance'?"),
        ("low.speed.maxi", "did you mean 'low.speed.max'?"),
        ("low.speed.max.min", "has no 'min' over time"),
        ("t.max", "'t' has no 'max' over time"),
        ("low.relative.low.distance", "is not a quantity"),
        ("low.contact.floor.position", "is not a quantity"),
    ],
)
def test_a_misspelt_quantity_of_two_is_completed(name: str, told: str) -> None:
    with pytest.raises(QuantityError) as caught:
        quantity(name, stack())
    assert told in str(caught.value)


def test_all_that_two_bodies_have_together_is_listed_and_found() -> None:
    found = list(mutual(stack()))

    assert len({q.name for q in found}) == len(found) == 6 * 9
    assert all(quantity(q.name, stack()) == q and q.unit for q in found)


def test_a_point_cannot_be_called_as_what_is_measured() -> None:
    ball = {"shape": {"type": "disc", "radius": 1}, "mass": 1, "points": {"contact": [0, 0]}}
    with pytest.raises(LevelError, match="is a quantity of the body itself"):
        level({"ball": ball})
