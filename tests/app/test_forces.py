"""Given forces as arrows, and the mouse that drags their tips."""

import json
from pathlib import Path

import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.stage.given_force_arrows import Arrow, Forces
from sandbox.editing.run_as_level import as_it_stands
from sandbox.model import level_catalog
from sandbox.model.loading import load
from sandbox.model.shapes import XY
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.run import build
from tests.app import scenes
from tests.app.person import Person
from validation.case import textbook

LEVEL = "newton/two-forces"


@pytest.fixture
def player(person: Person) -> Person:
    """A person in front of a box on which two forces act."""
    person.window.open_level(LEVEL)
    person.wait()
    return person


def tip(player: Person, newtons: XY, start: XY = (0.0, 0.0)) -> XY:
    """Return where the arrow of a force on a point of the plane ends in the window."""
    x, y = player.on_screen(start)
    scale = player.window.stage.newton
    return x + newtons[0] * scale, y - newtons[1] * scale


def near(player: Person, pixel: XY, reach: int = 3) -> set[tuple[int, int, int]]:
    """Return the colours around a pixel."""
    steps = range(-reach, reach + 1)
    return {player.color_at((pixel[0] + i, pixel[1] + j)) for i in steps for j in steps}


def half(newtons: XY, share: float = 0.7) -> XY:
    return newtons[0] * share, newtons[1] * share


def test_the_forces_are_seen_as_long_as_they_are(player: Person) -> None:
    first, second = theme.FORCES[:2]

    assert first in near(player, tip(player, half((3, 4))))
    assert second in near(player, tip(player, half((-1, 2))))
    assert first not in near(player, tip(player, half((3, 4), 1.3)))


def test_the_resultant_goes_to_the_tip_of_the_second_put_on_the_first(player: Person) -> None:
    assert theme.RESULTANT in near(player, tip(player, half((2, 6))))
    for share in (0.3, 0.5, 0.7):
        dashes = near(player, tip(player, (3 - share, 4 + 2 * share)), 6)
        assert max(red - green for red, green, _ in dashes) > 40


def test_a_tip_is_dragged_while_time_stands(player: Person) -> None:
    player.drag(tip(player, (3, 4)), tip(player, (-2, 5)))
    player.wait()

    values = player.session.values
    assert (values["F1x"], values["F1y"]) == pytest.approx((-2, 5), abs=0.11)
    assert (values["F2x"], values["F2y"]) == (-1, 2)
    assert player.session.world.steps == 0
    assert not player.session.playing
    assert not player.session.world.disturbed
    assert theme.FORCES[0] in near(player, tip(player, half((-2, 5))))
    shown = player.side.parameters.row("F1x").field.get_text()
    assert float(shown) == values["F1x"]


def test_a_tip_is_dragged_while_time_runs(player: Person) -> None:
    player.press(pygame.K_SPACE, " ")
    player.wait(0.3)
    x, y = player.session.world.snapshot.position[0].tolist()
    start, end = tip(player, (-1, 2), (x, y)), tip(player, (3, -4), (x, y))

    player.drag(start, end)
    player.wait(0.2)

    values = player.session.values
    # the box goes on while the mouse comes near, and so does the tip: some pixels
    assert (values["F2x"], values["F2y"]) == pytest.approx((3, -4), abs=0.11)
    assert player.session.playing
    assert 0 < player.session.t < 0.4
    assert player.session.readings()[0].result.verdict == "passed"


def test_a_force_stays_within_the_ranges_of_its_parameters(player: Person) -> None:
    player.drag(tip(player, (3, 4)), tip(player, (9, -9)))

    values, parameters = player.session.values, player.session.level.parameters
    assert (values["F1x"], values["F1y"]) == (parameters["F1x"].max, parameters["F1y"].min)


def test_a_click_on_a_tip_changes_nothing(player: Person) -> None:
    player.press(pygame.K_RIGHT)
    world = player.session.world
    place = player.session.world.snapshot.position[0].tolist()

    player.click(tip(player, (3, 4), (place[0], place[1])))

    assert player.session.world is world


def test_arrows_that_are_hidden_cannot_be_dragged(player: Person) -> None:
    player.press(pygame.K_v, "v")

    player.drag(tip(player, (3, 4)), tip(player, (0, 4)))

    assert player.session.values["F1x"] == 3
    assert theme.FORCES[0] not in near(player, tip(player, half((3, 4))))


def pushed(person: Person, folder: Path, force: list[object], **more: object) -> list[Arrow]:
    """Open a ball on which a force acts, and return what is drawn of it."""
    parameters = {
        "g": {"value": 10, "min": 0, "max": 20, "unit": "m/s²", "label": "gravity"},
        "mass": {"value": 1, "min": 0.5, "max": 2, "unit": "kg"},
        "F": {"value": 5, "min": 0, "max": 20, "unit": "N"},
    }
    effects = {
        "gravity": {"acceleration": [0, "-g"]},
        "force": [{"body": "ball", "force": force, **more}],
    }
    person.open(
        folder, scenes.falling(parameters=parameters, effects=effects, checks=[], ghosts={})
    )
    assert person.session.level.effects.force
    stage = person.window.stage
    x, y = person.on_screen((0, 5))
    left, top = person.window.panels.layout.stage.topleft
    at = [(5, 0), (0, 5), (-5, 0), (10, 0)]
    found = (
        stage.tip_at((x - left + fx * stage.newton, y - top - fy * stage.newton)) for fx, fy in at
    )
    return [arrow for arrow in found if arrow]


@pytest.mark.parametrize(
    ("force", "handles"),
    [
        (["F", 0], {0: "F"}),
        ([0, " F "], {1: "F"}),
        (["-F", 0], None),
        (["F*cos(0*t)", 0], None),
        ([5, "0*F"], None),
    ],
)
def test_only_components_that_are_parameters_and_no_more_are_dragged(
    person: Person, tmp_path: Path, force: list[object], handles: dict[int, str] | None
) -> None:
    found = pushed(person, tmp_path, force)

    assert [dict(arrow.handles) for arrow in found] == ([handles] if handles else [])


def test_a_force_along_one_axis_follows_the_mouse_along_it(person: Person, tmp_path: Path) -> None:
    pushed(person, tmp_path, ["F", 0])

    person.drag(tip(person, (5, 0), (0, 5)), tip(person, (9, 4), (0, 5)))

    assert person.session.values["F"] == pytest.approx(9, abs=0.11)


def test_a_force_that_the_run_alone_has_as_a_parameter_stays_as_it_is(
    person: Person, tmp_path: Path
) -> None:
    """Its level could not be restarted with it, which ended the window."""
    pushed(person, tmp_path, ["F", 0])
    session = person.session
    changed = json.loads(as_it_stands(session.world, anew=False).replace('"F"', '"G"'))
    session.alter(json.dumps(changed))
    assert "G" in session.values

    person.drag(tip(person, (5, 0), (0, 5)), tip(person, (9, 4), (0, 5)), let_go=False)

    assert session.values["G"] == 5
    person.press(pygame.K_r, "r")
    person.move(tip(person, (12, 4), (0, 5)))
    assert session.values == session.original.defaults


@pytest.mark.sweep
def test_no_level_draws_a_force_beyond_the_stage_at_the_start(person: Person) -> None:
    for name in level_catalog.names():
        if not textbook(name).effects.force:
            continue
        person.window.open_level(name)
        person.wait()
        stage = person.window.stage
        forces = person.session.level.effects.force or ()
        values = person.session.values
        t = person.session.world.snapshot.t
        sizes = [abs(float(part.over(values, t))) for f in forces for part in f.force]

        assert stage.newton > 0
        assert max(sizes) * stage.newton <= stage.camera.size[0] / 2, name


def test_a_velocity_is_taken_apart_into_its_components(person: Person) -> None:
    person.window.open_level("kinematics/components")
    person.wait()
    stage = person.window.panels.layout.stage

    def colors() -> set[tuple[int, int, int]]:
        left, top = (round(c) for c in person.on_screen((-1, 7)))
        right, bottom = (round(c) for c in person.on_screen((6, -1)))
        assert stage.contains((left, top, right - left, bottom - top))
        points = ((x, y) for x in range(left, right) for y in range(top, bottom))
        return {person.color_at(point) for point in points}

    assert {theme.ACROSS, theme.UPWARDS, theme.ARROW} <= colors()
    person.press(pygame.K_c, "c")
    assert not {theme.ACROSS, theme.UPWARDS} & colors()
    assert theme.ARROW in colors()


@pytest.mark.sweep
def test_a_force_that_is_switched_off_has_no_arrow() -> None:
    world = build(load(level_catalog.find("machines/coil-gun")))
    forces = Forces(world.level)
    seen = []
    while world.t < 1:
        seen.append(len(list(forces.arrows(world))))
        world.advance(4)

    assert seen[0] == seen[-1] == 0
    assert set(seen) == {0, 1}


def test_a_force_that_turns_with_its_body_is_drawn_turned_and_cannot_be_dragged() -> None:
    """The door has made a quarter turn: the push along its normal points to the left."""
    level = load(level_catalog.find("rotation/door"))
    world = build(level)
    world.advance(count_steps(world))
    arrow = next(a for a in Forces(level).arrows(world) if a.row == 2)

    assert arrow.newtons == pytest.approx((-12, 0), abs=0.2)
    assert arrow.tail == pytest.approx((3, 0.9), abs=0.02)
    assert not arrow.handles
