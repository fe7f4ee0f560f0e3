"""Known set-ups are recognised, and what is suggested for them holds in a run."""

import pytest

from sandbox.editing.edits.field_values import make_parameter
from sandbox.editing.edits.moving_and_aligning import move
from sandbox.editing.suggested_checks import (
    MOST_MOVING,
    suggestions,
    with_suggestion,
    with_updated_checks,
)
from sandbox.editing.text_patches import put_all
from sandbox.model import level_catalog
from sandbox.model.loading import parse, read
from sandbox.physics.measuring.grading import grade
from sandbox.physics.run import simulate
from tests.editing.suggested_checks.set_ups import (
    MADE,
    atwood,
    capstan,
    cradle,
    damped,
    incline,
    row,
    seesaw,
    spring,
    tackle,
    walled,
)


def test_a_number_in_a_check_stands_as_a_number() -> None:
    """For example the acceleration of gravity, and not its text."""
    text = atwood(1, 2)
    (one,) = suggestions(parse(text))
    said = with_suggestion(text, parse(text), one)
    assert '"scale": 9.81' in said
    assert all(not isinstance(check.get("scale"), str) for check in one.checks)


@pytest.mark.sweep
@pytest.mark.parametrize(
    ("setup", "text"),
    [(setup, text) for setup, texts in MADE.items() for text in texts],
)
def test_a_set_up_is_recognised_and_its_checks_pass_on_a_run(setup: str, text: str) -> None:
    level = parse(text)
    found = [one for one in suggestions(level) if one.setup == setup]
    assert len(found) == 1, [one.setup for one in suggestions(level)]
    checked = parse(with_suggestion(text, level, found[0]))
    results = grade(simulate(checked))
    assert len(results) == len(found[0].checks)
    for result in results:
        assert result.verdict == "passed", (result.check, result)


@pytest.mark.sweep
def test_a_check_fails_where_the_scene_is_another_one() -> None:
    """A suggestion for masses of 2 and 3.7 does not hold for 2 and 3.8."""
    text = atwood(2, 3.7)
    checked = with_suggestion(text, parse(text), suggestions(parse(text))[0])
    other = put_all(checked, {("bodies", "disc2", "mass"): 3.8})
    assert {result.verdict for result in grade(simulate(parse(other)))} == {"failed"}


@pytest.mark.sweep
def test_a_suggestion_follows_the_parameters() -> None:
    text = make_parameter(atwood(2, 3), ("bodies", "disc1", "mass"), "m1")
    text = make_parameter(text, ("effects", "gravity", "acceleration", 1), "g")
    level = parse(text)
    checked = parse(with_suggestion(text, level, suggestions(level)[0]))
    results = grade(simulate(checked, {**checked.defaults, "m1": 2.2, "g": 9.0}))
    assert {result.verdict for result in results} == {"passed"}


@pytest.mark.parametrize(
    "text",
    [
        seesaw({-2: 0.8, 1.75: 0.5}, friction=0.1),  # they slip
        seesaw({-2: 0.8, -2.01: 0.2}),  # one lies in the other
        seesaw({}, discs={-2: 0.5}, friction=0.5),  # it rolls
        seesaw({-3.4: 0.9}),  # it tips over the end
    ],
)
def test_no_lever_is_seen_where_a_weight_does_not_turn_along(text: str) -> None:
    assert "lever" not in [one.setup for one in suggestions(parse(text))]


@pytest.mark.sweep
def test_a_lever_holds_with_any_weight() -> None:
    text = make_parameter(seesaw({-2: 0.8, 1.75: 0.5}), ("bodies", "box2", "mass"), "m")
    (one,) = suggestions(parse(text))
    text = with_suggestion(text, parse(text), one)
    assert all(holds(text, {"m": m}) for m in (1.3, 2.5, 12.0))


def test_no_oscillation_is_seen_where_a_damper_lets_a_body_creep() -> None:
    assert suggestions(parse(damped(40))) == []


def test_no_spring_pendulum_is_seen_that_would_meet_the_ground() -> None:
    assert suggestions(parse(spring(2, 6, 10))) == []


def test_what_is_checked_already_is_not_suggested_again() -> None:
    text = atwood(2, 3)
    level = parse(text)
    taken = with_suggestion(text, level, suggestions(level)[0])
    assert suggestions(parse(taken)) == []


@pytest.mark.parametrize("name", level_catalog.textbook()[::5])
def test_what_is_suggested_of_a_level_that_ships_can_be_taken(name: str) -> None:
    text = read(level_catalog.find(name))
    level = parse(text)
    for one in suggestions(level):
        assert len(parse(with_suggestion(text, level, one)).checks) == len(level.checks) + len(
            one.checks
        )


@pytest.mark.parametrize(
    ("name", "setup"),
    [
        ("newton/atwood", "Atwood machine"),
        ("newton/compound-pulley", "block and tackle"),
        ("machines/capstan", "capstan"),
        ("momentum/cradle", "Newton's cradle"),
        ("hard/cradle-of-five", "Newton's cradle"),
        ("newton/incline", "block on a slope"),
        ("newton/incline-that-holds", "block that a slope holds"),
        ("lagrange/simple-pendulum", "pendulum"),
        ("energy/spring-oscillator", "oscillator"),
        ("kinematics/free-fall", "falling body"),
    ],
)
def test_levels_that_ship_are_recognised_without_their_checks(name: str, setup: str) -> None:
    level = parse(read(level_catalog.find(name)))
    bare = level.model_copy(update={"checks": ()})
    assert setup in [one.setup for one in suggestions(bare)]


def test_a_block_that_was_moved_off_its_slope_is_none_any_more() -> None:
    text = incline(0.5)
    away = move(text, parse(text), ["box1"], (0, 0.5))
    assert [one.setup for one in suggestions(parse(away))] == ["falling body"]


def test_nothing_is_looked_for_among_a_crowd() -> None:
    bodies = ", ".join(
        f'"b{i}": {{"shape": {{"type": "disc", "radius": 0.1}}, "mass": 1, "position": [{i}, 0]}}'
        for i in range(MOST_MOVING + 1)
    )
    text = f'{{"format": 1, "title": "Crowd", "bodies": {{{bodies}}}}}'

    assert suggestions(parse(text)) == []


def with_checks(text: str) -> str:
    level = parse(text)
    return with_suggestion(text, level, suggestions(level)[0])


def holds(text: str, values: dict[str, float] | None = None) -> bool:
    level = parse(text)
    return all(one.verdict == "passed" for one in grade(simulate(level, values)))


@pytest.mark.sweep
def test_suggested_checks_follow_a_mass_that_becomes_a_parameter() -> None:
    text = with_checks(atwood(2, 3))
    changed = make_parameter(text, ("bodies", "disc2", "mass"), "m")
    assert not holds(changed, {"m": 5.0})
    changed = with_updated_checks(parse(text), changed)
    assert all(holds(changed, {"m": m}) for m in (0.6, 1.5, 2.0, 5.0, 15.0))


@pytest.mark.sweep
def test_checks_are_about_a_time_before_something_is_met_with_any_value() -> None:
    text = make_parameter(atwood(2, 2), ("bodies", "disc2", "mass"), "m")
    text = with_checks(text)
    assert all(holds(text, {"m": m}) for m in (0.4, 2.0, 10.0))


@pytest.mark.parametrize(
    "text",
    [
        tackle((-0.5, 8), (1, 8), (2, 8)),  # the wheel would swing
        tackle((-0.5, 8), (0.5, 8), (2.5, 8)),  # the box would
        put_all(tackle((0, 8), (0, 8), (2, 8)), {("bodies", "disc1", "velocity"): [0, 1]}),
        put_all(tackle((0, 8), (0, 8), (2, 8)), {("joints", "pulley1", "length"): 13}),
    ],
)
def test_no_tackle_is_seen_where_a_pull_is_not_upright_or_the_string_is_slack(text: str) -> None:
    assert "block and tackle" not in [one.setup for one in suggestions(parse(text))]


@pytest.mark.sweep
def test_a_tackle_holds_with_any_load() -> None:
    text = make_parameter(tackle((0, 8), (0, 8), (2, 8)), ("bodies", "box1", "mass"), "m")
    text = with_checks(text)
    assert all(holds(text, {"m": m}) for m in (2, 10, 30))


@pytest.mark.sweep
def test_a_capstan_says_of_each_load_whether_it_holds() -> None:
    text = make_parameter(capstan(5, 15, 0.25), ("bodies", "disc1", "friction"), "mu")
    level = parse(with_checks(text))
    verdicts = [{r.verdict for r in grade(simulate(level, {"mu": mu}))} for mu in (0.2, 0.5)]
    assert verdicts == [{"passed"}, {"not applicable"}]


@pytest.mark.parametrize(
    "text",
    [
        cradle(3, 3),  # nothing is struck
        put_all(cradle(3, 1), {("bodies", "disc2", "mass"): 9}),
        put_all(cradle(3, 1), {("bodies", "disc3", "restitution"): 0.9}),
        walled(cradle(3, 1), 4.2),
        row([2, 0, 2]),
    ],
)
def test_no_cradle_is_seen_where_balls_differ_or_nothing_strikes(text: str) -> None:
    assert "Newton's cradle" not in [one.setup for one in suggestions(parse(text))]


@pytest.mark.sweep
def test_a_slope_has_no_checks_of_sliding_where_it_holds() -> None:
    text = make_parameter(incline(0.5, 0.3), ("bodies", "box1", "friction"), "mu")
    level = parse(with_checks(text))
    assert all(check.valid_if is not None for check in level.checks)
    verdicts = {one.verdict for one in grade(simulate(level, {"mu": 0.9}))}
    assert "failed" not in verdicts


def test_suggested_checks_go_with_what_they_were_about() -> None:
    text = with_checks(atwood(2, 3))
    slanted = move(text, parse(text), ["disc1"], (0.5, 0.0))
    assert not parse(with_updated_checks(parse(text), slanted)).checks


def test_checks_that_somebody_has_changed_stay_as_they_are() -> None:
    text = put_all(with_checks(atwood(2, 3)), {("checks", 0, "tolerance"): 1e-6})
    changed = put_all(text, {("bodies", "disc2", "mass"): 4})
    after = parse(with_updated_checks(parse(text), changed))
    assert [check.tolerance for check in after.checks] == [1e-6, 1e-9, 1e-9]
    assert after.checks[0].formula == parse(text).checks[0].formula
    assert after.checks[1].formula != parse(text).checks[1].formula
