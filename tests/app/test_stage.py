"""The picture of a world, on a bare surface."""

import numpy as np
import pygame
import pytest

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.runs.session import Session
from sandbox.app.stage import joints, strings
from sandbox.app.stage.body_outlines import outlines
from sandbox.app.stage.joint_polylines import between_all_ends, between_ends
from sandbox.app.stage.stage import Stage
from sandbox.model import level_catalog
from sandbox.model.joints import Rod, Wire
from sandbox.model.loading import choose, load
from sandbox.model.shapes import XY
from sandbox.model.wire_points import along
from tests.app import scenes

SIZE = (640, 480)


def draw(session: Session, stage: Stage) -> pygame.Surface:
    surface = pygame.Surface(SIZE)
    stage.draw(surface, session.trail)
    return surface


def count(surface: pygame.Surface, color: Color) -> int:
    return int((pygame.surfarray.array3d(surface) == color).all(axis=2).sum())


@pytest.fixture
def session() -> Session:
    return Session(scenes.level())


@pytest.fixture
def stage(pen: Pen, session: Session) -> Stage:
    stage = Stage(pen, SIZE)
    stage.use(session.world)
    stage.fit()
    return stage


def test_the_ghost_is_drawn_where_the_closed_form_says(pen: Pen) -> None:
    session = Session(scenes.level(ghosts={"ball": ["4 + t", 1]}, checks=[]))
    stage = Stage(pen, SIZE)
    stage.use(session.world)
    stage.fit()
    x, y = stage.camera.to_screen((4, 1))
    around = pygame.Rect(0, 0, 50, 50)
    around.center = round(x), round(y)

    with_ghost = draw(session, stage).subsurface(around).copy()
    stage.shown["ghosts"] = False
    without = draw(session, stage).subsurface(around)

    assert count(with_ghost, theme.GHOST) > 10
    assert count(without, theme.GHOST) == 0


def test_a_ghost_ends_with_the_duration_of_its_formula(session: Session, stage: Stage) -> None:
    for _ in range(61):
        session.step()

    assert count(draw(session, stage), theme.GHOST) == 0


def test_the_trail_is_left_behind_and_can_be_hidden(session: Session, stage: Stage) -> None:
    draw(session, stage)
    for _ in range(60):
        session.step()
    stage.shown["ghosts"] = stage.shown["arrows"] = False
    x, y = stage.camera.to_screen((0, 4))

    shown = draw(session, stage).get_at((round(x), round(y)))
    stage.shown["trail"] = False
    hidden = draw(session, stage).get_at((round(x), round(y)))

    assert shown[0] > hidden[0] + 50


def test_a_trail_drawn_bit_by_bit_is_the_trail_drawn_at_once(
    pen: Pen, session: Session, stage: Stage
) -> None:
    for _ in range(40):
        session.step()
        bit_by_bit = draw(session, stage)
    other = Stage(pen, SIZE)
    other.use(session.world)
    other.fit()
    at_once = draw(session, other)

    a, b = (pygame.surfarray.array3d(s).astype(int) for s in (bit_by_bit, at_once))
    assert (np.abs(a - b).max(axis=2) > 60).sum() < 60


def test_the_arrow_points_where_the_ball_goes(session: Session, stage: Stage) -> None:
    for _ in range(60):
        session.step()
    surface = draw(session, stage)
    x, y = stage.camera.to_screen((0, 0))

    below = surface.subsurface((round(x) - 10, round(y) + 20, 20, 60))
    above = surface.subsurface((round(x) - 10, round(y) - 90, 20, 60))

    assert count(below, theme.ARROW) > 50
    assert count(above, theme.ARROW) == 0


RINGS = (("disc", 0.2), ("hoop", 1.0))  # m


def test_arrows_grow_with_the_speed_where_nobody_knows_how_fast_a_run_will_be(pen: Pen) -> None:
    """Scaled to the highest speed so far, the arrow of an accelerating body never grew."""
    session, stage = Session(load(level_catalog.find("momentum/cradle"))), Stage(pen, SIZE)
    stage.use(session.world)
    lengths = []
    for _ in range(250):
        session.step()
        speed = float(np.hypot(*session.world.snapshot.velocity.T).max())
        lengths.append(speed / stage.view.fastest)

    assert max(lengths) <= 1.1 + 1e-9
    assert np.ptp(lengths[20:]) > 0.4
    shorter = np.diff(lengths) < -1e-3
    assert shorter.sum() <= 8  # 1, 2, 5, 10, … of the first speed


def test_only_what_a_hand_can_move_is_picked(pen: Pen) -> None:
    session = Session(
        scenes.level(
            effects={"gravity": {"acceleration": [0, "-g"]}, "contact": {}},
            bodies={
                "ball": {
                    "shape": {"type": "box", "width": 1, "height": 1},
                    "mass": "mass",
                    "position": [0, 5],
                    "angle": "45*deg",
                },
                "floor": {
                    "type": "static",
                    "shape": {"type": "segment", "start": [-9, -1], "end": [9, -1]},
                },
            },
        )
    )
    stage = Stage(pen, SIZE)
    stage.use(session.world)
    stage.fit()

    def pick(point: XY) -> str | None:
        return stage.body_at(stage.camera.to_screen(point), margin=0)

    assert pick((0, 5.65)) == "ball"
    assert pick((0.45, 5.45)) is None  # a corner of the box as it would be if it were not turned
    assert pick((0, -1)) is None


def test_what_is_within_a_hoop_is_picked_and_the_hoop_only_at_its_rim(pen: Pen) -> None:
    inner, hoop = ({"shape": {"type": t, "radius": r}, "mass": "mass"} for t, r in RINGS)
    session = Session(scenes.level(bodies={"ball": inner, "hoop": hoop}, ghosts={}, checks=[]))
    stage = Stage(pen, SIZE)
    stage.use(session.world)
    stage.fit()

    picked = [stage.body_at(stage.camera.to_screen((x, 0)), margin=0) for x in (0.1, 0.5, 0.9)]

    assert picked == ["ball", None, "hoop"]


@pytest.mark.parametrize(
    "shape",
    [
        {"type": "disc", "radius": 1},
        {"type": "hoop", "radius": 1},
        {"type": "box", "width": 1, "height": 2},
        {"type": "polygon", "vertices": [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]},
        {"type": "segment", "start": [-1, 0], "end": [1, 0.5], "thickness": 0.1},
        {"type": "polyline", "points": [[-1, 0], [0, 1], [1, 0]]},
        {"type": "arc", "radius": 1, "start": 0, "end": "200*deg", "thickness": 0.1},
    ],
)
@pytest.mark.parametrize("kind", ["dynamic", "static"])
def test_every_shape_is_drawn(pen: Pen, shape: dict[str, object], kind: str) -> None:
    body = {"shape": shape, "color": scenes.BALL, "type": kind, "position": [4, 4]}
    if kind == "dynamic":
        body["mass"] = "mass"
    bodies = {"ball": {"shape": {"type": "disc", "radius": 0.1}, "mass": "mass"}, "other": body}
    session = Session(scenes.level(bodies=bodies, ghosts={}, checks=[]))
    stage = Stage(pen, SIZE)
    stage.use(session.world)
    stage.fit()
    empty = pygame.Surface(SIZE)
    empty.fill(theme.STAGE)

    drawn = draw(session, stage)

    around = pygame.Rect(0, 0, 90, 90)
    around.center = tuple(round(c) for c in stage.camera.to_screen((4, 4)))
    colors = {theme.SURFACE_EDGE, (255, 0, 0)}
    assert sum(count(drawn.subsurface(around), color) for color in colors) > 40


def test_bodies_far_outside_or_enormous_are_no_trouble(pen: Pen, session: Session) -> None:
    stage = Stage(pen, SIZE)
    stage.use(session.world)
    stage.fit()
    for _ in range(60):
        session.step()

    for factor in (1e4, 1e-9):
        stage.camera.zoom(factor)
        assert draw(session, stage).get_size() == SIZE


def test_bodies_are_told_apart_by_colour() -> None:
    disc = {"shape": {"type": "disc", "radius": 0.1}, "mass": "mass"}
    level = scenes.level(bodies={"a": disc, "b": disc}, ghosts={}, checks=[])

    found = outlines(level, level.defaults)

    assert found["a"].color != found["b"].color


ON_BALL = {"body": "ball", "at": [-4, 0]}

TIES: tuple[tuple[dict[str, object], Color], ...] = (
    ({"type": "rod"}, theme.SURFACE_EDGE),
    ({"type": "rope"}, theme.STRING),
    ({"type": "rope", "length": 9}, theme.STRING),
    ({"type": "spring", "stiffness": 1}, theme.SPRING),
    ({"type": "spring", "stiffness": 1, "length": 0}, theme.SPRING),
    ({"type": "pulley", "over": [[-2, 4]]}, theme.STRING),
    ({"type": "rail", "direction": [1, 0], "ends": ["ball", [-4, 5]]}, theme.SURFACE_EDGE),
    ({"type": "pivot", "ends": [[-4, 5], {"body": "ball", "at": [-4, 0]}]}, theme.STRING),
    ({"type": "weld"}, theme.SURFACE_EDGE),
    ({"type": "motor", "ends": [[-4, 5], ON_BALL], "rate": 1}, theme.SURFACE_EDGE),
    ({"type": "winding", "radius": 0.4, "unwinds": "clockwise"}, theme.STRING),
    ({"type": "winding", "radius": 0.4, "unwinds": "counterclockwise"}, theme.STRING),
)


@pytest.mark.parametrize(("tie", "color"), TIES, ids=str)
def test_every_joint_is_drawn(pen: Pen, tie: dict[str, object], color: Color) -> None:
    joints = {"tie": {"ends": [[-4, 2], "ball"], **tie}}
    turns: dict[str, object] = (
        {"rotation": {}} if tie["type"] in ("weld", "motor", "winding") else {}
    )
    effects = {"gravity": {"acceleration": [0, "-g"]}, **turns}
    session = Session(scenes.level(joints=joints, ghosts={}, effects=effects))
    stage = Stage(pen, (400, 300))
    stage.use(session.world)
    stage.fit()

    assert count(draw(session, stage), color) >= 5


def test_a_joint_that_is_still_to_catch_is_drawn_as_two_open_hooks(pen: Pen) -> None:
    """Each is a ring, open towards the other; the rod appears once it is tied."""
    rod = {"type": "rod", "ends": [[-4, 2], "ball"]}
    events = {"click": {"at": 0.1, "tie": ["tie"]}}
    session = Session(scenes.level(joints={"tie": rod}, ghosts={}, events=events))
    stage = Stage(pen, (400, 300))
    stage.use(session.world)
    stage.fit()
    open_ = draw(session, stage)
    x, y = stage.camera.to_screen((-4, 2))
    around = open_.subsurface(pygame.Rect(int(x) - 10, int(y) - 10, 20, 20))
    for _ in range(12):
        session.step()

    assert count(around, theme.STRING) >= 20
    assert count(open_, theme.SURFACE_EDGE) < 20
    assert count(draw(session, stage), theme.SURFACE_EDGE) >= 20


def test_a_joint_without_a_look_of_its_own_is_seen(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delitem(joints.LOOKS, Rod)
    rod = {"type": "rod", "ends": [[-4, 2], "ball"]}
    session = Session(scenes.level(joints={"tie": rod}, ghosts={}))
    stage = Stage(pen, (400, 300))
    stage.use(session.world)
    stage.fit()

    assert count(draw(session, stage), theme.SURFACE_EDGE) >= 20


def test_a_frame_that_depends_on_parameters_follows_them(pen: Pen) -> None:
    level = load(level_catalog.find("kinematics/free-fall"))
    stage = Stage(pen, SIZE)
    for height in (20, 50):
        stage.use(Session(level, choose(level, {"height": height})).world)
        assert 0 < stage.camera.to_screen((0, height))[1] < SIZE[1] / 4

    stage.camera.zoom(0.5)
    chosen = stage.camera.scale
    stage.use(Session(level, level.defaults).world)
    assert stage.camera.scale == chosen


def test_rounding_is_not_drawn_as_motion(pen: Pen) -> None:
    session = Session(load(level_catalog.find("rotation/balance-beam")))
    for _ in range(60):
        session.step()
    stage = Stage(pen, SIZE)
    stage.use(session.world)

    assert abs(session.world.snapshot.velocity).max() > 0
    assert count(draw(session, stage), theme.ARROW) == 0


@pytest.mark.parametrize("half", [1e3, 1e9, 1e16, 1e100])
@pytest.mark.parametrize("runs", [False, True])
@pytest.mark.usefixtures("boundless")
def test_what_has_no_end_to_speak_of_is_drawn_where_it_is_seen(
    pen: Pen, monkeypatch: pytest.MonkeyPatch, half: float, runs: bool
) -> None:
    """Its hatching and the marks of a belt would fill countless pixels, or never end."""
    line = {"type": "segment", "start": [-half, 0], "end": [half, 0]}
    belt = {"type": "box", "width": 2 * half, "height": 1}
    rough = {"friction": 1} if runs else {}
    floor = {"type": "static", "shape": belt if runs else line, **rough}
    scene = scenes.level(
        effects={
            "contact": {},
            **({"friction": {}, "belt": [{"body": "floor", "velocity": [1, 0]}]} if runs else {}),
        },
        bodies={
            "ball": {
                "shape": {"type": "disc", "radius": 0.5}, "mass": 1, "position": [0, 3], **rough,
            },
            "floor": floor,
        },
        parameters={}, checks=[], ghosts={},
    )  # fmt: skip
    endless = Session(scene)
    stage = Stage(pen, SIZE)
    stage.use(endless.world)
    stage.fit()
    strokes: list[XY] = []
    stroke = lines.stroke

    def counted(surface: pygame.Surface, color: Color, a: XY, b: XY, width: float) -> None:
        strokes.append(a)
        stroke(surface, color, a, b, width)

    monkeypatch.setattr(lines, "stroke", counted)
    draw(endless, stage)

    assert len(strokes) < 1000


def test_a_curve_is_hatched_evenly_on_one_side(pen: Pen, monkeypatch: pytest.MonkeyPatch) -> None:
    """On the side away from the ball, behind its crests as in its valleys."""
    hills = {"type": "curve", "curve": ["s", "0.3*sin(4*s)"], "s": [-3, 3]}
    scene = scenes.level(
        effects={"contact": {}},
        bodies={
            "ball": {
                "shape": {"type": "disc", "radius": 0.1}, "mass": 1, "position": [-2.9, 0.9],
            },
            "hills": {"type": "static", "shape": hills},
        },
        parameters={}, checks=[], ghosts={},
    )  # fmt: skip
    session = Session(scene)
    stage = Stage(pen, SIZE)
    stage.use(session.world)
    stage.fit()
    strokes: list[tuple[XY, XY]] = []

    def counted(_: pygame.Surface, color: Color, a: XY, b: XY, width: float) -> None:
        if color == theme.SURFACE and width == 1:
            strokes.append((a, b))

    monkeypatch.setattr(lines, "stroke", counted)
    draw(session, stage)
    begins, ends = np.array(strokes).swapaxes(0, 1)
    gaps = np.hypot(*np.diff(begins, axis=0).T)
    along = np.gradient(begins, axis=0)
    across = along[:, 0] * (ends - begins)[:, 1] - along[:, 1] * (ends - begins)[:, 0]

    assert len(strokes) > 30
    assert gaps.min() > 0.9 * gaps.max()
    assert (across > 0).all()  # downwards on the screen, which it follows to the right


def test_a_line_stays_hatched_on_one_side_when_all_is_drawn_anew(
    pen: Pen, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A change of theme redraws it, wherever the ball is by then."""
    line = {"type": "segment", "start": [-2, 0], "end": [2, 0]}
    ball = {"shape": {"type": "disc", "radius": 0.1}, "mass": 1, "position": [0, 1]}
    scene = scenes.level(
        effects={"gravity": {"acceleration": [0, -9.81]}},
        bodies={"ball": ball, "line": {"type": "static", "shape": line}},
        parameters={}, checks=[], ghosts={},
    )  # fmt: skip
    session = Session(scene)
    stage = Stage(pen, SIZE)
    sides = []

    def noted(_: pygame.Surface, color: Color, a: XY, b: XY, width: float) -> None:
        if color == theme.SURFACE and width == 1:
            sides.append(b[1] > a[1])

    monkeypatch.setattr(lines, "stroke", noted)
    for _ in range(2):
        stage.use(session.world)
        stage.fit()
        draw(session, stage)
        while session.world.snapshot.position[0, 1] > -1:
            session.step()

    assert len(sides) > 20
    assert all(sides)


def test_the_wheels_of_pegs_beside_each_other_do_not_overlap() -> None:
    surface = pygame.Surface(SIZE)
    corners = [(50, 150), (50, 50), (90, 50), (90, 150)]

    strings.draw_string(surface, corners, slack=False)

    between = surface.subsurface((70, 53, 1, 30))
    assert not pygame.surfarray.array3d(between).any()


def test_a_wire_is_as_smooth_as_its_curve(pen: Pen, monkeypatch: pytest.MonkeyPatch) -> None:
    """A spiral was drawn with 200 straight pieces, 0.8 px off the curve on which the marble ran."""
    session = Session(load(level_catalog.find("machines/marble-run")))
    stage = Stage(pen, (1200, 1200))
    stage.use(session.world)
    stage.fit()
    drawn: list[XY] = []
    path = lines.path

    def noted(surface: pygame.Surface, color: Color, points: list[XY], width: float) -> None:
        drawn.extend(points if color == theme.SURFACE_EDGE else ())
        path(surface, color, points, width)

    monkeypatch.setattr(lines, "path", noted)
    for _ in range(2):
        draw(session, stage)

    wire = session.level.joints["run"]
    assert isinstance(wire, Wire)
    fine = along(wire, session.values, 20_000)
    x, y = np.array(stage.camera.path(zip(fine.real, fine.imag, strict=True))).T
    a, b = np.array(drawn[:-1]), np.array(drawn[1:])
    middles = (a + b) / 2
    off = [np.hypot(x - px, y - py).min() for px, py in middles]
    assert max(off) < 0.1  # px
    assert len(drawn) < 1002  # once, though the stage was drawn twice


def test_one_of_many_joints_is_a_line(pen: Pen, monkeypatch: pytest.MonkeyPatch) -> None:
    """The pins of 760 rods took 10 of the 20 ms of a frame."""
    stage = Stage(pen, SIZE)
    stage.use(Session(load(level_catalog.find("hard/net-of-20"))).world)
    stage.fit()
    circles: list[object] = []
    monkeypatch.setattr(pygame.draw, "aacircle", lambda *where: circles.append(where))

    stage.draw(pygame.Surface(SIZE))

    assert len(circles) < 10


@pytest.mark.parametrize("name", ["machines/car-over-bumps", "hard/bridge-of-160"])
def test_the_ends_of_many_joints_are_found_at_once_where_each_is(name: str) -> None:
    world = scenes.opened(name, 20).world
    apart = {joint: between_ends(world, joint) for joint in world.scene.joints.paths}

    for joint, path in between_all_ends(world).items():
        assert np.array(path) == pytest.approx(np.array(apart.pop(joint)), abs=1e-12)
    assert not apart
