"""A built level is run, undone and saved, and never lost."""

import json
from pathlib import Path

import pygame
import pytest

from sandbox.app.building.draft_recovery_and_conflict_choices import choices
from sandbox.app.building.editor import Editor
from sandbox.app.building.kept_drafts import OFTEN
from sandbox.app.window import Window
from sandbox.model import level_catalog, unsaved_files
from tests.app.building.builder import Builder
from tests.app.person import Person


@pytest.fixture
def mine(person: Person, tmp_path: Path) -> Builder:
    """Somebody at the Build page of a level of their own."""
    person.open(tmp_path, level_catalog.find("newton/atwood").read_text(encoding="utf-8"))
    return Builder(person)


def file_of(builder: Builder) -> Path:
    path = builder.editor.work.draft.path
    assert path is not None
    return path


@pytest.mark.sweep
def test_the_run_stands_at_its_start_while_building_and_comes_back_there(mine: Builder) -> None:
    mine.at(-0.6, 0)
    mine.key(pygame.K_LEFT)
    text = mine.editor.work.draft.text
    mine.key(pygame.K_SPACE, " ")
    mine.person.wait(0.3)
    assert mine.person.session.world.steps > 3
    mine.key(pygame.K_ESCAPE)

    assert mine.person.session.world.steps == 0
    assert not mine.person.session.playing
    assert mine.editor.work.draft.text == text


def test_the_run_is_that_of_what_was_built(mine: Builder) -> None:
    mine.key(pygame.K_2, "2")
    mine.drag((1.5, 2), (2, 2))
    mine.key(pygame.K_SPACE, " ")
    mine.person.wait(0.2)

    assert "disc1" in mine.person.session.level.bodies
    assert mine.person.session.world.steps > 0


def test_undo_and_redo_take_back_everything_and_do_it_again(mine: Builder) -> None:
    first = mine.editor.work.draft.text
    mine.key(pygame.K_2, "2")
    for x in range(5):
        mine.drag((x - 2, 3), (x - 1.8, 3))
    last = mine.editor.work.draft.text
    for _ in range(5):
        mine.control("z")
    assert mine.editor.work.draft.text == first
    for _ in range(4):
        mine.control("y")
    mine.control("z", pygame.KMOD_SHIFT)

    assert mine.editor.work.draft.text == last


def test_redo_goes_through_a_run_to_what_was_drawn_after_it(mine: Builder) -> None:
    """Redo restores the first drawing, then the run, then the second drawing."""
    mine.key(pygame.K_2, "2")
    mine.drag((1.5, 2), (2, 2))
    between = mine.editor.work.draft.text
    mine.key(pygame.K_SPACE, " ")
    mine.person.wait(0.3)
    mine.key(pygame.K_ESCAPE)
    mine.drag((-1.5, 2), (-1.3, 2))
    last = mine.editor.work.draft.text
    assert "disc2" in last
    for _ in range(2):
        mine.control("z")

    mine.control("y")
    assert mine.editor.work.draft.text == between
    mine.control("y")
    assert mine.editor.trying.is_shown(mine.person.session)
    assert mine.editor.trying.redo_description(mine.person.session) is not None
    mine.control("y")
    assert mine.editor.work.draft.text == last
    assert not mine.editor.trying.is_shown(mine.person.session)


def test_an_overlap_is_told_in_words_and_cannot_be_run(mine: Builder) -> None:
    mine.new()
    mine.key(pygame.K_3, "3")
    mine.drag((-1, 2), (1, 4))
    mine.drag((0, 3), (2, 5))
    mine.person.wait(0.1)
    assert {"box1", "box2"} & mine.editor.applying.culprits
    mine.key(pygame.K_SPACE, " ")
    assert not mine.person.session.playing
    assert "overlap" in mine.editor.applying.refusal

    mine.control("z")
    mine.person.wait(0.1)
    assert mine.editor.applying.refusal == ""


def test_a_level_that_was_not_touched_is_saved_as_it_was(mine: Builder) -> None:
    before = file_of(mine).read_bytes()
    mine.control("s")

    assert file_of(mine).read_bytes() == before


@pytest.mark.sweep
@pytest.mark.all_levels
def test_every_level_opens_in_the_editor_and_is_saved_byte_for_byte(
    person: Person, tmp_path: Path
) -> None:
    person.window.open_level("newton/atwood")
    person.wait()
    builder = Builder(person)
    different = []
    for name in level_catalog.names():
        path = level_catalog.find(name)
        person.window.open_level(name)
        builder.key(pygame.K_b, "b")  # a challenge opens with a page of its own
        copy = tmp_path / f"{name.replace('/', '-')}.json"
        builder.editor.saving.save(copy)
        if copy.read_bytes() != path.read_bytes():
            different.append(name)

    assert different == []


def test_a_new_level_is_saved_under_the_name_that_is_typed(mine: Builder, tmp_path: Path) -> None:
    mine.new()
    mine.key(pygame.K_2, "2")
    mine.drag((0, 3), (1, 3))
    mine.control("s")
    mine.person.wait(0.1)
    assert mine.page._name is not None
    mine.page._name.set_text(str(tmp_path / "mine.json"))
    mine.act("Save here")
    mine.person.wait(0.1)

    assert "disc1" in json.loads((tmp_path / "mine.json").read_text(encoding="utf-8"))["bodies"]
    assert mine.person.window.path == tmp_path / "mine.json"
    mine.control("z")
    assert list(mine.document["bodies"]) == ["ground"]
    mine.control("y")
    assert (mine.document["title"], "disc1" in mine.document["bodies"]) == ("Mine", True)


def test_a_level_is_saved_from_any_page(mine: Builder) -> None:
    mine.at(-0.6, 0)
    mine.key(pygame.K_LEFT)
    mine.person.wait(0.3)
    mine.key(pygame.K_o, "o")
    mine.control("s")
    assert file_of(mine).read_text("utf-8") == mine.editor.work.draft.text

    mine.new()
    mine.key(pygame.K_g, "g")
    mine.control("s")
    mine.person.wait(0.1)
    assert mine.page._name is not None


def test_what_is_done_again_is_selected_as_it_was(mine: Builder) -> None:
    mine.at(-0.6, 0)
    mine.control("d")
    copies = mine.editor.work.selected
    assert copies
    mine.control("z")
    mine.control("y")
    assert mine.editor.work.selected == copies


@pytest.mark.parametrize(
    ("file", "title"), [("a-seesaw.json", "A seesaw"), ("Zwei Kinder", "Zwei Kinder")]
)
def test_the_name_of_its_file_becomes_the_title_of_a_level_that_has_none(
    mine: Builder, tmp_path: Path, file: str, title: str
) -> None:
    mine.new()
    mine.key(pygame.K_2, "2")
    mine.drag((0, 3), (1, 3))
    assert "summary" not in mine.document  # that there is nothing on the ground yet
    mine.control("s")
    mine.person.wait(0.1)
    assert mine.page._name is not None
    mine.page._name.set_text(str(tmp_path / file))
    mine.act("Save here")
    mine.person.wait(0.1)
    assert mine.document["title"] == title

    mine.key(pygame.K_ESCAPE)
    mine.key(pygame.K_ESCAPE)
    mine.fill("Another one", "title")
    mine.control("s", pygame.KMOD_SHIFT)
    mine.person.wait(0.1)
    mine.page._name.set_text(str(tmp_path / "other.json"))
    mine.act("Save here")
    mine.person.wait(0.1)
    assert json.loads((tmp_path / "other.json").read_text("utf-8"))["title"] == "Another one"


@pytest.mark.sweep
def test_a_set_up_that_is_recognised_gives_the_level_its_title(builder: Builder) -> None:
    builder.new()
    builder.tool("disc")
    builder.drag((0, 3), (1, 3))
    builder.key(pygame.K_ESCAPE)
    builder.key(pygame.K_ESCAPE)
    builder.act("falling body")
    assert builder.document["title"] == "Falling body"
    builder.control("z")
    assert builder.document["title"] == "New level"


def test_another_level_and_back_loses_nothing(mine: Builder) -> None:
    mine.key(pygame.K_2, "2")
    mine.drag((1.5, 2), (2, 2))
    path, text = file_of(mine), mine.editor.work.draft.text
    mine.person.window.open_level("newton/incline")
    mine.person.wait(0.1)
    mine.person.window.open_level(str(path))
    mine.person.wait(0.1)

    assert mine.editor.work.draft.text == text
    assert "disc1" in mine.person.session.level.bodies


def test_what_was_not_saved_is_offered_to_the_next_window(mine: Builder) -> None:
    mine.key(pygame.K_2, "2")
    mine.drag((1.5, 2), (2, 2))
    mine.person.wait(OFTEN + 0.1)
    text = mine.editor.work.draft.text
    unsaved_files._OPEN.clear()  # as if the process had ended

    window = Window((1280, 800))
    window.open_level("newton/incline")
    after = Builder(Person(window))
    after.person.wait(0.1)
    after.act("Recover")
    after.person.wait(0.1)

    assert after.editor.work.draft.text == text
    assert choices(after.editor, after.person.session) == []


def test_a_file_that_was_changed_outside_is_told_and_not_written_over(mine: Builder) -> None:
    path = file_of(mine)
    outside = path.read_text(encoding="utf-8").replace("Atwood machine", "Changed outside")
    path.write_text(outside, encoding="utf-8")
    mine.key(pygame.K_2, "2")
    mine.drag((1.5, 2), (2, 2))
    mine.person.wait(OFTEN + 0.1)
    mine.control("s")
    assert path.read_text(encoding="utf-8") == outside

    mine.act("Read it")
    mine.person.wait(0.1)
    assert mine.person.session.level.title == "Changed outside"


def test_the_help_tells_the_keys_of_the_page_while_it_is_open(mine: Builder) -> None:
    mine.key(pygame.K_F1)
    mine.key(pygame.K_2, "2")
    assert mine.editor.tools.tool == "select"  # the help is open: keys are for it
    mine.key(pygame.K_F1)
    mine.key(pygame.K_o, "o")
    mine.key(pygame.K_2, "2")

    assert mine.editor.tools.tool == "select"


def test_while_another_page_is_open_the_hand_is_back(mine: Builder) -> None:
    mine.key(pygame.K_o, "o")
    before = mine.editor.work.draft.text
    mine.person.drag(mine.person.on_screen((-0.6, 0)), mine.person.on_screen((-0.6, 1)))

    assert mine.person.session.world.disturbed
    assert mine.editor.work.draft.text == before


def test_there_is_one_editor_a_window(mine: Builder) -> None:
    assert mine.page._editor is mine.person.window.workers.of(Editor)


@pytest.mark.parametrize(
    ("level", "body"), [("momentum/cradle", "ball3"), ("machines/two-carts", "left_frame")]
)
def test_what_repeats_is_written_out_by_the_first_edit_and_comes_back_with_undo(
    builder: Builder, level: str, body: str
) -> None:
    builder.person.window.open_level(level)
    builder.person.wait(0.1)
    work = builder.editor.work
    typed = work.draft.text
    assert f'"{body}": {{' not in typed

    work.select([("bodies", body)])
    builder.person.wait(0.1)  # the inspector shows it
    builder.key(pygame.K_RIGHT)

    assert f'"{body}": {{' in work.draft.text
    assert work.draft.level is not None
    builder.control("z")
    assert work.draft.text == typed


def test_a_file_that_was_broken_outside_is_not_taken_over(mine: Builder) -> None:
    file_of(mine).write_text("[1", encoding="utf-8")
    mine.editor.saving.reload()
    mine.person.wait(0.1)

    assert mine.editor.work.draft.level is not None
    mine.key(pygame.K_o, "o")
    mine.key(pygame.K_b, "b")
    mine.person.wait(0.1)
    assert mine.editor.work.draft.level is not None


def test_to_keep_ones_own_overwrites_no_other_file(mine: Builder, tmp_path: Path) -> None:
    other = tmp_path / "other.json"
    other.write_text("precious", encoding="utf-8")
    mine.editor.drafts.keep_mine(mine.editor.work.draft)

    mine.editor.saving.save(other)

    assert other.read_text(encoding="utf-8") == "precious"
