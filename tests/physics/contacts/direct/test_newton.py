"""What leads nowhere is given up soon: a rope on a drum, with one part that fits in nowhere."""

import json

import pytest

from sandbox.model.catalog import find
from sandbox.model.level import Level
from sandbox.model.loading import parse
from sandbox.physics.contacts.direct import newton, overlap_correction
from sandbox.physics.run import build


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


def test_what_comes_back_to_what_held_and_gains_nothing_goes_in_circles(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A knot of half the radius: 636 solutions before, and the drifts are as finely divided."""
    solutions = counted(monkeypatch, newton, "solve_rows")

    build(capstan("knot14", ("shape", "radius"), 0.02)).advance(8)

    assert len(solutions) < 450


def test_an_overlap_that_cannot_be_taken_back_is_tried_once_while_bodies_are_held(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A knot inside the drum, and twenty kicks until the others have settled: 20 before."""
    tries = counted(monkeypatch, overlap_correction, "newton")

    build(capstan("knot21", ("position", 1), 0.0))

    assert len(tries) == 1
