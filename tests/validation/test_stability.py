"""The hard cases: their machinery, some of them run to the end, and pymunk where it fails."""

import json
from collections.abc import Iterator
from dataclasses import replace
from math import inf, nan
from pathlib import Path

import numpy as np
import pymunk
import pytest
from typer.testing import CliRunner

from sandbox.model import level_catalog
from sandbox.model.level_writing import text
from sandbox.physics.run import build
from validation import cli
from validation.stability import command, frontier_history, run_all_cases
from validation.stability.families import (
    all_cases,
    all_frontiers,
    all_levels,
    chains,
    contact_and_joint_coupling,
    cradles,
)
from validation.stability.frontier import furthest, reach, step_cost, trial
from validation.stability.hard_case import Frontier, HardCase, make, watch
from validation.stability.report import failures, out_of_reach
from validation.stability.run_all_cases import Outcome, run_case, run_frontier
from validation.stability.run_measures import drift, separation
from validation.stability.stock_pymunk import naive
from validation.stability.write_hard_levels import FOLDER

CASES = {case.name: case for case in all_cases()}
FRONTIERS = {frontier.name: frontier for frontier in all_frontiers()}

CRADLE = "a cradle of five, 1 in, gap 0 m"
FIELDS = {
    "name", "family", "passed", "figure", "bound", "criterion", "frontier", "naive_frontier",
    "seconds",
}  # fmt: skip


def outcome(**changes: object) -> Outcome:
    whole = Outcome("x", "f", "A", "it holds", 1.0, None, passed=True, figure=0.5)
    return replace(whole, **changes)  # type: ignore[arg-type]


def test_cases_and_frontiers_have_names_of_their_own() -> None:
    names = [c.name for c in all_cases()] + [f.name for f in all_frontiers()]
    assert len(set(names)) == len(names)
    assert len(CASES) >= 40
    assert len(FRONTIERS) >= 12


def test_every_hard_level_has_a_case_and_every_case_a_level() -> None:
    known = level_catalog.names()
    used = {case.level for case in CASES.values()}

    assert used <= set(known)
    assert {name for name in known if name.startswith("hard/")} <= used


def test_the_levels_are_as_their_scenes_make_them() -> None:
    for name, scene in all_levels().items():
        assert (FOLDER / f"{name}.json").read_text(encoding="utf-8") == text(scene()), name


@pytest.mark.parametrize("limit", [1.0, 1.5, 37.0, 990.0])
def test_the_search_finds_where_a_bound_breaks(limit: float) -> None:
    tried: list[float] = []

    def holds(difficulty: float) -> bool:
        tried.append(difficulty)
        return difficulty <= limit

    found = furthest(holds, 1, 1000)

    assert limit / 1.08 <= found <= limit
    assert len(tried) <= 13


@pytest.mark.parametrize("limit", [2, 3, 17, 49])
def test_the_search_finds_whole_numbers_exactly(limit: int) -> None:
    assert furthest(lambda n: n <= limit, 2, 50, whole=True) == limit


def test_a_search_ends_where_it_is_told_to_and_says_if_nothing_holds() -> None:
    assert furthest(lambda _: True, 1, 1000) == 1000
    assert furthest(lambda _: False, 1, 1000) == 0


def test_the_search_stops_at_the_first_failure_that_it_sees() -> None:
    """A difficulty beyond it that holds by luck does not count."""
    assert furthest(lambda x: x < 5 or x > 100, 1, 1000) < 5


def test_a_frontier_that_lies_further_in_fails_and_further_out_does_not() -> None:
    before = frontier_history.Entry(date="2026-01-01", version="0", figure=100.0, naive=10.0)

    assert frontier_history.moved_inward(79, before, 1.25)
    assert not frontier_history.moved_inward(81, before, 1.25)
    assert not frontier_history.moved_inward(1e6, before, 1.25)
    assert not frontier_history.moved_inward(1, None, 1.25)


def test_the_history_grows_when_a_frontier_moves(tmp_path: Path) -> None:
    file = tmp_path / "frontiers.json"
    for figure, alone in ((100.0, 7.0), (100.0, 8.0), (140.0, 7.0), (140.0, 70.0)):
        frontier_history.update({"height": (figure, alone)}, file)

    entries = frontier_history.read(file)["height"]

    assert [(e["figure"], e["naive"]) for e in entries] == [(100, 7), (140, 7), (140, 70)]
    assert frontier_history.last(frontier_history.read(file), "height") == entries[-1]
    assert frontier_history.last(frontier_history.read(file), "length") is None
    assert frontier_history.read(tmp_path / "none.json") == {}


def test_every_frontier_is_written_down_and_none_behind_pymunk_without_a_reason() -> None:
    kept = frontier_history.read()

    assert kept.keys() == FRONTIERS.keys()
    for name, frontier in FRONTIERS.items():
        entry = kept[name][-1]
        assert entry["figure"] * 1.05 >= entry["naive"] or frontier.beyond, name


def test_loads_cradles_bullets_and_cars_reach_ten_times_as_far_as_pymunk() -> None:
    kept = frontier_history.read()
    for name in (
        "a load on 20 links",
        "a cradle that touches",
        "the speed of a bullet",
        "a car on light wheels",
    ):
        assert kept[name][-1]["figure"] >= 10 * kept[name][-1]["naive"], name


@pytest.mark.sweep
@pytest.mark.parametrize(
    "name",
    [
        "free fall, 2 s at 60 Hz",
        "the same naively: late by half a step",
        "Atwood 1 : 1,000,000",
        CRADLE,
        "100 : 1 on one box",
        "1000 : 1 on one box",
        "a damped spring",
        "a pyramid with overlaps of 25 %",
        "20 links with 1e5 times their mass: length",
        "1,000,000 : 1 on a strut",
        "a car of 10,000 times its wheels",
        "two capstans with ropes of 24 links",
        "dumbbells of 1,000,000 : 1",
    ],
)
def test_a_case_holds_to_its_end(name: str) -> None:
    found = run_case(name, quick=True)

    assert found.passed, found
    assert found.figure <= CASES[name].bound
    assert found.failure == ""


def test_a_second_order_case_is_seen_to_be_one() -> None:
    order = run_case("a damped spring", quick=True).order

    assert order is not None
    assert 1.9 <= order <= 2.1


def test_a_bound_that_is_missed_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    strict = replace(CASES["a damped spring"], bound=1e-9)
    monkeypatch.setattr(run_all_cases, "all_cases", lambda: iter([strict]))

    assert not run_case(strict.name, quick=True).passed


def test_a_run_that_has_to_stop_misses_its_bound_and_says_why(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    scene = chains.chain(20, 1e6, rate=500)
    taut = HardCase(
        name="too taut", family="chains", group="C", level="", criterion="", bound=1.0,
        figure=separation, scene=scene, duration=1,
    )  # fmt: skip
    monkeypatch.setattr(run_all_cases, "all_cases", lambda: iter([taut]))

    found = run_case(taut.name, quick=True)

    assert not found.passed
    assert found.figure == inf
    assert "a higher 'rate' may help" in found.failure


def test_pymunk_breaks_where_the_sandbox_holds() -> None:
    """A row of five touching balls: pymunk solves their impacts at once."""
    frontier = FRONTIERS["a cradle that touches"]

    here, alone = trial(frontier, 5), trial(frontier, 5, alone=True)

    assert here.figure <= frontier.bound
    assert alone.figure > 0.1


@pytest.mark.sweep
@pytest.mark.parametrize(
    ("name", "difficulty", "missed"),
    [
        ("a weight on a strut", 1e6, 1e-3),
        ("a rope round a drum", 12, 1),
        ("a stack solved directly", 2, 1e-6),
        ("a dumbbell that bounces", 10, 0.1),
    ],
)
def test_pymunk_misses_compositions_that_are_solved_together(
    name: str, difficulty: float, missed: float
) -> None:
    """At equal cost: a force by 1e-1, a rope's slip by several times, 6e-6 m, and 0.6 m/s."""
    frontier = FRONTIERS[name]

    here, alone = trial(frontier, difficulty), trial(frontier, difficulty, alone=True)

    assert here.figure <= frontier.bound
    assert alone.figure > missed


def test_pymunk_may_spend_what_the_sandbox_spends() -> None:
    """Its rate follows from the cost of a step: a second of the scene costs both the same."""
    frontier = FRONTIERS["a load on 20 links"]

    here = trial(replace(frontier, duration=0.01), 10)
    alone = trial(replace(frontier, duration=0.01), 10, alone=True)

    assert alone.rate > 2 * here.rate
    assert alone.rate <= 100_000


def test_under_a_clock_that_ticks_too_seldom_pymunk_gets_the_same_rate(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("validation.stability.frontier.process_time", lambda: 0.0)
    short = replace(FRONTIERS["a load on 20 links"], duration=0.01)

    assert trial(short, 10, alone=True).rate == trial(short, 10).rate


def test_pymunk_alone_has_its_own_joints() -> None:
    level = make(chains.chain(3))
    world = naive(level, 240)

    assert [type(c) for c in world.scene.space.constraints] == [pymunk.PinJoint] * 3
    assert watch(level, world, 0.5).world.hooks == 0
    assert separation(watch(level, build(level), 0.5)) < 1e-12


def test_pymunks_own_rail_is_a_groove() -> None:
    world = naive(make(contact_and_joint_coupling.strut(10)), 1000)
    joints = world.scene.space.constraints

    assert {type(c) for c in joints} == {pymunk.PinJoint, pymunk.GrooveJoint}
    last = world.advance(1000)
    assert last.position[2] == pytest.approx([0, 1.1], abs=1e-3)


def test_a_step_that_cannot_be_taken_has_no_cost() -> None:
    assert np.isnan(step_cost(lambda: build(make(chains.chain(20, 1e7, rate=100)))))


def test_the_time_for_which_a_bound_holds_is_found() -> None:
    """Balls that fly at 1 m/s are 0.25 m away after 0.25 s."""
    flying = Frontier(
        name="flies", family="x", axis="time", scene=lambda _: cradles.cradle(3, 3),
        figure=drift, bound=0.25, criterion="", start=0.1, end=1, over_time=True,
    )  # fmt: skip

    found = reach(flying)

    assert found.difficulty == pytest.approx(0.25, abs=1 / 120)
    assert found.figure <= 0.25


def test_a_quick_run_sees_whether_a_frontier_still_lies_where_it_did() -> None:
    found = run_frontier("a cradle that touches", quick=True)

    assert found.passed
    assert found.frontier == found.previous == 50


def test_what_is_out_of_reach_is_told_and_does_not_fail() -> None:
    lost = outcome(name="bullet", passed=False, figure=2.0, beyond="it is too fast")
    slow = outcome(name="speed", frontier=3.0, naive_frontier=30.0, beyond="Python is slow")
    broken = outcome(name="stack", passed=False)

    assert failures([outcome(), lost, slow]) == []
    assert failures([broken, lost]) == ["stack"]
    assert out_of_reach([outcome(), lost, slow]) == [
        "bullet: 2 of 1; it is too fast",
        "speed: 3 here, 30 for pymunk; Python is slow",
    ]


def test_nine_tenths_must_stand_below_real_time() -> None:
    stands = [outcome(name=f"c{i}", group="C", cost=0.5) for i in range(8)]
    slow = [outcome(name=f"s{i}", group="C", cost=1.5) for i in range(2)]

    assert failures([*stands, *stands, *stands, *slow]) == []
    assert failures([*stands, *slow]) == ["only 8 of 10 stand at a cost below real time"]


def few(*, quick: bool) -> Iterator[Outcome]:
    yield run_case(CRADLE, quick=quick)
    yield run_frontier("a cradle that touches", quick=True)


def test_the_command_prints_both_tables_and_writes_json(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(command, "outcomes", few)
    file = tmp_path / "out.json"

    result = CliRunner().invoke(cli.app, ["stability", "--quick", "--json", str(file)])

    assert result.exit_code == 0, result.output
    assert "pymunk, same cost" in result.stdout
    assert "1 of 1 cases hold." in result.stdout
    content = json.loads(file.read_text(encoding="utf-8"))
    assert content.keys() == {"environment", "cases"}
    assert all(case.keys() >= FIELDS for case in content["cases"])
    assert [case["frontier"] for case in content["cases"]] == [None, 50]


def test_a_case_that_fails_is_exit_status_1(monkeypatch: pytest.MonkeyPatch) -> None:
    def bad(*, quick: bool) -> Iterator[Outcome]:
        yield replace(next(few(quick=quick)), passed=False, figure=nan)

    monkeypatch.setattr(command, "outcomes", bad)

    result = CliRunner().invoke(cli.app, ["stability", "--quick"])

    assert result.exit_code == 1
    assert f"failed: {CRADLE}" in result.stderr


@pytest.mark.sweep
def test_frontiers_are_written_down_only_when_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(command, "outcomes", few)
    written: list[object] = []
    monkeypatch.setattr(frontier_history, "update", written.append)

    CliRunner().invoke(cli.app, ["stability"])
    assert written == []
    CliRunner().invoke(cli.app, ["stability", "--update"])

    assert written == [{"a cradle that touches": (50, pytest.approx(3, abs=2))}]
