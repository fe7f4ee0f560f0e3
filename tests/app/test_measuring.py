"""What can be measured on the stage: an instant on a trail, an angle."""

from math import hypot

import numpy as np
import pygame
import pytest

from sandbox.app.measuring import trail_probe
from sandbox.app.measuring.protractor import Protractor
from tests.app.person import Person


def at(person: Person, point: tuple[float, float]) -> trail_probe.ProbedInstant | None:
    """Return what is found under a point of the plane [m]."""
    stage = person.window.stage
    return trail_probe.find(stage.view, person.session, stage.camera.to_screen(point))


@pytest.mark.sweep
def test_a_probe_on_the_trail_tells_when_the_ball_was_there_and_how_fast(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    for _ in range(60):
        person.press(pygame.K_RIGHT)
    t, v, g = 0.5, 25 / 2**0.5, 9.81

    found = at(person, (v * t, v * t - g * t * t / 2))

    assert found is not None
    assert found.body == "ball"
    assert found.t == pytest.approx(0.5)
    assert found.speed == pytest.approx(hypot(v, v - g * t), rel=1e-9)
    assert at(person, (v * t, v * t + 20)) is None
    before = pygame.image.tobytes(person.window.surface, "RGB")
    person.move(person.on_screen(found.place))
    assert pygame.image.tobytes(person.window.surface, "RGB") != before


def test_the_words_of_a_probe_are_not_cut_off_in_a_narrow_window(person: Person) -> None:
    """With large text its line was wider than the stage, and lost both ends."""
    person.resize((900, 600))
    person.window.comfort.choose(size=150)
    person.window.apply_preferences()
    person.window.open_level("newton/incline")
    for _ in range(20):
        person.press(pygame.K_RIGHT)
    x, y = person.session.history.snapshots.position[10, 1].tolist()

    before = pygame.surfarray.array3d(person.window.surface)
    person.move(person.on_screen((x, y)))

    stage = person.window.panels.layout.stage
    changed = (pygame.surfarray.array3d(person.window.surface) != before).any(axis=(1, 2))
    seen = np.flatnonzero(changed[stage.left : stage.right])
    assert len(seen)
    assert 4 < seen[0] < seen[-1] < stage.width - 4


def test_a_probe_does_not_tell_rounding(person: Person) -> None:
    """The last ball of the cradle is at rest until it is hit, to some 1e-14 m/s."""
    person.window.open_level("momentum/cradle")
    for _ in range(250):
        person.session.step()
    person.wait()
    assert 0 < np.hypot(*person.session.world.snapshot.velocity[-1]) < 1e-11

    found = at(person, (0.8, 0.0))

    assert found is not None
    assert "e" not in found.text.replace("ball5", "")
    assert found.text.endswith("(0.8000, 0) m   0 m/s")


def test_a_body_in_the_hand_is_not_covered_by_the_probe(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    person.window.open_level("momentum/cradle")
    person.wait()
    drawn: list[object] = []
    monkeypatch.setattr(trail_probe, "draw", lambda *told: drawn.append(told))
    x, y = person.on_screen((0.2, 0.0))
    person.drag((x, y), (x - 60, y - 20), let_go=False)
    before = len(drawn)
    person.wait(0.1)
    assert len(drawn) == before

    person.button(False, (x - 60, y - 20))

    assert len(drawn) > before


def test_the_probe_covers_no_label_and_no_body(person: Person) -> None:
    """Its plate lay over the names of the balls, and over the forces below the mouse."""
    person.window.open_level("momentum/cradle")
    person.press(pygame.K_j, "j")
    person.click(person.on_screen((0.8, 0.0)))
    person.wait(0.1)
    view = person.window.stage.view
    labels = [place.copy() for place in view.labels._taken]
    person.move(person.on_screen((0.8, 0.0)))

    *before, plate = view.labels._taken

    assert before == labels[: len(before)]
    assert len(before) >= 5 + 2
    assert plate.collidelist(before) < 0
    assert plate.collidelist(view.boxes) < 0


def test_a_branch_leaves_the_old_trail_to_be_probed(person: Person) -> None:
    person.window.open_level("kinematics/projectile")
    for _ in range(40):
        person.press(pygame.K_RIGHT)
    person.session.branch({"g": 2.0})
    person.wait()
    assert at(person, (0.0, 0.0)) is not None  # where it was before the branch


@pytest.mark.parametrize(
    ("second", "angle"), [((3.0, 1.0), 90.0), ((0.0, 0.0), 0.0), ((4.0, 0.0), 180.0)]
)
def test_the_angle_at_a_corner_is_between_its_legs(
    second: tuple[float, float], angle: float
) -> None:
    corner = (3.0, 0.0) if second[1] else (2.0, 0.0)
    assert Protractor((0.0, 0.0), corner, second).angle == pytest.approx(angle)


def test_ctrl_and_shift_lay_a_protractor_on_the_tape(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    person.window.open_level("kinematics/projectile")
    stage = person.window.panels.layout.stage
    x, y = stage.x + 120, stage.y + 150

    monkeypatch.setattr(pygame.key, "get_mods", lambda: pygame.KMOD_SHIFT)
    person.drag((x, y), (x + 100, y))
    monkeypatch.setattr(pygame.key, "get_mods", lambda: pygame.KMOD_SHIFT | pygame.KMOD_CTRL)
    person.drag((x + 100, y), (x + 100, y - 80))

    assert isinstance(person.window.hand.tape, Protractor)
    assert person.window.hand.tape.angle == pytest.approx(90)
