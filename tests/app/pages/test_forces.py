"""The page of the forces on a body, and their arrows on the stage."""

from collections.abc import Sequence
from itertools import combinations, pairwise
from math import hypot

import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.observing import forces_on_selected_body
from sandbox.app.pages.forces import card, force_diagrams
from sandbox.app.pages.forces.component_axes import Axes, components
from sandbox.app.pages.forces.panel import ForcesPage
from sandbox.app.runs.session import Session
from sandbox.app.stage.label_placement import Labels
from sandbox.app.stage.overlays import accelerations, center, forces
from sandbox.physics.measuring.free_body import FRICTION, NORMAL, AppliedForce, FreeBody
from tests.app import scenes
from tests.app.person import Person
from tests.app.writing import placed
from validation.case import textbook

WIDTH = 276
INCLINE = "newton/incline-with-friction"
LEVELS = (
    INCLINE,
    "newton/atwood",
    "newton/magnetic-field",
    "lagrange/large-pendulum",
    "machines/car-over-bumps",
    "machines/belt-drive",
    "hard/stack-of-40-directly",
)


def pixels(picture: pygame.Surface, color: theme.Color) -> int:
    return int((pygame.surfarray.array3d(picture) == color).all(axis=2).sum())


def at(session: Session) -> FreeBody:
    found = session.looking.at(session.world)
    assert found
    return found


def stepped(level: str, steps: int = 30) -> Session:
    session = Session(textbook(level))
    for _ in range(steps):
        session.step()
    return session


def words(pen: Pen, net: float) -> pygame.Surface:
    """Return what the polygon says about the sum."""
    sheet = pygame.Surface((WIDTH, 20))
    sheet.fill(theme.STAGE)
    sheet.blit(
        pen.write(f"sum {forces_on_selected_body.newtons(net)} N", 12, theme.RESULTANT), (4, 2)
    )
    return sheet


def test_a_click_on_a_body_shows_its_forces(person: Person) -> None:
    person.window.open_level("newton/atwood")
    person.press(pygame.K_j, "j")
    assert person.session.looking.body(person.session.level) == "left"

    x, y = person.session.world.snapshot.position[1]
    stage = person.window.panels.layout.stage
    px, py = person.window.stage.camera.to_screen((x, y))
    person.click((px + stage.x, py + stage.y))

    assert person.session.looking.body(person.session.level) == "right"
    assert at(person.session).body == "right"
    assert person.session.world.steps == 0
    assert not person.session.world.disturbed


def test_a_key_selects_the_next_body_and_after_the_last_the_first(person: Person) -> None:
    """Without a mouse only the forces on the first body could be seen."""
    person.window.open_level("newton/atwood")
    person.press(pygame.K_j, "j")
    seen = []
    for _ in range(3):
        seen.append(person.session.looking.body(person.session.level))
        person.press(pygame.K_9, "9")

    assert seen == ["left", "right", "left"]
    assert isinstance(person.side.page, ForcesPage)


def test_the_page_draws_the_forces_on_the_stage_while_it_is_shown(person: Person) -> None:
    person.window.open_level(INCLINE)
    person.press(pygame.K_RIGHT)
    stage = person.window.panels.layout.stage
    weight = theme.ACTING["weight"]

    def seen() -> int:
        person.wait()
        return pixels(person.window.surface.subsurface(stage), weight)

    before = seen()
    person.press(pygame.K_j, "j")
    shown = seen()
    person.press(pygame.K_o, "o")

    after = seen()
    person.press(pygame.K_u, "u")  # its own key, whatever page is shown

    assert (before, after) == (0, 0)
    assert shown > 100
    assert seen() > 100


def test_components_along_the_slope_are_those_of_the_textbook(person: Person) -> None:
    """Across the slope only the normal force and m g cos α remain, and cancel."""
    person.window.open_level(INCLINE)
    person.press(pygame.K_j, "j")
    person.press(pygame.K_RIGHT)
    axes = person.page(ForcesPage)._axes
    person.click(person.page(ForcesPage).inclined.rect)
    found = at(person.session)
    inclined, first = axes.inclined, axes.first(found, (0.0, 0.0))
    told = {acting.name: components(acting.force, first) for acting in found.forces}

    assert inclined
    assert told[NORMAL][0] == pytest.approx(0, abs=1e-9)
    assert told[FRICTION][1] == pytest.approx(0, abs=1e-9)
    assert sum(across for _, across in told.values()) == pytest.approx(0, abs=1e-9)
    assert first[0] > 0

    person.click(person.page(ForcesPage).level.rect)
    assert not axes.inclined
    assert axes.first(found, (0.0, 0.0)) == (1.0, 0.0)


@pytest.mark.parametrize("level", LEVELS)
def test_words_of_the_diagram_do_not_cover_each_other(
    pen: Pen, level: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    places: list[pygame.Rect] = []
    find = Labels.place_for

    def spied(self: Labels, *told: object) -> pygame.Rect | None:
        place = find(self, *told)  # type: ignore[arg-type]
        places.extend([place] if place else [])
        return place

    monkeypatch.setattr(Labels, "place_for", spied)
    session = stepped(level)

    force_diagrams.free_body(pen, (WIDTH, card.DIAGRAM), at(session))

    assert places
    assert not any(a.colliderect(b) for a, b in combinations(places, 2))


@pytest.mark.parametrize("level", LEVELS)
def test_the_polygon_ends_where_the_sum_does(pen: Pen, level: str) -> None:
    session = stepped(level)
    found = at(session)

    picture = force_diagrams.polygon(pen, (WIDTH, card.POLYGON), found)

    net = hypot(*forces_on_selected_body.without_rounding(found.net, found))
    arrow = pixels(picture, theme.RESULTANT) - pixels(words(pen, net), theme.RESULTANT)
    assert (arrow > 20) == (net > 0)


@pytest.mark.sweep
def test_a_force_that_is_rounding_beside_the_others_is_left_out() -> None:
    found = at(stepped("hard/stack-of-40-directly"))
    faint = AppliedForce("drag", "", (1e-12 * found.largest, 0.0), found.center)
    more = FreeBody(**{f: getattr(found, f) for f in found.__slots__} | {
        "forces": (*found.forces, faint)})  # fmt: skip

    assert faint not in forces_on_selected_body.not_negligible(more)
    assert forces_on_selected_body.not_negligible(more) == forces_on_selected_body.not_negligible(
        found
    )


def test_a_level_in_which_nothing_moves_by_forces_says_so(pen: Pen) -> None:
    floor = {"type": "static", "shape": {"type": "disc", "radius": 1}}
    session = Session(
        scenes.level(bodies={"floor": floor}, parameters={}, effects={}, checks=[], ghosts={})
    )
    assert session.looking.body(session.level) is None

    assert card.forces(pen, WIDTH, session, Axes()).height < 100


def test_before_the_first_step_of_an_explicit_scheme_nothing_is_known(pen: Pen) -> None:
    session = Session(textbook("lagrange/euler-pendulum"))
    short = card.forces(pen, WIDTH, session, Axes()).height

    session.step()

    assert card.forces(pen, WIDTH, session, Axes()).height > short + card.DIAGRAM


def test_the_scale_of_the_arrows_changes_seldom() -> None:
    session = Session(textbook("lagrange/large-pendulum"))
    seen = []
    for _ in range(200):
        session.step()
        seen.append(session.looking.force_of_longest_arrow(at(session)))

    changes = sum(a != b for a, b in pairwise(seen))
    assert changes < 4


def test_of_several_forces_of_a_name_who_gives_each_is_told() -> None:
    found = at(stepped("hard/stack-of-40-directly"))
    texts = [text for _, text in forces_on_selected_body.texts(found)]

    assert "weight 9.81 N" in texts
    assert any(text.startswith("from ground ") for text in texts)
    assert any(text.startswith("from box 2 ") for text in texts)


ALIKE = (
    ("machines/trebuchet", "stone", ["from arm (1)", "from arm (2)"]),
    ("machines/waiters-tray", "tray", ["from left", "from right", "normal force", "friction"]),
    ("newton/two-forces", "box", ["applied force (1)", "applied force (2)"]),
    ("machines/car-over-bumps", "chassis", ["from rear axle", "from front axle", "from bolts"]),
    ("hard/arch", "stone1", ["normal force, stone 2", "friction, stone 2", "friction, ground"]),
)


@pytest.mark.parametrize(("level", "body", "names"), ALIKE)
def test_no_two_forces_on_a_body_are_named_alike(
    level: str, body: str, names: Sequence[str]
) -> None:
    session = stepped(level, 20)
    session.looking.chosen = body
    for told in (
        forces_on_selected_body.texts(at(session)),
        forces_on_selected_body.titles(at(session)),
    ):
        assert len({text for _, text in told}) == len(told)

    texts = [text.rsplit(" ", 2)[0] for _, text in forces_on_selected_body.texts(at(session))]
    assert set(names) <= set(texts)


@pytest.mark.parametrize(
    ("level", "body"), [("machines/car-over-bumps", "chassis"), ("rotation/balance-beam", "beam")]
)
def test_forces_along_one_line_all_have_their_words(
    pen: Pen, level: str, body: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = stepped(level)
    session.looking.chosen = body
    found = at(session)
    places: list[pygame.Rect] = []
    find = Labels.place_for

    def noted(self: Labels, *told: object) -> pygame.Rect | None:
        place = find(self, *told)  # type: ignore[arg-type]
        places.extend([place] if place else [])
        return place

    monkeypatch.setattr(Labels, "place_for", noted)
    force_diagrams.free_body(pen, (WIDTH, card.DIAGRAM), found)

    assert len(places) == len(forces_on_selected_body.not_negligible(found))
    assert not any(a.colliderect(b) for a, b in combinations(places, 2))


def test_words_of_forces_on_the_stage_lie_over_no_arrow(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    person.window.open_level("machines/squeaking-crate")
    person.press(pygame.K_j, "j")
    places, lines = placed(monkeypatch)
    for _ in range(30):
        person.session.step()
    person.wait()

    assert len(places) >= 4
    assert len(lines) >= 5
    assert not any(place.clipline(*line) for place in places for line in lines)


def test_the_stage_and_the_page_tell_one_size_while_the_run_plays(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The stage is drawn in every frame, but the page only a few times per second."""
    person.window.open_level("momentum/cradle")
    person.press(pygame.K_j, "j")
    person.session.step()
    person.wait()
    told: list[tuple[str, ...]] = []
    texts = forces_on_selected_body.texts

    def noted(found: FreeBody) -> Sequence[tuple[AppliedForce, str]]:
        told.append(tuple(text for _, text in texts(found)))
        return texts(found)

    monkeypatch.setattr(forces_on_selected_body, "texts", noted)
    person.session.playing = True
    before = person.session.world.steps
    person.wait(0.2)

    assert person.session.world.steps > before
    assert len(set(told)) <= 3


def test_every_force_has_a_colour() -> None:
    assert {"weight", NORMAL, FRICTION, "tension", "drag"} <= set(forces_on_selected_body.colors())
    assert (
        forces_on_selected_body.colors()["weight"]
        != forces_on_selected_body.colors()[NORMAL]
        != forces_on_selected_body.colors()[FRICTION]
    )


@pytest.mark.parametrize("overlay", [forces.OVERLAY, center.OVERLAY, accelerations.OVERLAY])
def test_overlays_of_forces_are_off_until_they_are_asked_for(
    person: Person, overlay: object
) -> None:
    person.window.open_level("newton/atwood")

    assert not person.window.stage.shown[getattr(overlay, "name", "")]


def test_the_centre_of_mass_is_marked_between_the_bodies(person: Person) -> None:
    person.window.open_level("newton/atwood")
    person.press(pygame.K_QUOTE, "'")
    person.wait()
    scene, camera = person.session.world.scene, person.window.stage.camera
    x, y = scene.mass @ person.session.world.snapshot.position / scene.mass.sum()
    px, py = camera.to_screen((float(x), float(y)))
    stage = person.window.panels.layout.stage
    near = pygame.Rect(stage.x + px - 9, stage.y + py - 9, 19, 19).clip(stage)

    assert pixels(person.window.surface.subsurface(near), theme.NOTICE) > 20


def test_an_arrow_of_acceleration_points_where_the_body_speeds_up(person: Person) -> None:
    person.window.open_level("newton/atwood")
    person.press(pygame.K_RIGHT)
    person.press(pygame.K_SEMICOLON, ";")
    person.wait()
    stage = person.window.panels.layout.stage

    assert pixels(person.window.surface.subsurface(stage), theme.ACCELERATION) > 50
