"""Requests for accuracy in the cost sweep."""

import json
from math import inf, nan

import pytest

from sandbox.model.level import Scheme, Stepping
from sandbox.model.level_catalog import find
from sandbox.model.loading import load
from sandbox.physics.accuracy.candidate_settings import Offer
from sandbox.physics.accuracy.requested_accuracy import Setting
from validation.cost_of_accuracy.accuracy_requests import Request
from validation.cost_of_accuracy.report import asked, summed
from validation.cost_of_accuracy.scheme_and_rate_sweep import Budget, Point, Sweep, errors, timed
from validation.random_accuracy_requests import looked_at

BUDGET = Budget(run=0.05, rates=(30.0, 120.0, 480.0), targets=(1e-3, 1e-5))


@pytest.mark.sweep
@pytest.mark.parametrize("name", ["newton/projectile-with-drag", "newton/incline"])
def test_what_is_asked_for_is_delivered(name: str) -> None:
    sweep = timed(errors(name, BUDGET))

    assert [request.target for request in sweep.requests] == [1e-3, 1e-5]
    for request in sweep.requests:
        assert request.delivered <= request.target
        assert request.estimated <= request.target
        assert request.cost > 0
    written = json.loads(json.dumps(asked([sweep]), allow_nan=False))
    assert [row["delivered"] for row in written] == [r.delivered for r in sweep.requests]


def request(delivered: float, cost: float, cheapest: float) -> Request:
    return Request("a", 1e-3, Stepping(), 1e-4, delivered, cost, cheapest)


def test_a_request_is_honoured_if_it_is_delivered_and_not_dear() -> None:
    assert request(1e-3, 3.0, 1.0).honoured
    assert request(1e-3, 3.0, inf).honoured  # the sweep has nothing as close
    assert not request(2e-3, 1.0, 1.0).honoured
    assert not request(1e-3, 3.1, 1.0).honoured
    assert not request(float("nan"), 1.0, 1.0).honoured


def test_stock_pymunk_counts_where_impacts_come_in_sequence_too() -> None:
    """It solves all impacts of a break at once, for a twentieth of the cost."""
    name = "momentum/billiard-break"
    schemes: tuple[Scheme, ...] = ("symplectic-euler", "leapfrog")
    points = tuple(Point(scheme, 60, 10, 0.0, nan, 1, 0) for scheme in schemes)
    asked_for = Request(name, 1e-3, Stepping(rate=60), 0.0, 0.0)

    [found] = timed(Sweep(name, "closed form", (), 60.0, points, (asked_for,))).requests

    assert found.cheapest < found.cost / 3
    assert not found.honoured


@pytest.mark.sweep
def test_a_cheaper_setting_is_one_that_shares_instants_and_holds_at_every_step() -> None:
    """A run at 15 Hz was as accurate as any at 429.7 Hz: they share no instant."""
    level = load(find("lagrange/simple-pendulum"))
    chosen = Offer(Stepping(rate=53.7137, scheme="fourth-order"), 1e-5, 1e-3)

    delivered, cheaper = looked_at(level, level.defaults, Setting(3e-6, chosen, "motion", True))

    assert 1e-9 < delivered < 1e-4
    assert cheaper == ""


@pytest.mark.sweep
def test_the_sum_counts_what_was_met() -> None:
    sweep = errors("newton/incline", Budget(run=0.01, rates=(60.0,), targets=(1e-3,)))

    assert summed([sweep]).startswith("1 of 1 requested accuracies were delivered")
