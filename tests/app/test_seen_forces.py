"""The overlays that show what the solver knows: contacts, loads of joints, and turning."""

from math import atan2, hypot

import numpy as np
import pygame
import pytest

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.pages.forces.panel import ForcesPage
from sandbox.app.runs.session import Session
from sandbox.app.stage import overlay_legend
from sandbox.app.stage.joint_polylines import between_ends
from sandbox.app.stage.overlays import contacts, loads, rotation_velocities_and_center
from sandbox.app.stage.overlays.overlay import Overlay
from sandbox.app.stage.stage import Stage
from sandbox.physics.measuring.free_body import FRICTION, NORMAL
from tests.app.person import Person
from validation.case import textbook

SIZE = (800, 600)


def run(level: str, steps: int, **values: float) -> Session:
    session = Session(textbook(level), {**textbook(level).defaults, **values})
    for _ in range(steps):
        session.step()
    return session


def stage(pen: Pen, session: Session, *shown: str) -> Stage:
    """Return a stage that draws nothing over a scene but some overlays."""
    found = Stage(pen, SIZE, plain=True)
    found.use(session.world)
    found.fit()
    for name in found.shown:
        found.shown[name] = name in shown
    return found


def drawn(found: Stage, color: Color) -> np.ndarray:
    """Return where a stage has a colour: (width, height)."""
    surface = pygame.Surface(SIZE)
    found.draw(surface)
    seen: np.ndarray = (pygame.surfarray.array3d(surface) == color).all(axis=2)
    return seen


def touches(pen: Pen, session: Session) -> list[contacts.Touch]:
    view = stage(pen, session).view
    found = contacts.Touches(session.world).of_bodies([outline.name for outline in view.moving])
    return list(found)


def off_normal(touch: contacts.Touch) -> float:
    """Return the tangent of the angle between a force and the normal."""
    (x, y), (u, v) = touch.normal, touch.force
    return abs(x * v - y * u) / (x * u + y * v)


def test_the_force_on_a_block_that_holds_is_within_its_friction_cone(pen: Pen) -> None:
    session = run("newton/incline-that-holds", 60)

    (touch,) = touches(pen, session)

    assert not touch.slides
    assert off_normal(touch) < 0.9 * touch.mu
    x, y = touch.force
    assert atan2(y, x) == pytest.approx(np.pi / 2, abs=1e-9)  # it carries the weight, straight up


def test_the_force_on_a_block_that_slides_is_on_the_edge_of_its_cone(pen: Pen) -> None:
    session = run("newton/incline-with-friction", 60)

    (touch,) = touches(pen, session)

    assert touch.slides
    assert off_normal(touch) == pytest.approx(touch.mu, rel=1e-9)


def test_contacts_between_bodies_show_action_and_reaction(pen: Pen) -> None:
    session = run("hard/stack-of-40-directly", 10)

    every = touches(pen, session)

    assert len(every) == 40 + 39  # all contacts but that with the floor are felt by two bodies
    total = np.sum([touch.force for touch in every], axis=0)
    scene = session.world.scene
    assert scene.gravity
    weight = -scene.mass.sum() * scene.gravity.acceleration[1]
    assert total == pytest.approx((0, weight), abs=1e-6 * weight)  # of the floor on the pile


@pytest.mark.parametrize(
    ("level", "name", "filled"),
    [
        ("newton/incline-that-holds", NORMAL, True),
        ("newton/incline-with-friction", FRICTION, False),
    ],
)
def test_a_contact_that_holds_has_a_dot_and_one_that_slides_a_ring(
    pen: Pen, level: str, name: str, filled: bool
) -> None:
    session = run(level, 60)
    found, (touch,) = stage(pen, session, "contacts"), touches(pen, session)
    x, y = found.camera.to_screen(touch.at)
    (u, v), size = touch.force, hypot(*touch.force)
    behind = round(x - 2 * u / size), round(y + 2 * v / size)  # where there is no arrow

    seen = drawn(found, theme.ACTING[name])

    assert seen.sum() > 100
    assert seen[behind] == filled


def test_force_chains_become_wider_towards_the_ground(pen: Pen) -> None:
    session = run("hard/stack-of-40-directly", 10)
    assert len(session.level.bodies) > contacts.MANY
    found = stage(pen, session, "contacts")
    seen = drawn(found, theme.ACTING[NORMAL])
    heights = session.world.snapshot.position[:, 1]
    low, high = np.quantile(heights, (0.2, 0.8))

    def wide(height: float) -> int:
        x, y = found.camera.to_screen((0.0, float(height)))
        return int(seen[round(x) - 20 : round(x) + 20, round(y)].sum())

    assert wide(low) >= 2 * wide(high) > 0


def test_a_string_has_the_tension_of_the_textbook_written_beside_it(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = run("newton/atwood", 10)
    found, written, outlined = stage(pen, session, "loads"), [""], pen.outlined

    def noting(text: str, size: int = 12, color: Color | None = None) -> pygame.Surface:
        written.append(text)
        return outlined(text, size, color)

    monkeypatch.setattr(pen, "outlined", noting)

    seen = drawn(found, theme.ACTING["tension"])

    m1, m2, g = (session.values[name] for name in ("m1", "m2", "g"))
    assert f"{2 * m1 * m2 * g / (m1 + m2):.3g}" in " ".join(written)
    assert seen.sum() > 200


def test_a_strut_pushes_in_dashes(pen: Pen) -> None:
    session = run("hard/strut", 10)
    found, world = stage(pen, session, "loads"), session.world
    pushing = [
        name
        for name in world.level.joints
        if float(world.scene.joints.tension(name, world.snapshot)) < 0
    ]
    (name,) = pushing[:1]
    (ax, ay), (bx, by) = found.camera.path(between_ends(world, name))

    seen = drawn(found, theme.ACTING[NORMAL])

    along = np.linspace(0.1, 0.9, 60)
    points = np.rint([ax + (bx - ax) * along, ay + (by - ay) * along]).astype(int)
    assert 0.3 < seen[tuple(points)].mean() < 0.8  # dashes of 7 px, 6 px apart


def test_a_wheel_that_rolls_turns_about_its_point_of_contact(pen: Pen) -> None:
    session = run("rotation/rolling", 60)
    view = stage(pen, session, "rotation_velocities_and_center").view
    assert {outline.name for outline in view.moving} == {"disc", "hoop"}
    for outline in view.moving:
        spin = float(session.world.snapshot.angular_velocity[outline.row])
        (x, y), (vx, vy) = view.state(outline)[0], view.velocity(outline)
        center = rotation_velocities_and_center.center_of_rotation(view, outline, spin)
        assert outline.radius is not None

        away = hypot(center[0] - x, center[1] - y)
        assert away == pytest.approx(outline.radius, rel=1e-6)
        across = (center[0] - x) * vx + (center[1] - y) * vy
        assert abs(across) < 1e-9  # straight below it, seen along the slope


@pytest.mark.sweep
def test_a_body_that_moves_as_a_whole_has_no_arrows_at_its_corners(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The corners of a car and its load nearly hid the wheels, whose points differ in velocity."""
    view = stage(pen, run("machines/car-over-bumps", 240), "rotation_velocities_and_center").view
    arrows = list[object]()
    monkeypatch.setattr(lines, "arrow", lambda *drawn: arrows.append(drawn))

    rotation_velocities_and_center._draw(pygame.Surface(SIZE), view)

    wheels = [outline for outline in view.moving if outline.radius is not None]
    assert len(wheels) == 2
    assert len(arrows) == len(wheels) * rotation_velocities_and_center.AROUND


@pytest.mark.parametrize("width", [620, 440, 360])
def test_a_key_too_wide_for_the_stage_is_written_smaller(pen: Pen, width: int) -> None:
    found = Stage(pen, (width, 500), plain=True)
    found.use(run("hard/arch", 5).world)
    found.fit()
    rows = [(lambda *_: None, "slides: the force lies on the edge of the friction cone")]
    drawn = pygame.Surface((width, 500))

    overlay_legend.draw(drawn, found.view, rows, "key of a test")

    assert (pygame.surfarray.array3d(drawn) == theme.PANEL).all(axis=2).any()


@pytest.mark.parametrize(
    "overlay", [contacts.OVERLAY, loads.OVERLAY, rotation_velocities_and_center.OVERLAY]
)
def test_the_page_of_the_forces_has_a_button_for_it(person: Person, overlay: Overlay) -> None:
    person.window.open_level("rotation/rolling")
    person.press(pygame.K_j, "j")
    person.window.panels.scroll_pages(9)
    person.wait()
    button = person.page(ForcesPage).overlay(overlay.name)
    shown = [button.is_selected]

    person.click(button.rect)
    person.wait(0.2)
    shown.append(button.is_selected)
    assert person.window.stage.shown[overlay.name]
    person.press(pygame.key.key_code(overlay.key), overlay.key)
    person.wait(0.2)
    shown.append(button.is_selected)

    assert shown == [False, True, False]


def test_the_normal_force_of_a_wire_is_no_contact(pen: Pen) -> None:
    session = run("lagrange/bead-on-a-wire", 10)
    found = session.looking.at(session.world)
    assert found
    assert NORMAL in {acting.name for acting in found.forces}

    assert touches(pen, session) == []


def test_balls_that_only_touch_show_no_contact_force(pen: Pen) -> None:
    """Between the balls of the cradle there was an arrow for 5e-9 N."""
    session = run("momentum/cradle", 312)
    assert session.flashes  # just after the impact

    assert touches(pen, session) == []
