"""Levels are built with the mouse, from nothing, and run."""

import re

import pygame
import pytest

from sandbox.app.building.tools.joining import CLICKS, PLAIN, kinds
from sandbox.app.drawing import theme
from sandbox.app.pages.build import mistakes_suggestions_and_effects
from sandbox.model.loading import parse
from sandbox.physics.measuring.grading import grade
from sandbox.physics.run import build, simulate
from tests.app.building.builder import Builder
from tests.app.person import until
from tests.sample import thinned


@pytest.mark.sweep
def test_an_atwood_machine_takes_less_than_25_clicks_and_passes_its_checks(
    builder: Builder,
) -> None:
    builder.new()
    builder.tool("box")
    builder.drag((-2.5, 1), (-1.5, 2))
    builder.drag((1.5, 1), (2.5, 2))
    builder.fill("15", "bodies", "box2", "mass")
    builder.tool("join")
    builder.tool("pulley")
    for place in ((-2, 1.5), (-2, 6), (2, 6), (2, 1.5)):
        builder.at(*place)
    builder.key(pygame.K_ESCAPE)
    builder.act("Atwood machine")
    builder.click(builder.page.palette.button("Try it").rect)

    assert builder.person.session.playing
    assert builder.clicks < 25
    level = parse(builder.editor.work.draft.text)
    assert level.checks
    assert all(result.verdict == "passed" for result in grade(simulate(level)))


@pytest.mark.parametrize("kind", thinned(kinds(), 4))
def test_every_joint_of_the_register_is_tied_with_the_mouse_and_runs(
    builder: Builder, kind: str
) -> None:
    builder.new()
    builder.tool("disc")
    builder.drag((-2, 4), (-1, 4))
    builder.drag((2, 4), (3, 4))
    builder.tool("join")
    builder.tool(kind)
    needed = len(CLICKS.get(kind, PLAIN).hints)
    places = [(-2, 4), (3, 4)] if kind == "winding" else [(-2, 4), (2, 4)]
    if kind == "pulley":
        places.insert(1, (0, 8))
    for place in places[:needed]:
        builder.at(*place)
    builder.key(pygame.K_SPACE, " ")

    assert [joint["type"] for joint in builder.document.get("joints", {}).values()] == [kind]
    assert not builder.editor.applying.refusal


def test_a_polygon_a_surface_and_a_stroke_are_drawn(builder: Builder) -> None:
    builder.new()
    builder.key(pygame.K_4, "4")
    for corner in ((-4, 1), (-2, 1), (-3, 3), (-4, 1)):
        builder.at(*corner)
    builder.key(pygame.K_5, "5")
    for point in ((1, 4), (3, 2), (6, 2)):
        builder.at(*point)
    builder.key(pygame.K_RETURN, "\r")
    builder.key(pygame.K_6, "6")
    builder.drag((-8, 5), (-5, 6))

    shapes = [body["shape"]["type"] for body in builder.document["bodies"].values()]
    assert shapes[1:3] == ["polygon", "polyline"]
    assert len(shapes) == 4
    assert builder.editor.work.draft.level is not None


def test_a_body_is_moved_turned_and_resized_by_hand(builder: Builder) -> None:
    builder.new()
    builder.key(pygame.K_3, "3")
    builder.drag((-1, 4), (1, 5))
    builder.key(pygame.K_1, "1")
    builder.drag((0.1, 4.6), (2.1, 6.6))
    assert builder.document["bodies"]["box1"]["position"] == [2, 6.5]

    builder.drag((3, 7), (4, 8))
    shape = builder.document["bodies"]["box1"]["shape"]
    assert (shape["width"], shape["height"]) == (3, 2)

    camera = builder.editor.work.camera
    stalk = camera.to_screen((2.5, 8))
    start = camera.to_world((stalk[0], stalk[1] - 30))
    builder.drag(start, (5, 7))
    angle = parse(builder.editor.work.draft.text).bodies["box1"].angle({})
    assert angle == pytest.approx(-1.5708, abs=0.1)


def test_a_body_that_is_dropped_near_the_ground_touches_it_exactly(builder: Builder) -> None:
    builder.new()
    builder.key(pygame.K_2, "2")
    builder.drag((0, 4), (0.5, 4))
    radius = builder.document["bodies"]["disc1"]["shape"]["radius"]
    builder.key(pygame.K_1, "1")
    builder.drag((0, 4), (3, radius + 0.1))

    x, y = builder.document["bodies"]["disc1"]["position"]
    assert abs(y - radius) < 1e-15
    assert x == 3


def test_alt_lets_go_of_the_grid(builder: Builder) -> None:
    builder.new()
    builder.key(pygame.K_2, "2")
    pygame.key.set_mods(pygame.KMOD_LALT)
    builder.drag((0.137, 4.0411), (0.5, 4))
    pygame.key.set_mods(pygame.KMOD_NONE)

    x, _ = builder.document["bodies"]["disc1"]["position"]
    assert x != pytest.approx(round(x * 2) / 2, abs=1e-3)


def test_a_frame_catches_several_and_shift_takes_one_out(builder: Builder) -> None:
    builder.drag((-1.5, -1), (1.5, 1))
    assert builder.editor.work.selected_bodies == ["left", "right"]

    pygame.key.set_mods(pygame.KMOD_LSHIFT)
    builder.at(-0.6, 0)
    pygame.key.set_mods(pygame.KMOD_NONE)
    assert builder.editor.work.selected_bodies == ["right"]


def test_what_is_selected_is_nudged_copied_duplicated_and_deleted(builder: Builder) -> None:
    builder.at(-0.6, 0)
    step = builder.editor.work.snapping.grid
    builder.key(pygame.K_RIGHT)
    builder.key(pygame.K_RIGHT)
    x, _ = builder.document["bodies"]["left"]["position"]
    assert x == pytest.approx(-0.6 + 2 * step)
    builder.control("z")
    assert builder.document["bodies"]["left"]["position"] == [-0.6, 0]

    builder.control("d")
    builder.control("c")
    builder.control("v")
    assert len(builder.document["bodies"]) == 4
    builder.key(pygame.K_DELETE)
    assert len(builder.document["bodies"]) == 3


def test_the_delete_tool_takes_out_a_body_and_its_joint(builder: Builder) -> None:
    builder.new()
    builder.key(pygame.K_2, "2")
    builder.drag((0, 4), (1, 4))
    builder.drag((4, 4), (5, 4))
    builder.key(pygame.K_7, "7")
    builder.tool("rod")
    builder.at(0, 4)
    builder.at(4, 4)
    assert builder.document["joints"]
    builder.key(pygame.K_8, "8")
    builder.at(0, 4)

    assert "joints" not in builder.document
    assert "disc1" not in builder.document["bodies"]


def test_escape_takes_back_what_was_begun_and_never_ends_the_app(builder: Builder) -> None:
    builder.new()
    builder.key(pygame.K_5, "5")
    builder.at(0, 1)
    builder.at(2, 1)
    for _ in range(8):
        builder.key(pygame.K_ESCAPE)

    assert builder.person.window.open
    assert builder.editor.tools.tool == "select"
    assert list(builder.document["bodies"]) == ["ground"]


@pytest.mark.sweep
def test_a_block_near_a_slope_is_laid_flat_on_it(builder: Builder) -> None:
    builder.new()
    builder.key(pygame.K_5, "5")
    for point in ((-4, 0.5), (4, 4.5)):
        builder.at(*point)
    builder.key(pygame.K_RETURN, "\r")
    builder.key(pygame.K_3, "3")
    builder.drag((-1, 3.5), (1, 4.5))
    builder.act("Lay flat")
    builder.person.wait(0.1)

    level = parse(builder.editor.work.draft.text)
    slope = 0.4636476090008061  # atan(4/8)
    assert level.bodies["box1"].angle({}) == pytest.approx(slope, abs=1e-9)
    assert builder.editor.applying.refusal == ""


def test_what_is_too_small_for_the_grid_is_drawn_on_a_finer_one(builder: Builder) -> None:
    builder.new()
    thin = 6 / builder.editor.work.camera.scale
    builder.tool("box")
    builder.drag((-2, 1), (2, 1 + thin))
    builder.tool("disc")
    builder.drag((0, 4), (0, 4 + thin))

    assert builder.document["bodies"]["box1"]["shape"]["width"] == pytest.approx(4)
    for size in (
        builder.document["bodies"]["box1"]["shape"]["height"],
        builder.document["bodies"]["disc1"]["shape"]["radius"],
    ):
        assert size == pytest.approx(thin, rel=0.4)


def test_a_peg_that_is_nearly_above_a_box_is_straight_above_it(builder: Builder) -> None:
    builder.new()
    builder.tool("box")
    builder.drag((-2, 1), (-0.5, 2))
    builder.tool("join")
    builder.tool("rope")
    builder.at(-1.25, 1.5)
    builder.at(-1.2, 6)

    assert builder.document["joints"]["rope1"]["ends"] == ["box1", [-1.25, 6]]


def test_a_joint_is_cut_by_a_click_and_a_copy_is_dragged_at_once(builder: Builder) -> None:
    builder.new()
    builder.tool("disc")
    builder.drag((0, 4), (0.5, 4))
    builder.key(pygame.K_d, mod=pygame.KMOD_CTRL)
    assert builder.editor.tools.tool == "select"
    builder.tool("join")
    builder.tool("rope")
    builder.at(0, 4)
    builder.at(0, 7)
    builder.act("Cut it in the run")

    assert builder.document["events"] == {"event1": {"at": 1, "cut": ["rope1"]}}


def test_slope_and_block_turn_together_by_one_slider(builder: Builder) -> None:
    builder.new()
    builder.clicks = 0
    builder.tool("surface")
    builder.at(-4, 4)
    builder.at(4, 0)
    builder.key(pygame.K_RETURN, "\r")
    builder.tool("box")
    builder.drag((-2, 4), (-1, 5))
    builder.tool("select")
    builder.at(-1.5, 4.5)
    builder.act("Lay flat")
    builder.act("Slider for the slope")
    builder.key(pygame.K_ESCAPE)
    builder.key(pygame.K_ESCAPE)
    builder.act("block on a slope")

    assert builder.clicks <= 10
    assert builder.document["title"] == "Block on a slope"
    assert not builder.editor.applying.refusal
    level = parse(builder.editor.work.draft.text)
    for angle in (10, 40):
        run = simulate(level, {**level.defaults, "angle": angle})
        assert {result.verdict for result in grade(run)} == {"passed"}


def test_a_seesaw_is_drawn_and_turns(builder: Builder) -> None:
    """Boxes drawn upwards from the plank's top stand on it, and it can turn on its pin."""
    builder.new()
    builder.tool("box")
    builder.drag((-3, 1), (3, 1.2))
    builder.drag((-2.6, 1.25), (-1.6, 2))
    builder.drag((1.5, 1.15), (2, 1.7))
    builder.tool("join")
    builder.tool("pivot")
    builder.at(0, 1.1)
    builder.person.wait(0.1)
    assert builder.person.window.banner._note == "Tied: box 1 to the plane"

    builder.key(pygame.K_ESCAPE)
    builder.key(pygame.K_ESCAPE)
    builder.act("lever")
    level = parse(builder.editor.work.draft.text)
    assert [result.verdict for result in grade(simulate(level))] == ["passed"]
    builder.click(builder.page.palette.button("Try it").rect)
    builder.person.wait(0.5)

    session = builder.person.session
    assert session.playing
    assert session.world.snapshot.angle[1] > 0.1


def test_a_rope_is_laid_over_a_drum_with_few_clicks(builder: Builder) -> None:
    builder.new()
    builder.clicks = 0
    builder.tool("disc")
    builder.drag((0, 5), (1, 5))
    builder.tool("box")
    builder.drag((-1.5, 2), (-0.5, 2.8))
    builder.drag((0.5, 2), (1.5, 3))
    builder.tool("select")
    builder.drag((-3, 6.5), (3, 1.5))
    builder.person.wait(0.1)
    builder.act("Rope over the disc")
    assert builder.clicks <= 8
    builder.key(pygame.K_ESCAPE)
    builder.act("capstan")
    assert len(builder.document["checks"]) == 3
    builder.click(builder.page.palette.button("Try it").rect)
    builder.person.wait(0.4)

    assert not builder.editor.applying.refusal
    assert builder.person.session.playing
    assert len(builder.document["joints"]) > 20


def test_a_string_goes_on_over_a_wheel_that_is_clicked_with_shift(builder: Builder) -> None:
    builder.new()
    builder.clicks = 0
    builder.tool("disc")
    builder.drag((0, 3), (0.5, 3))
    builder.tool("box")
    builder.drag((2.5, 3), (3.5, 4))
    builder.tool("join")
    builder.tool("pulley")
    for place in ((3, 3.5), (3, 7.5), (0.5, 7.5)):
        builder.at(*place)
    pygame.key.set_mods(pygame.KMOD_LSHIFT)
    builder.at(0, 3)
    pygame.key.set_mods(pygame.KMOD_NONE)
    builder.at(-0.5, 7.5)
    builder.key(pygame.K_RETURN, "\r")
    builder.key(pygame.K_ESCAPE)
    builder.key(pygame.K_ESCAPE)
    builder.act("block and tackle")

    assert builder.clicks <= 12
    level = parse(builder.editor.work.draft.text)
    assert [result.verdict for result in grade(simulate(level))] == ["passed"] * 3


def test_a_cradle_is_drawn_and_one_slider_draws_its_first_ball_aside(builder: Builder) -> None:
    builder.new()
    builder.clicks = 0
    builder.tool("disc")
    for x in (-1, 0, 1):
        builder.drag((x, 3), (x + 0.5, 3))
    builder.tool("join")
    builder.tool("rod")
    for x in (-1, 0, 1):
        builder.at(x, 3)
        builder.at(x, 6.5)
    builder.tool("select")
    builder.drag((-3, 3.9), (3, 2))
    builder.fill("1", "bodies", "disc1", "restitution")
    builder.key(pygame.K_ESCAPE)
    builder.at(-1, 3)
    builder.act("Slider for the swing")
    builder.key(pygame.K_ESCAPE)
    builder.act("Newton's cradle")

    assert builder.clicks <= 20
    assert builder.document["title"] == "Newton's cradle"
    assert [body.get("restitution") for body in builder.document["bodies"].values()] == [1] * 4
    level = parse(builder.editor.work.draft.text)
    for angle in (10, 50):
        run = simulate(level, {**level.defaults, "angle": angle})
        assert {result.verdict for result in grade(run)} == {"passed"}


def draw_half(builder: Builder, name: str, start: str, end: str) -> None:
    """Draw one half of a loop that a ball can enter, and that holds it."""
    builder.tool("disc")
    builder.drag((0, 2), (2, 2))
    builder.act("As an arc")
    builder.fill(start, "bodies", name, "shape", "start")
    builder.fill(end, "bodies", name, "shape", "end")
    builder.pick("left", "bodies", name, "one_way")


def test_a_marble_goes_round_a_loop_that_was_drawn_and_leaves_it(builder: Builder) -> None:
    builder.new()
    builder.clicks = 0
    draw_half(builder, "arc1", "90*deg", "270*deg")
    draw_half(builder, "arc2", "270*deg", "450*deg")
    builder.act("Reverse it in the run")
    builder.tool("disc")
    builder.drag((-6, 0.5), (-5.5, 0.5))
    builder.fill("0.2", "bodies", "disc1", "shape", "radius")
    builder.fill("0.2", "bodies", "disc1", "position", 1)
    builder.fill("12", "bodies", "disc1", "velocity", 0)
    builder.key(pygame.K_ESCAPE)
    builder.key(pygame.K_ESCAPE)
    builder.act("event1: when ...")
    builder.open("events")
    builder.open("events", "event1")
    builder.open("events", "event1", "at")
    builder.pick("down", "events", "event1", "at", "direction")

    assert builder.clicks < 30
    assert not builder.editor.applying.refusal
    world = build(parse(builder.editor.work.draft.text))
    heights = []
    for _ in range(125):
        world.advance()
        heights.append(world.snapshot.position[-1, 1])
    assert max(heights) > 3.5
    assert world.snapshot.position[-1, 0] > 4


def test_a_rail_is_seen_where_it_was_laid(builder: Builder) -> None:
    """It was invisible while building, as it runs far beyond the stage."""
    builder.new()
    builder.tool("box")
    builder.drag((0, 2), (1, 3))
    builder.tool("join")
    builder.tool("rail")
    builder.at(0.5, 2.5)
    builder.at(-2, 2.5)
    builder.tool("select")
    builder.key(pygame.K_ESCAPE)
    builder.person.wait(0.2)
    x, y = map(round, builder.person.on_screen((-3, 2.5)))
    column = builder.person.window.surface.subsurface(pygame.Rect(x, y - 3, 1, 7))
    seen = pygame.mask.from_threshold(column, theme.SURFACE_EDGE, (40, 40, 40, 255))
    assert seen.count() > 0


@pytest.mark.sweep
def test_the_page_tells_what_each_effect_costs(builder: Builder) -> None:
    builder.key(pygame.K_ESCAPE)
    builder.person.wait(0.2)
    builder.act("What does each effect cost?")
    costs = builder.editor.costs
    until(builder.person, lambda: not costs.running)
    builder.person.wait(0.2)
    shown = " ".join(
        block.text for block in mistakes_suggestions_and_effects.subject(builder.editor)
    )
    assert re.search(r"Time of a step: .*drag [+-][\d.]+ µs", shown)
    builder.at(-0.5, 0)
    builder.key(pygame.K_RIGHT)  # what was measured was of another level
    builder.key(pygame.K_ESCAPE)
    builder.person.wait(0.2)
    builder.reach(builder.page.button("What does each effect cost?"))
