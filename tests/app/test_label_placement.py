"""Labels do not overlap."""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import dist

import pygame
import pytest

from sandbox.app.drawing.text import Pen
from sandbox.app.runs.session import Session
from sandbox.app.stage import given_force_arrows
from sandbox.app.stage.given_force_arrows import ForceLabel, Forces
from sandbox.app.stage.label_placement import Labels
from sandbox.app.stage.motion_annotations import bounding_boxes
from sandbox.app.stage.overlays import forces
from sandbox.app.stage.stage import Stage
from sandbox.model import level_catalog
from sandbox.model.loading import load
from tests.app.person import Person
from tests.app.scenes import opened, play
from tests.app.writing import placed

BOUNDS = pygame.Rect(0, 0, 100, 100)
BEST, SECOND = pygame.Rect(10, 10, 20, 10), pygame.Rect(10, 40, 20, 10)


def test_the_best_place_is_taken_first_and_then_the_next_and_then_none() -> None:
    labels = Labels(BOUNDS)

    assert labels.place_for([BEST, SECOND]) == BEST
    assert labels.place_for([BEST, SECOND]) == SECOND
    assert labels.place_for([BEST, SECOND]) is None


def test_words_stay_on_the_picture() -> None:
    beyond = pygame.Rect(90, 10, 20, 10)

    assert Labels(BOUNDS).place_for([beyond, SECOND]) == SECOND


def test_words_cover_what_they_should_avoid_only_if_nothing_else_is_left() -> None:
    labels = Labels(BOUNDS)

    assert labels.place_for([BEST, SECOND], avoid=[BEST]) == SECOND
    assert labels.place_for([BEST, SECOND], avoid=[BEST]) == BEST


def test_words_lie_over_a_line_only_if_nothing_else_is_left() -> None:
    labels = Labels(BOUNDS)
    labels.mark((0, 0), (60, 30))

    assert labels.place_for([BEST, SECOND]) == SECOND
    assert labels.place_for([BEST, SECOND]) == BEST


def test_a_label_stays_where_it_was_while_no_other_place_is_better() -> None:
    """While an arrow moved along its best place, it jumped to and fro in every picture."""
    kept: dict[str, int] = {}
    labels = Labels(BOUNDS, kept)
    labels.mark((0, 0), (60, 30))
    assert labels.place_for([BEST, SECOND], name="weight") == SECOND

    assert Labels(BOUNDS, kept).place_for([BEST, SECOND], name="weight") == SECOND
    assert Labels(BOUNDS, kept).place_for([BEST, SECOND], name="other") == BEST
    labels = Labels(BOUNDS, kept)
    labels.mark((0, 45), (60, 45))
    assert labels.place_for([BEST, SECOND], name="weight") == BEST


def test_a_strict_label_is_left_out_rather_than_cover_what_it_should_avoid() -> None:
    assert Labels(BOUNDS).place_for([BEST], avoid=[BEST], strict=True) is None


def test_events_at_one_place_are_written_apart(pen: Pen) -> None:
    session = play(Session(load(level_catalog.find("lagrange/bead-on-a-wire"))))
    written: list[pygame.Rect] = []

    class Noting(pygame.Surface):
        def blit(self, source: pygame.Surface, dest: pygame.Rect, *_: object) -> pygame.Rect:  # type: ignore[override]
            if source in texts:
                written.append(pygame.Rect(dest))
            return super().blit(source, dest)

    milestones = session.milestones()
    texts = [pen.outlined(text) for milestone in milestones for text in milestone.texts(str)]
    stage = Stage(pen, (640, 480))
    stage.use(session.world)
    stage.draw(Noting((640, 480)), milestones=milestones)

    assert len(written) == len(texts) == 3
    shrunk = [place.inflate(0, -4) for place in written]  # lines of one text share their rims
    assert all(a.collidelist(shrunk[i + 1 :]) < 0 for i, a in enumerate(shrunk))


def test_what_was_measured_keeps_off_bodies(pen: Pen) -> None:
    session = Session(load(level_catalog.find("momentum/cradle")))
    while session.t < 0.56:
        session.step()
    (milestone,) = session.milestones()
    texts = [pen.outlined(text) for text in milestone.texts(str)]
    places: list[pygame.Rect] = []

    class Noting(pygame.Surface):
        def blit(self, source: pygame.Surface, dest: pygame.Rect, *_: object) -> pygame.Rect:  # type: ignore[override]
            if source in texts:
                places.append(pygame.Rect(dest))
            return super().blit(source, dest)

    stage = Stage(pen, (715, 740))
    stage.use(session.world)
    stage.fit()
    stage.draw(Noting((715, 740)), milestones=[milestone])

    balls = [(each, *stage.view.state(each)) for each in stage.view.moving]
    assert places
    assert all(place.collidelist(bounding_boxes(stage.camera, balls)) < 0 for place in places)


def test_what_was_measured_keeps_off_the_arrow_of_a_force(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where a ball stops rising, its weight is drawn downwards."""
    person.window.open_level("kinematics/projectile")
    person.press(pygame.K_j, "j")
    while not person.session.milestones():
        person.session.step()
    places, arrows = placed(monkeypatch)
    person.wait()

    assert len(places) == 4  # of the height, the weight and the ball, and in the diagram
    assert not any(place.clipline(*arrow) for place in places for arrow in arrows)


def test_what_was_measured_keeps_off_the_words_of_the_level(pen: Pen) -> None:
    """Labels of the level do not move, so all others make way for them."""
    session = Session(load(level_catalog.find("momentum/bounce-by-bounce")))
    while session.t < 2.0:
        session.step()
    own, measured = set[pygame.Surface](), set[pygame.Surface]()
    for label in session.level.view.labels:
        own.add(pen.outlined(label.text))
    for milestone in session.milestones():
        measured.update(pen.outlined(text) for text in milestone.texts(str))
    places: dict[pygame.Surface, pygame.Rect] = {}

    class Noting(pygame.Surface):
        def blit(self, source: pygame.Surface, dest: pygame.Rect, *_: object) -> pygame.Rect:  # type: ignore[override]
            if source in own | measured:
                places[source] = pygame.Rect(dest)
            return super().blit(source, dest)

    stage = Stage(pen, (370, 540))
    stage.use(session.world)
    stage.fit()
    stage.draw(Noting((370, 540)), milestones=session.milestones())

    assert places.keys() >= own
    assert places.keys() & measured
    taken = [places[text] for text in own]
    assert all(places[text].collidelist(taken) < 0 for text in places.keys() & measured)


def test_the_words_of_forces_in_a_narrow_picture_keep_off_each_other(pen: Pen) -> None:
    session = Session(load(level_catalog.find("energy/resonance")))
    session.playing = True
    while session.t < 1.0:
        session.update(1 / 60, budget=10.0)
    stage, surface = Stage(pen, (370, 540)), pygame.Surface((370, 540))
    stage.use(session.world)
    stage.fit()
    labels = Labels(surface.get_rect())

    Forces(session.level).draw(surface, stage.camera, pen, session.world, labels)

    taken = labels._taken
    assert len(taken) > 4
    assert all(taken[i].collidelist(taken[:i]) < 0 for i in range(len(taken)))


def test_a_line_that_ends_anywhere_is_looked_at_in_no_time() -> None:
    labels = Labels(BOUNDS)
    labels.mark((5, 15), (1e20, 15))
    labels.mark((5, -1e30), (1e10, 1e39))

    assert labels.place_for([BEST, SECOND]) == SECOND


def test_no_label_lies_over_a_ruler(pen: Pen, monkeypatch: pytest.MonkeyPatch) -> None:
    session = Session(load(level_catalog.find("machines/trebuchet")))
    for _ in range(60):
        session.step()
    stage = Stage(pen, (400, 400))
    stage.use(session.world)
    stage.fit()
    places, _ = placed(monkeypatch)
    stage.camera.pan(-60, 0)
    stage.view.looking, stage.asked = session.looking, "forces"
    stage.draw(pygame.Surface((400, 400)), session.trail)

    assert len(places) == 3
    assert min(place.left for place in places) >= stage.view.labels.bounds.left > 12
    assert max(place.bottom for place in places) <= stage.view.labels.bounds.bottom < 400


def test_where_all_is_to_be_avoided_lines_still_count() -> None:
    """Of a slanted body the bounding box is to be avoided, and in it the sides."""
    labels = Labels(BOUNDS)
    labels.mark((0, 15), (100, 15))

    assert labels.place_for([BEST, SECOND], avoid=[BOUNDS]) == SECOND
    labels.mark((0, 35), (100, 35))
    assert Labels(BOUNDS).place_for([BEST, SECOND], avoid=[BOUNDS], strict=True) is None
    assert Labels(BOUNDS).place_for([BEST, SECOND], avoid=[BOUNDS]) == BEST


def test_the_energy_of_a_slanted_arm_is_written_beside_it(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It was written across the arm, whose bounding box covers all places near the mark."""
    session = opened("machines/trebuchet", 240)
    stage = Stage(pen, (716, 740))
    stage.use(session.world)
    stage.fit()
    places, _ = placed(monkeypatch)
    stage.draw(pygame.Surface((716, 740)), session.trail, session.milestones())

    arm = next(each for each in stage.view.moving if each.name == "arm")
    path = stage.camera.path(arm.placed(*stage.view.state(arm)))
    sides = list(pairwise((*path, path[0])))
    wide = [place for place in places if place.width > 150]
    assert len(wide) == 1
    assert not any(wide[0].clipline(side) for side in sides)


def test_names_keep_off_the_posts_of_a_trebuchet(pen: Pen, monkeypatch: pytest.MonkeyPatch) -> None:
    """The names of its weight and its arm lay over a post each."""
    session = opened("machines/trebuchet", 144)
    stage = Stage(pen, (499, 525))
    stage.use(session.world)
    stage.fit()
    stage.shown["arrows"] = False
    places, _ = placed(monkeypatch)

    stage.draw(pygame.Surface((499, 525)))

    posts = [outline for outline in stage.view.still if outline.closed]
    sides = [
        side
        for outline in posts
        for corners in [stage.camera.path(outline.placed(*stage.view.state(outline)))]
        for side in pairwise([*corners, corners[0]])
    ]
    assert len(posts) > 2
    assert len(places) == 2  # of three, as the stone is at the edge
    assert not any(place.clipline(side) for place in places for side in sides)


def test_two_labels_beside_each_other_can_be_told_apart() -> None:
    """Two names read as one: brick2brick4."""
    labels = Labels(BOUNDS)
    left, beside = pygame.Rect(10, 10, 20, 10), pygame.Rect(30, 10, 20, 10)

    assert labels.place_for([left]) == left
    assert labels.place_for([beside, SECOND]) == SECOND


@pytest.mark.sweep
def test_the_forces_on_a_chassis_are_written_beside_the_car(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    """They were written over its wheels and over its body."""
    session = Session(load(level_catalog.find("machines/car-over-bumps")))
    while session.t < 1.5:
        session.step()
    session.looking.chosen = "chassis"
    stage = Stage(pen, (580, 540))
    stage.use(session.world)
    stage.fit()
    stage.view.looking = session.looking
    stage.asked = "forces"
    written: list[ForceLabel] = []
    found = given_force_arrows.beside

    def noted(*where: object) -> ForceLabel | None:
        written.extend(text for text in (found(*where),) if text)  # type: ignore[arg-type]
        return written[-1]

    monkeypatch.setattr(forces, "beside", noted)
    stage.draw(pygame.Surface((580, 540)))

    car = bounding_boxes(
        stage.camera, ((each, *stage.view.state(each)) for each in stage.view.moving)
    )
    assert len(written) == 5
    assert all(each.place.collidelist(car) < 0 for each in written)
    assert any(each.leader for each in written)


def test_what_was_measured_at_a_landing_is_not_written_across_the_ground(pen: Pen) -> None:
    session = Session(load(level_catalog.find("kinematics/projectile")))
    while session.t < 3.62:
        session.step()
    stage = Stage(pen, (640, 700))
    stage.use(session.world)
    stage.fit()
    stage.draw(pygame.Surface((640, 700)), session.trail, session.milestones())

    ground = stage.camera.path(stage.view.outlines["ground"].placed((0, 0), 0))
    texts = [place for place in stage.view.labels._taken if place.width > 60]
    assert len(texts) >= 3
    assert not any(place.clipline(*ground) for place in texts)


@pytest.mark.parametrize(
    ("name", "seconds"),
    [("machines/flywheel", 1.0), ("rotation/torsion-pendulum", 2.4), ("rotation/electric-bell", 2)],
)
def test_what_was_measured_at_a_large_body_is_written_beside_it(
    pen: Pen, monkeypatch: pytest.MonkeyPatch, name: str, seconds: float
) -> None:
    """All places near the mark lie on the wheel, the gong or the hammer."""
    session = Session(load(level_catalog.find(name)))
    while session.t < seconds:
        session.step()
    stage = Stage(pen, (640, 700))
    stage.use(session.world)
    stage.fit()
    stage.shown["names"] = False
    places, _ = placed(monkeypatch)
    stage.draw(pygame.Surface((640, 700)), session.trail, session.milestones())

    filled = (*stage.view.moving, *(each for each in stage.view.still if each.radius))
    bodies = bounding_boxes(stage.camera, ((each, *stage.view.state(each)) for each in filled))
    assert places
    assert all(place.collidelist(bodies) < 0 for place in places)


def test_a_name_is_not_written_across_the_path_just_behind_its_body(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = opened("newton/heavy-and-light", 45)
    stage = Stage(pen, (640, 700))
    stage.use(session.world)
    stage.fit()
    stage.shown["arrows"] = stage.shown["ghosts"] = False
    places, _ = placed(monkeypatch)
    stage.draw(pygame.Surface((640, 700)), session.trail)

    rows = [each.row for each in stage.view.moving]
    paths = [stage.camera.path(session.trail.points[:, row].tolist()) for row in rows]
    assert len(places) == len(paths) == 2
    assert not any(
        place.clipline(*piece) for place in places for path in paths for piece in pairwise(path)
    )


def test_words_of_the_level_at_the_edge_are_not_cut_off(pen: Pen) -> None:
    session = opened("momentum/bounce-by-bounce")
    stage = Stage(pen, (400, 449))
    stage.use(session.world)
    stage.fit()
    stage.shown["names"] = stage.shown["arrows"] = False
    stage.draw(pygame.Surface((400, 449)))

    texts = stage.view.labels._taken[1:]  # the first is the corner with the scale
    assert len(texts) == 4
    assert all(stage.view.labels.bounds.contains(place) for place in texts)


def test_a_name_keeps_off_the_arrows_of_forces_in_a_small_window(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With large text the name of the block lay over its normal force."""
    place_for, crossed = Labels.place_for, dict[str, bool]()

    def noted_place(
        labels: Labels, places: Iterable[pygame.Rect], avoid: Sequence[pygame.Rect] = (), *,
        name: str = "", strict: bool = False,
    ) -> pygame.Rect | None:  # fmt: skip
        place = place_for(labels, places, avoid, name=name, strict=strict)
        crossed[name] = place is None or labels._crosses(place)
        return place

    monkeypatch.setattr(Labels, "place_for", noted_place)
    person.resize((900, 600))
    person.window.comfort.choose(size=150)
    person.window.apply_preferences()
    person.window.open_level("newton/incline-with-friction")
    person.press(pygame.K_j, "j")
    person.session.looking.chosen = "block"
    for _ in range(20):
        person.press(pygame.K_RIGHT)

    assert any(name.startswith("force normal force") for name in crossed)
    assert not crossed["name block"]


def test_in_a_small_window_no_name_stands_at_another_body(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With large text ball 4 was named above ball 2, and ball 3 above ball 5."""
    place_for, names = Labels.place_for, dict[str, pygame.Rect]()

    def noted_place(
        labels: Labels, places: Iterable[pygame.Rect], avoid: Sequence[pygame.Rect] = (), *,
        name: str = "", strict: bool = False,
    ) -> pygame.Rect | None:  # fmt: skip
        place = place_for(labels, places, avoid, name=name, strict=strict)
        if place and name.startswith("name "):
            names[name.removeprefix("name ")] = place
        return place

    monkeypatch.setattr(Labels, "place_for", noted_place)
    person.resize((900, 600))
    person.window.comfort.choose(language="de", size=150)
    person.window.apply_preferences()
    person.window.open_level("momentum/cradle")
    names.clear()
    person.wait()

    view = person.window.stage.view
    centers = {each.name: view.camera.to_screen(view.state(each)[0]) for each in view.moving}
    assert len(names) > 2
    for name, place in names.items():
        assert min(centers, key=lambda body: dist(centers[body], place.center)) == name
