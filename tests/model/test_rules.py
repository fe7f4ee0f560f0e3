# ruff: noqa: E501 (a table is read by its rows)
"""Contradictions in a level are reported by name, and nothing else is."""

from collections.abc import Callable
from itertools import product

import pytest

from sandbox.model.errors import MAX_MISTAKES
from sandbox.model.level_parts import expressions
from sandbox.model.rules.level_validation import broken, corners, depending
from tests.model.levels import (
    Change,
    Data,
    bare,
    hanging,
    level,
    mistakes,
    said,
    setting,
    touching,
)

BURNING = {"body": "ball", "exhaust": [0, -5], "rate": "m", "propellant": "m/2"}
HILL = {"body": "ball", "potential": "m*x**2", "x": [-1, 1], "y": [-3, "-m/2"]}
BELT = {"body": "floor", "velocity": ["m", 0]}
CONTACT_EVENT = {"event": "contact", "bodies": ["ball", "floor"]}


def parameter(value: float = 1, low: float = 0, high: float = 2) -> dict[str, float]:
    return {"value": value, "min": low, "max": high}


@pytest.mark.parametrize(
    "data", [bare(), touching(), hanging()], ids=["bare", "touching", "hanging"]
)
def test_a_sound_level_has_no_mistakes(data: Data) -> None:
    assert mistakes(data) == ()


@pytest.mark.parametrize(
    "change",
    [
        setting("view", {"center": [0, "g"]}),
        setting("bodies.ball.velocity", [1, 2]),
        setting("bodies.ball.angular_velocity", 0),
        setting("bodies.ball.moment", None),
        setting("checks.0.at", 1),
        setting("checks.0.at", {"event": "apex", "body": "ball"}),
        setting("checks.0.at", {"event": "landing", "body": "ball", "height": "-m"}),
        setting("checks.0.at", {"event": "crossing", "quantity": "ball.speed", "value": "m"}),
        setting("checks.0.formula", "1/t"),
    ],
)
def test_what_is_allowed_is_not_a_mistake(change: Change) -> None:
    assert mistakes(bare(), change) == ()


def test_a_parameter_may_change_the_picture_only() -> None:
    zoom = setting("parameters.zoom", parameter(low=0.5))

    assert mistakes(bare(), zoom, setting("view", {"width": "4*zoom"})) == ()


def test_the_place_in_a_landscape_is_no_parameter() -> None:
    named = setting("parameters.x", parameter()), setting("bodies.ball.position", ["x", 0])

    found = said(mistakes(bare(), *named, setting("view", {"landscape": HILL})))

    assert found == [
        "parameters.x: 'x' is the position in the landscape's potential; choose another name"
    ]


@pytest.mark.parametrize(
    ("data", "path", "value", "expected"),
    [
        # parameters
        (bare, "parameters.x", parameter(), "parameters.x: 'x' is declared but nothing uses it"),
        (bare, "parameters.m.value", 9, "parameters.m.value: must lie between 'min', 1, and 'max', 4"),
        (bare, "parameters.m.min", 9, "parameters.m.min: must not be greater than 'max', 4"),
        (bare, "parameters.pi", parameter(), "parameters.pi: 'pi' already has a meaning"),
        (bare, "parameters.t", parameter(), "parameters.t: 't' already has a meaning"),
        (bare, "parameters.sin", parameter(), "parameters.sin: 'sin' already has a meaning"),
        (bare, "parameters.lambda", parameter(), "parameters.lambda: 'lambda' already has a meaning"),
        (bare, "bodies.ball.mass", "n", "bodies.ball.mass: unknown parameter 'n'"),
        (bare, "bodies.ball.mass", "G", "bodies.ball.mass: unknown parameter 'G'; did you mean 'g'?"),
        (bare, "bodies.ball.mass", "t + 1", "bodies.ball.mass: the time 't' has no meaning here"),
        (bare, "effects.gravity.acceleration", [0, -9.81], "parameters.g: only checks, ghosts or the landscape use 'g'"),
        # names
        (bare, "ghosts", {"bal": [0, 0]}, "ghosts.bal: unknown body 'bal'; did you mean 'ball'?"),
        (hanging, "joints.string.ends", ["ball", "othr"], "joints.string.ends.1: unknown body 'othr'; did you mean 'other'?"),
        (hanging, "joints.string.ends", ["ball", "ball"], "joints.string.ends: 'ball' is connected to itself"),
        (hanging, "joints.ball", hanging()["joints"]["string"], "joints.ball: 'ball' is already the name of a body"),
        (hanging, "joints.system", hanging()["joints"]["string"], "joints.system: 'system' is all bodies together"),
        (bare, "bodies.t", bare()["bodies"]["ball"], "bodies.t: 't' is the time"),
        # checks
        (bare, "checks.0.quantity", "ball.hight", "checks.0.quantity: 'ball.hight' is not a quantity"),
        (bare, "checks.0.quantity", "bal.speed", "checks.0.quantity: 'bal.speed' is not a quantity of this level; did you mean 'ball.speed'?"),
        (bare, "checks.0.quantity", "ball.contact.normal", "'ball.contact.normal' is used but the effect 'contact' is not declared"),
        (bare, "checks.0.formula", "1/(m - m)", "checks.0.formula: '1/(m - m)' has no finite value"),
        (bare, "checks.0.formula", "t + 1/0", "checks.0.formula: 't + 1/0' divides by zero"),
        (bare, "checks.0.valid_if", "t > 0.5", "checks.0.valid_if: is a condition on the parameters; it cannot depend on the time 't'"),
        (bare, "checks.0.scale", "m - 9", "checks.0.scale: 'm - 9' is -7, but must be greater than 0"),
        (bare, "checks.0.valid_if", "m + 1/0 > 1", "checks.0.valid_if: 'm + 1/0 > 1' divides by zero"),
        (bare, "checks.0.at", 5, "checks.0.at: is at 5 s, but the run lasts from 0 to 1 s"),
        (bare, "checks.0.at", -1, "checks.0.at: is at -1 s"),
        (bare, "checks.0.at", {"event": "apex", "body": "bal"}, "checks.0.at.body: unknown body 'bal'"),
        (bare, "checks.0.at", {"event": "crossing", "quantity": "x"}, "checks.0.at.quantity: 'x' is not a quantity"),
        (touching, "checks.0.at", {**CONTACT_EVENT, "bodies": ["ball", "ball"]}, "checks.0.at.bodies: 'ball' is named twice"),
        (touching, "checks.0.at", {"event": "apex", "body": "floor"}, "checks.0.at.body: 'floor' is static, so its apex never happens"),
        (touching, "checks.0.at", {"event": "landing", "body": "floor"}, "'floor' is static, so its landing never happens"),
        (bare, "stepping", {"accuracy": 1e-20}, "stepping.accuracy: an accuracy of 1e-20 is below rounding; it must be at least 1e-14"),
        (bare, "stepping", {"accuracy": 1e-14}, None),
        # landscapes
        (bare, "view", {"landscape": {**HILL}}, None),
        (bare, "view", {"landscape": {**HILL, "body": "bal"}}, "view.landscape.body: unknown body 'bal'; did you mean 'ball'?"),
        (touching, "view", {"landscape": {**HILL, "body": "floor"}}, "view.landscape.body: 'floor' is static, so it has no energy to draw"),
        (bare, "view", {"landscape": {**HILL, "potential": "m*t"}}, "view.landscape.potential: the time 't' has no meaning here"),
        (bare, "view", {"landscape": {**HILL, "potential": "1/x"}}, "view.landscape.potential: '1/x' has no finite value at x = 0 m"),
        (bare, "view", {"landscape": {**HILL, "potential": "sqrt(m - 2)*x"}}, "'sqrt(m - 2)*x' has no finite value at x = -1 m when m = 1"),
        (bare, "view", {"landscape": {**HILL, "potential": "x + 1/0"}}, "view.landscape.potential: 'x + 1/0' divides by zero"),
        (bare, "view", {"landscape": {**HILL, "x": ["m - 3", 0]}}, "view.landscape.x: must increase, but goes from 1 m to 0 m when m = 4"),
        (bare, "view", {"landscape": {**HILL, "y": [2, 2]}}, "view.landscape.y: must increase, but goes from 2 m to 2 m"),
        (bare, "view", {"landscape": {**HILL, "x": ["x", 9]}}, "view.landscape.x.0: unknown parameter 'x'"),
        # bodies and joints
        (bare, "bodies.ball.mass", None, "bodies.ball: a dynamic body needs a mass"),
        (touching, "bodies.floor.mass", 1, "bodies.floor.mass: a static body has no mass"),
        (touching, "bodies.floor.velocity", [1, 0], "bodies.floor.velocity: a static body has no velocity"),
        (touching, "bodies.floor.angular_velocity", 1, "a static body has no angular velocity"),
        (hanging, "bodies.ball.type", "kinematic", "bodies.ball.mass: a kinematic body has no mass"),
        (hanging, "joints.string.length", 8, None),
        (hanging, "joints.string.length", 7, "joints.string.length: the string is 7 m long, but its path is 8 m"),
        # effects
        (bare, "effects.contact", {}, "effects.contact: 'contact' is declared but there is only one body that can touch another"),
        (bare, "effects.rotation", {}, "effects.rotation: 'rotation' is declared but nothing turns a body"),
        (hanging, "effects.rotation", {}, "effects.rotation: 'rotation' is declared but nothing turns a body"),
        (bare, "effects", {"gravitation": {"constant": 1}}, "effects.gravitation: 'gravitation' acts between bodies, but 'ball' is the only one"),
        (hanging, "effects.gravitation", {"constant": 1}, None),
        (hanging, "effects.gravitation", {"constant": 1, "softening": -1}, "effects.gravitation.softening: is -1, but must be at least 0"),
        (hanging, "effects.gravitation", {"constant": 1, "bodies": ["ball"]}, "effects.gravitation.bodies"),
        (hanging, "effects.gravitation", {"constant": 1, "bodies": ["ball", "othr"]}, "effects.gravitation.bodies.1: unknown body 'othr'; did you mean 'other'?"),
        (hanging, "effects.gravitation", {"constant": 1, "bodies": ["ball", "ball"]}, "effects.gravitation.bodies: a body is named twice"),
        (bare, "effects.friction", {}, "effects.friction: 'friction' needs the effect 'contact'"),
        (bare, "effects.restitution", {}, "effects.restitution: 'restitution' is declared but no body has"),
        (bare, "bodies.ball.friction", 0.1, "bodies.ball.friction: 'friction' is used but the effect 'friction' is not declared"),
        (bare, "bodies.ball.restitution", 0.1, "'restitution' is used but the effect 'restitution' is not declared"),
        (bare, "bodies.ball.angular_velocity", 1, "'angular_velocity' is used but the effect 'rotation' is not declared"),
        (bare, "bodies.ball.moment", 1, "'moment' is used but the effect 'rotation' is not declared"),
        (touching, "bodies.ball.friction", None, "bodies.ball: needs a 'friction' coefficient"),
        (touching, "effects.friction", {"pairs": [{"bodies": ["ball", "flor"], "coefficient": 1}]}, "effects.friction.pairs.0.bodies.1: unknown body 'flor'; did you mean 'floor'?"),
        (touching, "effects.friction", {"pairs": 2 * [{"bodies": ["ball", "floor"], "coefficient": 1}]}, "effects.friction.pairs.1: the pair ball and floor already has a coefficient"),
        (bare, "effects.thrust", [BURNING], None),
        (bare, "effects.thrust", [{**BURNING, "propellant": "0.5*m + 1"}], "effects.thrust.0.propellant: 'ball' burns 2 kg, but its whole mass is 2 kg"),
        (bare, "effects.thrust", [{**BURNING, "propellant": "m - 1"}], "effects.thrust.0.propellant: 'm - 1' is 0, but must be greater than 0 when m = 1"),
        (bare, "effects.thrust", [{**BURNING, "propellant": "1.5"}], "effects.thrust.0.propellant: 'ball' burns 1.5 kg, but its whole mass is 1 kg when m = 1"),
        (bare, "effects.thrust", 2 * [{**BURNING, "propellant": "0.5*m"}], "effects.thrust.1.propellant: 'ball' burns 2 kg, but its whole mass is 2 kg"),
        (bare, "effects.thrust", [{**BURNING, "body": "bal"}], "effects.thrust.0.body: unknown body 'bal'; did you mean 'ball'?"),
        (touching, "effects.thrust", [{**BURNING, "body": "floor"}], "effects.thrust.0.body: 'floor' is static, so no force moves it"),
        (touching, "effects.accretion", [{"body": "floor", "rate": 1}], "effects.accretion.0.body: 'floor' is static"),
        (bare, "effects.accretion", [{"body": "ball", "rate": 1}], None),
        (hanging, "effects.thrust", [BURNING], "joints.string.ends: the mass of 'ball' changes, so only a spring can hold it"),
        (touching, "effects.belt", [BELT], None),
        (bare, "effects.belt", [{**BELT, "body": "ball"}], "effects.belt.0: 'belt' needs the effect 'friction'"),
        (bare, "effects.belt", [{**BELT, "body": "ball"}], "effects.belt.0: 'belt' needs the effect 'contact'"),
        (touching, "effects.belt", [{**BELT, "body": "ball"}], "effects.belt.0.body: 'ball' is dynamic, but a belt is static or kinematic"),
        (touching, "effects.belt", [{**BELT, "body": "flor"}], "effects.belt.0.body: unknown body 'flor'; did you mean 'floor'?"),
        (touching, "effects.belt", [BELT, BELT], "effects.belt.1.body: 'floor' is a belt already"),
        (touching, "bodies.ball.static_friction", 1, None),
        (touching, "bodies.ball.static_friction", 0.9, "bodies.ball.static_friction: is 0.9, less than the kinetic coefficient of 1"),
        (touching, "bodies.ball.static_friction", "m/2", "bodies.ball.static_friction: is 0.5, less than the kinetic coefficient of 1 when m = 1"),
        (bare, "bodies.ball.static_friction", 1, "bodies.ball.static_friction: needs 'friction', too"),
        (touching, "effects.friction", {"pairs": [{"bodies": ["ball", "floor"], "coefficient": 1, "static": 0.5}]}, "effects.friction.pairs.0.static: is 0.5, less than the kinetic coefficient of 1"),
    ],
)  # fmt: skip
def test_a_contradiction_is_told_where_it_is(
    data: Callable[[], Data], path: str, value: object, expected: str | None
) -> None:
    found = said(mistakes(data(), setting(path, value)))

    assert any(expected in mistake for mistake in found) if expected else not found


@pytest.mark.parametrize(
    ("changed", "expected"),
    [
        ({"shape": {"type": "disc", "radius": 1}}, "'floor' is round, but a belt has straight"),
        ({"type": "kinematic", "angular_velocity": 1}, "'floor' turns, but a belt keeps"),
    ],
)
def test_what_is_round_or_turns_is_no_belt(changed: Data, expected: str) -> None:
    data = touching()
    data["bodies"]["floor"] |= changed

    (mistake,) = mistakes(data, setting("effects.belt", [BELT]))

    assert mistake.path == "effects.belt.0.body"
    assert expected in mistake.rule


@pytest.mark.parametrize("name", ["gravity", "attraction"])
def test_an_effect_without_a_dynamic_body_is_told(name: str) -> None:
    effect = {"gravity": bare()["effects"]["gravity"], "attraction": [{"mu": "g"}]}[name]
    still = {"type": "static", "shape": {"type": "disc", "radius": "m"}}

    found = mistakes(bare(), setting("effects", {name: effect}), setting("bodies.ball", still))

    assert said(found) == [f"effects.{name}: '{name}' is declared but no body is dynamic"]


def test_a_first_contact_needs_bodies_that_touch() -> None:
    data = touching()
    data["effects"] = bare()["effects"]
    for body in data["bodies"].values():
        del body["friction"], body["restitution"]

    found = mistakes(data, setting("checks.0.at", CONTACT_EVENT))

    assert said(found) == [
        "checks.0.at.event: 'contact' is used but the effect 'contact' is not declared"
    ]


@pytest.mark.parametrize(
    ("path", "value", "expected"),
    [
        ("bodies.ball.mass", "m - 1", "'m - 1' is 0, but must be greater than 0 when m = 1"),
        ("bodies.ball.mass", "4 - m", "'4 - m' is 0, but must be greater than 0 when m = 4"),
        ("bodies.ball.mass", "m - g", "is -7.81, but must be greater than 0 when g = 9.81, m = 2"),
        ("bodies.ball.position", [0, "m/g"], "'m/g' is inf, not a finite number when g = 0, m = "),
        ("duration", "g", "'g' is 0, but must be greater than 0 when g = 0"),
    ],
)
def test_a_value_must_be_possible_at_the_ends_of_the_ranges(
    path: str, value: object, expected: str
) -> None:
    [mistake] = mistakes(bare(), setting(path, value), setting("view", {"center": ["m", 0]}))

    assert expected in mistake.rule


@pytest.mark.parametrize(
    ("center", "power", "refused"),
    [([0, 0], 2, True), (["m - 1", 0], 2, True), ([0, 0], 0, True), ([0, 0], -1, False), ([0, 1], 2, False)],
)  # fmt: skip
def test_nothing_starts_at_a_centre_of_attraction(
    center: list[object], power: float, *, refused: bool
) -> None:
    """There the force has no direction, unless it vanishes, like a spring's."""
    sun = setting("effects.attraction", [{"mu": 1, "center": center, "power": power}])

    found = said(mistakes(bare(), sun))

    assert bool(found) == refused
    assert all("effects.attraction.0.center: 'ball' starts at the centre" in f for f in found)


def test_a_velocity_without_a_value_does_not_hide_that_a_body_starts_at_a_centre() -> None:
    sun = setting("effects.attraction", [{"mu": 1, "center": [0, 0]}])
    fast = setting("bodies.ball.velocity", ["log(0*m)", 0])

    found = said(mistakes(bare(), sun, fast))

    assert any("'ball' starts at the centre" in f for f in found)
    assert len(found) > 1


def test_bodies_that_attract_each_other_cannot_start_at_one_place() -> None:
    pulls = setting("effects.gravitation", {"constant": 1})
    soft = setting("effects.gravitation", {"constant": 1, "softening": 0.1})
    meets = setting("bodies.other.position", ["m - 2", 0]), setting("joints", {})

    [mistake] = mistakes(hanging(), pulls, *meets)

    assert mistake.path == "effects.gravitation"
    both = (
        "'gravitation' acts between 'ball' and 'other', which start at the same position; move one"
    )
    assert mistake.rule.startswith(f"{both}, or add a 'softening'")
    assert mistake.rule.endswith("when m = 1")
    assert mistakes(hanging(), soft, *meets) == ()


def test_a_polygon_must_be_simple_at_the_ends_of_the_ranges() -> None:
    vertices = [[0, 0], [1, 0], ["m - 1.5", 1], [0, 1]]

    [mistake] = mistakes(
        bare(), setting("bodies.ball.shape", {"type": "polygon", "vertices": vertices})
    )

    assert mistake.path == "bodies.ball.shape"
    assert "crosses itself" in mistake.rule
    assert mistake.rule.endswith("when m = 1")


def driven(formula: str) -> Change:
    return setting("effects.force", [{"body": "ball", "force": [formula, 0]}])


def reeled(length: str) -> Change:
    rod = {"type": "rod", "ends": [[0, -3], "ball"], "length": length}
    return setting("joints", {"reel": rod})


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (driven("sqrt(0.5 - t)"), "effects.force.0.force.0: 'sqrt(0.5 - t)' has no finite value at t = 0.517 s"),
        (driven("log(t)"), "'log(t)' has no finite value at t = 0 s"),
        (driven("1/(t - 0.25)"), "'1/(t - 0.25)' has no finite value at t = 0.25 s"),
        (driven("sqrt(3.5 - m - t/4)"), "has no finite value at t = 0 s when m = 4"),
        (reeled("sqrt(9 - 20*t)"), "joints.reel.length: 'sqrt(9 - 20*t)' has no finite value at t = 0.467 s"),
        (reeled("3 - 6*t"), "the rod is 0 m long at t = 0.5 s"),
        (reeled("3 if t < 0.601 else 2"), "the rod's length jumps by 1 m at t = 0.601 s; it must change gradually"),
        (reeled("3 - 1e-3*floor(2*t)"), "the rod's length jumps by 0.001 m at t = 0.5 s"),
    ],
)  # fmt: skip
def test_what_acts_has_a_value_as_long_as_a_run_lasts(change: Change, expected: str) -> None:
    [found] = said(mistakes(bare(), change))

    assert expected in found


@pytest.mark.parametrize(
    "change",
    [
        driven("sqrt(1 - t)"),
        driven("1 if t < 0.5 else 0"),
        reeled("3 - sqrt(t)"),
        reeled("3 + tanh((t - 0.5)/0.01) - tanh(-50)"),
    ],
)
def test_what_is_only_steep_may_act(change: Change) -> None:
    assert mistakes(bare(), change) == ()


def test_a_formula_need_not_have_a_value_where_it_is_not_valid() -> None:
    formula = setting("checks.0.formula", "sqrt(g - 10*m)")

    assert mistakes(bare(), formula)
    assert mistakes(bare(), formula, setting("checks.0.valid_if", "g > 10*m")) == ()


def test_what_the_parameters_make_impossible_between_the_ends_is_found_for_them() -> None:
    made = level(bare(), setting("bodies.ball.position", ["1/(m - 3)", 0]))

    assert not list(broken(depending(made), {"m": 2, "g": 1}))
    [fault] = broken(depending(made), {"m": 3, "g": 1})
    assert fault.path == ("bodies", "ball", "position", 0)


def test_corners_are_the_defaults_and_all_combinations_of_the_bounds() -> None:
    found = [(values["m"], values["g"]) for values in corners(level(bare()))]

    assert found[0] == (2.0, 9.81)
    assert found[1:] == list(product((1.0, 4.0), (0.0, 25.0)))


def test_of_many_parameters_each_reaches_both_bounds() -> None:
    names = [f"p{i}" for i in range(20)]
    many = {name: parameter(0, -1, 1) for name in names}
    data = bare()
    data["parameters"] |= many
    data["bodies"]["ball"]["position"] = ["+".join(names), 0]

    found = list(corners(level(data), names))

    assert len(found) < 100
    for name in names:
        assert {values[name] for values in found} == {-1, 0, 1}


def test_every_expression_is_found_with_its_path() -> None:
    found = dict(expressions(level(bare())))

    assert found["bodies", "ball", "mass"].source == "m"
    assert found["effects", "gravity", "acceleration", 1].source == "-g"
    assert found["checks", 0, "formula"].variables == ("t",)
    assert found["ghosts", "ball", 1].names == {"g", "t"}


def test_mistakes_are_listed_up_to_a_limit() -> None:
    ghosts = {f"ghost{i}": [0, 0] for i in range(10 * MAX_MISTAKES)}

    found = mistakes(bare(), setting("ghosts", ghosts))

    assert len(found) == MAX_MISTAKES + 1
    assert "and more" in found[-1].rule


def test_contradictions_and_impossible_values_are_told_together() -> None:
    def change(data: Data) -> None:
        data["bodies"]["ball"] |= {"friction": 0.5, "mass": "m - 1"}

    assert {mistake.path for mistake in mistakes(bare(), change)} == {
        "bodies.ball.friction",
        "bodies.ball.mass",
    }


def test_a_run_of_years_is_refused() -> None:
    (mistake,) = mistakes(bare(), lambda data: data.update(duration=1e12))

    assert mistake.path == "duration"
    assert "10,000,000 are allowed" in mistake.rule


@pytest.mark.parametrize("thin", [1e-9, 1e-7, 0.0])
def test_a_polygon_too_thin_to_collide_is_refused(thin: float) -> None:
    def change(data: Data) -> None:
        vertices = [[0, 0], [1, 0], [2, thin]]
        data["bodies"]["ball"]["shape"] = {"type": "polygon", "vertices": vertices}

    (mistake,) = mistakes(bare(), change)

    assert mistake.path == "bodies.ball.shape"
