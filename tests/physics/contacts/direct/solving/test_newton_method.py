"""What leads nowhere is given up soon, and what is known already is not found anew."""

import json

import numpy as np
import pytest

from sandbox.model.level import Level
from sandbox.model.level_catalog import find
from sandbox.model.loading import load, parse
from sandbox.physics.contacts.direct.complementarity import (
    mixed_complementarity,
)
from sandbox.physics.contacts.direct.rows.row_layout import Layout
from sandbox.physics.contacts.direct.solving import newton_method, overlap_correction
from sandbox.physics.run import build
from tests.physics.scenes import GRAVITY, box, fixed, level


def capstan(knot: str, place: tuple[str, int | str], value: float) -> Level:
    """Return the capstan with one number of a knot of its rope changed."""
    level = json.loads(find("machines/capstan").read_text("utf-8"))
    part, key = place
    level["bodies"][knot][part][key] = value
    level["effects"]["contact"]["overlaps"] = True
    return parse(json.dumps(level))


def counted(patch: pytest.MonkeyPatch, module: object, name: str) -> list[None]:
    """Return a list that grows by one with each call of a module's function."""
    calls: list[None] = []
    called = getattr(module, name)

    def count(*given: object, **named: object) -> object:
        calls.append(None)
        return called(*given, **named)

    patch.setattr(module, name, count)
    return calls


@pytest.mark.sweep
def test_what_comes_back_to_what_held_and_gains_nothing_goes_in_circles(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A knot of half the radius: 636 solutions before, and the drifts are as finely divided."""
    solutions = counted(monkeypatch, newton_method, "solve_rows")

    build(capstan("knot14", ("shape", "radius"), 0.02)).advance(8)

    assert len(solutions) < 450


def test_an_overlap_that_cannot_be_taken_back_is_tried_once_while_bodies_are_held(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A knot inside the drum, and twenty kicks until the others have settled: 20 before."""
    tries = counted(monkeypatch, overlap_correction, "newton")

    build(capstan("knot21", ("position", 1), 0.0))

    assert len(tries) == 1


def test_forces_that_change_smoothly_are_foretold_for_one_solution_a_step(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """120 solutions, begun with the forces of the last step."""
    crane = build(load(find("machines/crane")))
    solutions = counted(monkeypatch, newton_method, "solve_rows")

    crane.advance(60)

    assert len(solutions) < 70


def test_what_has_settled_is_not_solved_again_because_something_else_moves(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """One rope rests on its drum, the other slips: 90 solutions for the two of them before."""
    capstans = build(load(find("hard/two-capstans")))
    solutions = counted(monkeypatch, newton_method, "solve")

    capstans.advance(15)

    assert len(solutions) < 55  # 47


@pytest.mark.sweep
def test_the_impact_of_a_landing_begins_with_what_held_before_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A wall that comes down: 4.4 systems a problem, guessed from the rates alone."""
    wall = build(load(find("machines/wrecking-ball")))
    problems = counted(monkeypatch, newton_method, "solve")
    systems = counted(monkeypatch, mixed_complementarity, "solved")

    wall.advance(170)

    assert len(systems) < 4 * len(problems)


def test_rows_that_all_hang_together_are_solved_as_if_they_were_picked(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """One car on its four contacts, its joints among them: the same to the last bit."""
    name = find("machines/car-over-bumps")
    whole = build(load(name)).advance(120)
    monkeypatch.setattr(Layout, "hangs_together", False)
    picked = build(load(name)).advance(120)

    assert np.array_equal(whole.position, picked.position)
    assert np.array_equal(whole.velocity, picked.velocity)


def test_friction_takes_no_part_where_an_overlap_is_taken_back(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Its rows had bounds of 0, and were switched on and off before."""
    effects = {
        **GRAVITY,
        "contact": {"solver": "direct", "overlaps": True},
        "friction": {},
        "rotation": {},
    }
    ground = fixed({"type": "box", "width": 9, "height": 1}, (0, -0.5), friction=1)
    boxes = {"low": box((0, 0.249), friction=0.5), "high": box((0.1, 0.748), friction=0.5)}
    pile = build(level({"ground": ground, **boxes}, effects))
    slipping: list[bool] = []
    take_back = newton_method.newton

    def watched(*given: object) -> object:
        impulse, way, active = take_back(*given)  # type: ignore[arg-type]
        slipping.append(bool(active.slip.any()))
        return impulse, way, active

    monkeypatch.setattr(overlap_correction, "newton", watched)
    pile.advance(9)

    assert slipping
    assert not any(slipping)
