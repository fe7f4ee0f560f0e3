"""The picture as someone sees it who moves with a body, or with the centre of mass."""

import numpy as np
import pygame
import pytest

from sandbox.app.measuring import trail_probe
from sandbox.app.pages.forces.panel import ForcesPage
from sandbox.app.stage.frame_of_reference import CENTER, FrameOfReference
from sandbox.app.stage.level_labels import seen_from
from sandbox.model import level_catalog
from sandbox.model.loading import load
from sandbox.physics.run import build
from sandbox.physics.stepping.world import World
from tests.app.person import Person


def world(name: str, steps: int = 0) -> World:
    found = build(load(level_catalog.find(name)))
    if steps:
        found.advance(steps)
    return found


def observe(person: Person, level: str, body: str, times: int = 1) -> None:
    person.window.open_level(level)
    person.session.looking.chosen = body
    for _ in range(times):
        person.press(pygame.K_4, "4")


def place(person: Person, body: str) -> tuple[float, float]:
    """Return where the middle of a body is drawn [px]."""
    view = person.window.stage.view
    return view.camera.to_screen(view.state(view.outlines[body])[0])


def test_at_the_centre_of_mass_all_momenta_add_up_to_zero() -> None:
    found = world("momentum/elastic-light-on-heavy", 40)
    velocity = FrameOfReference(found, CENTER).relative(found.snapshot.velocity)

    assert found.scene.mass @ found.snapshot.velocity[:, 0] > 0.5
    assert found.scene.mass @ velocity == pytest.approx([0, 0], abs=1e-12)


def test_from_the_upper_bob_the_lower_one_goes_round_a_circle() -> None:
    found = world("lagrange/double-pendulum")
    states = [found.snapshot.position.copy()]
    for _ in range(50):
        found.advance(round(found.stepping.rate / 30))
        states.append(found.snapshot.position.copy())
    upper, lower = map(list(found.scene.bodies).index, ("upper", "lower"))

    path = FrameOfReference(found, "upper").path(np.array(states))

    assert path[:, upper] == pytest.approx(np.tile(found.snapshot.position[upper], (51, 1)))
    away = np.hypot(*(path[:, lower] - path[:, upper]).T)
    assert away == pytest.approx(np.full(51, away[0]), rel=1e-9)
    assert np.ptp(path[:, lower, 0]) > 0.5 * away[0]


def test_on_the_ground_all_is_seen_as_it_is() -> None:
    found = world("lagrange/double-pendulum", 30)
    observer = FrameOfReference(found, None)

    assert observer.relative(found.snapshot.velocity) is found.snapshot.velocity
    assert (observer.path(found.snapshot.position[None]) == found.snapshot.position).all()
    assert FrameOfReference(found, "nobody").place is None
    assert observer.displacement == (0, 0)


@pytest.mark.sweep
def test_the_body_from_which_one_looks_stays_where_it_is(person: Person) -> None:
    observe(person, "machines/car-over-bumps", "chassis")
    before = place(person, "chassis")
    person.press(pygame.K_SPACE, " ")
    person.wait(0.5)
    assert person.session.t > 0.3

    assert place(person, "chassis") == pytest.approx(before, abs=0.1)
    view = person.window.stage.view
    assert view.velocity(view.outlines["chassis"]) == (0, 0)
    person.press(pygame.K_HOME)
    person.wait()
    assert place(person, "chassis") == pytest.approx(before, abs=0.1)


def test_the_view_can_be_moved_and_fitted_while_it_goes_along(person: Person) -> None:
    observe(person, "machines/car-over-bumps", "chassis")
    before = place(person, "chassis")
    person.press(pygame.K_SPACE, " ")
    person.wait(0.3)
    corner = person.window.panels.layout.stage
    person.drag((corner.x + 100, corner.y + 100), (corner.x + 140, corner.y + 100))
    person.wait(0.1)
    assert place(person, "chassis") == pytest.approx((before[0] + 40, before[1]), abs=0.1)

    person.press(pygame.K_f, "f")
    person.wait(0.1)

    assert place(person, "chassis") == pytest.approx(before, abs=0.1)


def test_the_key_goes_from_the_body_to_the_centre_of_mass_to_the_ground(person: Person) -> None:
    observe(person, "momentum/elastic-light-on-heavy", "second")
    seen = [person.window.stage.view.observer.place]
    for _ in range(2):
        person.press(pygame.K_4, "4")
        seen.append(person.window.stage.view.observer.place)
    assert seen == ["second", CENTER, None]
    assert person.window.banner.is_showing(seen_from(None))

    person.press(pygame.K_4, "4")
    person.session.looking.chosen = "first"
    person.press(pygame.K_4, "4")
    assert person.window.stage.view.observer.place == "first"

    person.window.open_level("kinematics/projectile")
    person.wait()
    assert person.window.stage.view.observer.place is None


def test_who_observes_is_told_once_on_the_stage_itself(person: Person) -> None:
    observe(person, "momentum/elastic-light-on-heavy", "second")

    assert person.window.stage.view.observer.place == "second"
    assert not person.window.banner.is_showing(seen_from("second"))


def test_the_page_of_the_forces_has_a_button_for_it(person: Person) -> None:
    observe(person, "newton/incline", "block", times=0)
    person.press(pygame.K_j, "j")
    person.window.panels.scroll_pages(9)
    person.wait()

    person.click(person.page(ForcesPage).observer.rect)

    assert person.window.stage.view.observer.place == "block"


def test_a_probe_tells_what_the_observer_saw(person: Person) -> None:
    """The centre of two equal masses follows the moving one half as fast."""
    observe(person, "momentum/elastic-equal-masses", "first", times=2)
    person.press(pygame.K_SPACE, " ")
    person.wait(0.4)
    person.press(pygame.K_SPACE, " ")
    view, session = person.window.stage.view, person.session
    history = session.history.snapshots
    row = view.outlines["first"].row
    drawn = view.observer.path(history.position)[3, row]

    found = trail_probe.find(view, session, view.camera.to_screen(tuple(drawn.tolist())))

    assert found is not None
    assert found.speed == pytest.approx(np.hypot(*history.velocity[0, row]) / 2, rel=1e-9)


def test_what_is_built_is_seen_from_the_ground(person: Person) -> None:
    observe(person, "machines/car-over-bumps", "chassis")
    person.press(pygame.K_SPACE, " ")
    person.wait(0.4)
    assert person.window.stage.camera.offset[0] > 0.3

    person.press(pygame.K_b, "b")
    person.press(pygame.K_ESCAPE)
    person.wait()

    assert person.window.stage.camera.offset == (0, 0)
