"""What if: effects are switched off and on for a run, which is drawn over the original one."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.pages.effects import switching_effects
from sandbox.app.pages.effects.panel import EffectsPage
from sandbox.app.runs.session import Session
from sandbox.app.stage import run_legend
from sandbox.model.errors import SandboxError
from sandbox.model.level_catalog import find
from sandbox.model.levels_with_changed_effects import EffectError
from sandbox.model.loading import load, parse
from sandbox.physics.run import build, simulate
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.world import World
from tests.app import scenes
from tests.app.person import Person
from tests.app.scenes import play


@pytest.fixture
def player(person: Person, tmp_path: Path) -> Person:
    """A person who has opened the page of the effects, with a ball about to fall."""
    person.open(tmp_path, scenes.falling())
    person.press(pygame.K_x, "x")
    return person


def test_both_runs_are_in_lockstep_and_each_in_its_own_bits() -> None:
    session = Session(scenes.level())
    switching_effects.toggle(session, "drag")

    play(session)

    (original,) = session.companions
    alone = build(scenes.level())
    alone.advance(60)
    assert original.world.steps == session.world.steps == 60
    assert np.array_equal(original.world.snapshot.position, alone.snapshot.position)
    assert session.world.snapshot.position[0, 1] > original.world.snapshot.position[0, 1] + 0.1


def test_an_effect_is_switched_off_and_on_again() -> None:
    session = Session(scenes.level())

    switching_effects.toggle(session, "gravity")
    assert session.level.effects.gravity is None
    assert session.changes.label == "without gravity"
    switching_effects.toggle(session, "gravity")

    assert session.level == session.original
    assert session.companions == ()


def test_the_formulas_do_not_judge_what_they_do_not_describe() -> None:
    session = Session(scenes.level())
    switching_effects.toggle(session, "drag")

    play(session)

    assert session.readings() == ()
    assert [r.result.verdict for r in session.companions[0].readings(hurried=False)] == [
        "passed",
        "passed",
    ]


def test_the_difference_is_told_in_the_levels_quantities_and_in_time() -> None:
    session = Session(scenes.level())
    switching_effects.toggle(session, "drag")

    play(session)
    found = switching_effects.compared(session)
    told = switching_effects.summary(session, found)

    half_way = simulate(session.original).columns["ball.speed"][30]
    assert found[1].first == pytest.approx(half_way)
    assert found[1].second == pytest.approx(100 * (1 - np.exp(-0.05)), rel=1e-4)
    assert told.startswith("with drag (linear 0.1): ")
    assert "half way −2.4" in told
    assert told.endswith("ms a step")


def test_both_runs_take_turns_in_going_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """The second finds warm caches: in such a short scene, 0.1 ms less per step."""
    session = Session(scenes.level())
    switching_effects.toggle(session, "drag")
    (original,) = session.companions
    order: list[World] = []
    advance = World.advance

    def noted(world: World) -> Snapshot:
        order.append(world)
        return advance(world)

    monkeypatch.setattr(World, "advance", noted)
    for _ in range(3):
        session.step()

    run, other = session.world, original.world
    assert order == [run, other, other, run, run, other]


@dataclass
class SeenBodies:
    """What the legend asks of a view."""

    colors: list[theme.Color]
    boxes: list[pygame.Rect] = field(default_factory=list)
    kept: dict[str, int] = field(default_factory=dict)
    few = True


@pytest.mark.parametrize("banner", [0, 72, 130])
def test_the_legend_stands_below_a_banner_of_any_height(pen: Pen, banner: int) -> None:
    """The differences at the end of a run often take several lines."""
    surface = pygame.Surface((600, 300))

    run_legend.draw(
        surface, pen, [(None, "with drag"), (theme.GHOST, switching_effects.DECLARED)], banner
    )

    drawn = np.flatnonzero(pygame.surfarray.array3d(surface).any(axis=(0, 2)))
    assert drawn[0] > banner


def test_a_legend_for_which_a_banner_leaves_no_room_waits(pen: Pen) -> None:
    """It used to be cut off in the middle of a row."""
    surface = pygame.Surface((600, 300))

    run_legend.draw(
        surface, pen, [(None, "with drag"), (theme.GHOST, switching_effects.DECLARED)], 250
    )

    assert not pygame.surfarray.array3d(surface).any()


def test_the_legend_tells_the_own_run_by_the_colours_of_its_bodies(pen: Pen) -> None:
    """Its trails have these colours; the legend showed another one."""
    surface = pygame.Surface((600, 300))
    red, blue = (239, 71, 111), (17, 138, 178)

    rows = [(None, "this run"), (theme.GHOST, "speed = 12.9")]

    run_legend.draw(surface, pen, rows, view=SeenBodies([red, blue]))  # type: ignore[arg-type]

    y = run_legend.CORNER[1] + run_legend.PADDING + (pen.write("this run", 14).height + 2) // 2
    x = run_legend.CORNER[0] + run_legend.PADDING
    assert surface.get_at((x + 3, y))[:3] == red
    assert surface.get_at((x + run_legend.SWATCH - 3, y))[:3] == blue


def test_the_legend_keeps_off_moving_bodies_and_stays_in_its_corner(pen: Pen) -> None:
    """It lay over the left weight of an Atwood machine."""
    rows, weight = [(None, "this run"), (theme.GHOST, "that")], pygame.Rect(60, 70, 40, 40)
    seen = SeenBodies([], [weight])
    for boxes in ([weight], []):
        surface, seen.boxes = pygame.Surface((600, 300)), boxes

        run_legend.draw(surface, pen, rows, view=seen)  # type: ignore[arg-type]

        drawn = np.flatnonzero(pygame.surfarray.array3d(surface).any(axis=(1, 2)))
        assert drawn[0] > weight.right


@pytest.mark.parametrize("text_scale", [1.0, 1.5])
def test_the_legend_keeps_off_bodies_in_every_corner(text_scale: float) -> None:
    """On a narrow stage with large text it lay over a weight in every corner."""
    pygame.font.init()
    rows = [(None, "leapfrog: error 4e-15"), (theme.GHOST, "symplectic Euler: error 0.01")]
    weights = [pygame.Rect(146, 80, 40, 40), pygame.Rect(236, 442, 40, 40)]
    surface = pygame.Surface((420, 510))

    run_legend.draw(surface, Pen(text_scale), rows, view=SeenBodies([], weights))  # type: ignore[arg-type]

    drawn = np.asarray(pygame.surfarray.array3d(surface).any(axis=2))
    assert drawn.any()
    assert not any(drawn[w.left : w.right, w.top : w.bottom].any() for w in weights)


def test_the_legend_is_written_smaller_if_no_other_place_is_clear(pen: Pen) -> None:
    rows, surface = [(None, "this run"), (theme.GHOST, "that")], pygame.Surface((600, 200))
    band = pygame.Rect(0, 116, 600, 84)

    run_legend.draw(surface, pen, rows, view=SeenBodies([], [band]))  # type: ignore[arg-type]

    drawn = np.flatnonzero(pygame.surfarray.array3d(surface).any(axis=(0, 2)))
    assert drawn[-1] < band.top


def test_the_legend_ends_within_a_narrow_stage(pen: Pen) -> None:
    surface = pygame.Surface((370, 300))
    many = "with drag (linear 0.1), with contact, with restitution (coefficient 1)"

    run_legend.draw(surface, pen, [(None, many), (theme.GHOST, switching_effects.DECLARED)])

    drawn = np.flatnonzero(pygame.surfarray.array3d(surface).any(axis=(1, 2)))
    assert drawn[-1] < surface.width - 1


def test_a_change_of_a_parameter_changes_both_runs() -> None:
    session = Session(scenes.level())
    switching_effects.toggle(session, "drag")

    session.restart({"g": 2})

    assert session.companions[0].world.values["g"] == session.world.values["g"] == 2
    assert session.changes.on == ("drag",)


FOURTH = {"rate": 60, "scheme": "fourth-order"}


def test_where_the_scheme_is_not_for_an_effect_both_runs_go_by_leapfrog_until_it_is_gone() -> None:
    session = Session(scenes.level(stepping=FOURTH))

    switching_effects.toggle(session, "drag")

    (original,) = session.companions
    assert session.level.stepping.scheme == original.world.stepping.scheme == "leapfrog"
    assert session.changes.label == "with drag (linear 0.1), both by leapfrog"
    play(session)
    switching_effects.toggle(session, "drag")
    assert session.level == session.original


def test_where_the_scheme_is_for_an_effect_it_stays() -> None:
    session = Session(scenes.level(stepping=FOURTH))

    switching_effects.toggle(session, "attraction")

    assert session.level.stepping.scheme == "fourth-order"
    assert session.changes.replaced_scheme is None


def test_a_setting_that_is_chosen_for_the_changed_run_is_kept_when_its_effect_is_gone() -> None:
    session = Session(scenes.level(stepping=FOURTH))
    switching_effects.toggle(session, "drag")
    chosen = session.world.stepping.at(240)

    switching_effects.play_with_stepping(session, chosen)
    switching_effects.toggle(session, "drag")

    assert session.level.stepping == chosen


def test_what_cannot_be_leaves_everything_as_it_was() -> None:
    session = Session(scenes.level())
    switching_effects.toggle(session, "drag")
    world = session.world

    with pytest.raises(EffectError, match="'friction' needs the effect 'contact'"):
        switching_effects.toggle(session, "friction")

    assert session.world is world
    assert session.changes.on == ("drag",)


def test_an_effect_takes_with_it_what_is_nothing_without_it_and_brings_it_back() -> None:
    session = Session(load(find("momentum/bouncing-ball")))

    switching_effects.toggle(session, "contact")
    assert session.changes.label == "without contact (and so without restitution)"
    assert session.level.effects.restitution is None
    switching_effects.toggle(session, "contact")

    assert session.level.effects.restitution is not None


def test_a_companion_that_has_to_stop_lets_the_other_go_on() -> None:
    session = Session(parse(scenes.runaway()))
    switching_effects.toggle(session, "gravity")

    play(session)

    assert session.failure is None
    assert session.at_end
    assert isinstance(session.companions[0].failure, SandboxError)


def test_a_switch_changes_the_run_and_shows_both(player: Person) -> None:
    player.click(player.page(EffectsPage).switch("gravity").rect)
    assert not player.page(EffectsPage).switch("gravity").is_selected
    assert player.session.level.effects.gravity is None

    player.press(pygame.K_SPACE, " ")
    player.wait(0.7)

    _, fallen = (float(x) for x in player.session.companions[0].world.snapshot.position[0])
    x, y = player.on_screen((0.0, fallen))
    around = [player.color_at((x + i, y + j)) for i in range(-26, 27) for j in range(-26, 27)]
    still = player.on_screen((0.0, 5.0))
    assert theme.GHOST in around
    assert player.color_at((still[0] + 9, still[1] + 5)) == (255, 0, 0)


def test_the_end_of_the_run_tells_what_is_different(player: Person) -> None:
    player.click(player.page(EffectsPage).switch("drag").rect)
    player.press(pygame.K_SPACE, " ")
    player.wait(0.5)
    before = player.window.surface.copy()
    player.wait(0.7)

    stage = player.window.panels.layout.stage
    assert player.session.at_end
    row = [(x, 36) for x in range(stage.left, stage.right)]
    assert theme.ACCENT in [player.color_at(pixel) for pixel in row]
    assert any(before.get_at(pixel) != player.window.surface.get_at(pixel) for pixel in row)


def test_reset_restores_the_level(player: Person) -> None:
    player.click(player.page(EffectsPage).switch("drag").rect)
    player.click(player.page(EffectsPage).switch("gravity").rect)
    assert player.session.changes.off == ("gravity",)

    player.click(player.page(EffectsPage).reset.rect)

    assert player.session.level == player.session.original
    assert not player.page(EffectsPage).reset.is_enabled


def test_an_effect_that_is_on_can_be_made_stronger_and_weaker(player: Person) -> None:
    assert not player.page(EffectsPage).scale("drag", 2).is_enabled
    player.click(player.page(EffectsPage).switch("drag").rect)

    player.click(player.page(EffectsPage).scale("drag", 2).rect)
    player.click(player.page(EffectsPage).scale("drag", 2).rect)
    assert player.session.changes.label == "with drag (linear 0.4)"
    player.click(player.page(EffectsPage).scale("drag", 0.5).rect)

    assert player.session.changes.label == "with drag (linear 0.2)"
    assert player.session.level.effects.drag is not None
    assert player.session.level.effects.drag.linear({}) == 0.2


def test_a_strength_that_cannot_be_changes_nothing() -> None:
    session = Session(load(find("momentum/inelastic")))
    switching_effects.toggle(session, "restitution")

    with pytest.raises(EffectError, match="coefficient"):
        switching_effects.strengthen(session, "restitution", 2)
    switching_effects.strengthen(session, "restitution", 0.5)

    assert session.changes.label == "with restitution (coefficient 0.5)"


def test_where_an_effect_cannot_go_is_told(player: Person) -> None:
    before = player.window.surface.copy()

    player.click(player.page(EffectsPage).switch("friction").rect)
    player.wait()

    stage = player.window.panels.layout.stage
    column = [(x, 40) for x in range(stage.left, stage.right)]
    assert theme.NOTICE in [player.color_at(pixel) for pixel in column]
    assert theme.NOTICE not in [tuple(before.get_at(pixel))[:3] for pixel in column]
    assert not player.page(EffectsPage).switch("friction").is_selected


def test_the_tabs_are_turned_by_mouse_and_keyboard(player: Person) -> None:
    side = player.side

    player.click(side.tab("level page").rect)
    assert player.side.parameters.row("g")
    player.press(pygame.K_p, "p")
    player.press(pygame.K_x, "x")

    assert player.page(EffectsPage).switch("gravity").is_selected
