"""Accuracies that are asked for in the cost sweep."""

import json
from math import inf

import pytest

from sandbox.model.level import Stepping
from validation.cost.report import asked, summed
from validation.cost.requests import Request
from validation.cost.sweep import Budget, errors, timed

BUDGET = Budget(run=0.05, rates=(30.0, 120.0, 480.0), targets=(1e-3, 1e-5))


@pytest.mark.parametrize("name", ["newton/projectile-with-drag", "newton/incline"])
def test_what_is_asked_for_is_delivered(name: str) -> None:
    sweep = timed(errors(name, BUDGET))

    assert [request.target for request in sweep.requests] == [1e-3, 1e-5]
    for request in sweep.requests:
        assert request.delivered <= request.target
        assert request.estimated <= request.target
        assert request.price > 0
    written = json.loads(json.dumps(asked([sweep]), allow_nan=False))
    assert [row["delivered"] for row in written] == [r.delivered for r in sweep.requests]


def request(delivered: float, price: float, cheapest: float) -> Request:
    return Request("a", 1e-3, Stepping(), 1e-4, delivered, price, cheapest)


def test_a_request_is_honoured_if_it_is_delivered_and_not_dear() -> None:
    assert request(1e-3, 3.0, 1.0).honoured
    assert request(1e-3, 3.0, inf).honoured  # the sweep has nothing as close
    assert not request(2e-3, 1.0, 1.0).honoured
    assert not request(1e-3, 3.1, 1.0).honoured
    assert not request(float("nan"), 1.0, 1.0).honoured


def test_the_sum_counts_what_was_met() -> None:
    sweep = errors("newton/incline", Budget(run=0.01, rates=(60.0,), targets=(1e-3,)))

    assert summed([sweep]).startswith("1 of 1 accuracies that were asked for were delivered")
