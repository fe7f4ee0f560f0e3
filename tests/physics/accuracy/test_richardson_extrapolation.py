"""What runs with ever smaller steps reveal about their errors."""

from dataclasses import replace

import pytest

from sandbox.model.expressions import Array
from sandbox.model.level import Level, Stepping
from sandbox.physics.accuracy import step_refinement
from sandbox.physics.accuracy.compared_runs import Watched, record, scaled, watched
from sandbox.physics.accuracy.event_timing_errors import RelativeError, hidden_error
from sandbox.physics.accuracy.richardson_extrapolation import extrapolated
from sandbox.physics.accuracy.step_refinement import (
    Refinement,
    largest_relative_difference,
    relative_to,
    with_errors,
)
from sandbox.physics.measuring.recording import Trace
from tests.physics.scenes import GRAVITY, G, disc, floor, level, orbit

PLACE = Watched("planet.position.x")
NONE = RelativeError()


def runs(scene: Level, *rates: float) -> list[Trace]:
    wanted = watched(scene, scene.defaults)
    return [record(scene, scene.defaults, Stepping(rate=rate), wanted) for rate in rates]


@pytest.mark.sweep
def test_errors_fall_by_the_order_of_the_scheme() -> None:
    traces = runs(orbit(), 60, 120, 240)
    found = extrapolated(traces, PLACE)

    assert found is not None
    assert found.order == pytest.approx(2, abs=0.01)
    assert found.absolute[0] == pytest.approx(16 * found.absolute[-1], rel=0.05)


@pytest.mark.sweep
def test_runs_that_agree_by_chance_are_told_no_better_than_the_order_allows() -> None:
    """For example if both find an impact at the same instant: the previous difference counts on."""
    *coarse, fine = runs(orbit(), 60, 120, 240)
    alike = replace(fine, columns={**fine.columns, PLACE.quantity: twice(coarse[-1], fine)})

    true, found = extrapolated([*coarse, fine], PLACE), extrapolated([*coarse, alike], PLACE)

    assert true is not None
    assert found is not None
    assert found.absolute[-1] == pytest.approx(true.absolute[-1], rel=0.05)


def twice(coarse: Trace, fine: Trace) -> Array:
    """Return a column that agrees with that of a coarser run at all instants of that."""
    column = fine.columns[PLACE.quantity].copy()
    column[::2] = coarse.columns[PLACE.quantity]
    return column


@pytest.mark.sweep
@pytest.mark.parametrize("x", [0.7, 0.93])
def test_a_rope_that_goes_taut_is_told_as_it_is(x: float) -> None:
    """It takes energy at the start of a step, and holds at its end, so nothing is late.

    The true error is 0.9 to 1.1 times the stated one at these and at six other places.
    """
    rope = {"type": "rope", "ends": [[0, 0], "ball"], "length": 1.2}
    scene = level({"ball": disc((x, 0.2))}, GRAVITY, joints={"rope": rope}, duration=1.5)
    traces = runs(scene, 60, 120, 240, 480)
    [best] = runs(scene, 3840)
    wanted = scaled(watched(scene, scene.defaults), best)

    told = with_errors(traces, wanted).errors[-1]

    assert hidden_error(traces[-1], wanted).item is None
    assert 0.5 * told < largest_relative_difference(traces[-1], best, wanted)[0] < 2 * told


def test_a_peak_between_two_steps_is_told() -> None:
    """A ball that is highest half-way between two steps: its height is g h²/8 above theirs."""
    step = 1 / 30
    top = 4.5 * step
    item = Watched("ball.position.y.max")
    scene = level({"ball": disc((0, 0), velocity=[0, G * top])}, GRAVITY, duration=0.5)
    run = record(scene, {}, Stepping(rate=30), [item])
    missed = G * top**2 / 2 - run.columns[item.quantity].max()

    off = hidden_error(run, [item])

    assert missed == pytest.approx(G * step**2 / 8, rel=1e-6)
    assert off.error * (G * top**2 / 2 - missed) == pytest.approx(missed, rel=1e-6)
    assert off.item == item


@pytest.mark.sweep
def test_a_run_is_told_no_better_than_its_own_scheme_shows() -> None:
    """The last run of another scheme may seem more accurate than it is.

    Here it is made from the second run of three, so that this one would seem to have no error.
    """
    traces = runs(orbit(), 60, 120, 240)
    own = with_errors(traces, [PLACE])
    alike = replace(traces[1], stepping=Stepping(rate=120, scheme="fourth-order"))
    better = Refinement((alike,), (1e-12,), ())

    found = relative_to(own, better, [PLACE])

    assert found.errors[1] == own.errors[1] > 1e-5
    assert found.own_error == own.errors[-1]
    assert relative_to(with_errors(traces[:2], [PLACE]), better, [PLACE]).errors[1] == 1e-12


@pytest.mark.sweep
def test_where_impacts_are_late_runs_that_agree_by_chance_show_no_order(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A slide on a cycloid was told 4.5e-7 by extrapolation from such runs, and off by 1.4e-6."""
    *coarse, fine = runs(orbit(), 60, 120, 240)
    alike = replace(fine, columns={**fine.columns, PLACE.quantity: twice(coarse[-1], fine)})
    touching = level({"ball": disc((0, 1)), "floor": floor()}, {**GRAVITY, "contact": {}})

    def order(last: Trace, *, late: float) -> float:
        found = {60: RelativeError(late)}
        monkeypatch.setattr(
            step_refinement, "hidden_error", lambda t, _: found.get(t.stepping.rate, NONE)
        )
        traces = [replace(trace, level=touching) for trace in (*coarse, last)]
        return with_errors(traces, [PLACE]).growth[0][1]

    assert order(alike, late=1e-3) == 1
    assert order(alike, late=0) == 2  # nothing strikes
    assert order(fine, late=1e-3) == pytest.approx(2, abs=0.01)
