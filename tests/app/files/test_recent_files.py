"""Recently opened files are listed, and a dialog opens a file."""

import locale
from pathlib import Path

import numpy as np
import pygame
import pytest

from sandbox.app.files import recent_files, save_folder
from sandbox.app.files.recent_files import RecentFiles
from sandbox.app.window import Window
from sandbox.model import level_catalog
from tests.app import scenes
from tests.app.person import Person


@pytest.fixture
def own(tmp_path: Path) -> Path:
    path = tmp_path / "own" / "mine.json"
    path.parent.mkdir()
    path.write_text(scenes.falling(), encoding="utf-8")
    return path


def test_a_dropped_file_is_there_when_the_window_is_opened_again(person: Person, own: Path) -> None:
    pygame.event.post(pygame.Event(pygame.DROPFILE, file=str(own)))
    person.wait()
    person.window.close()

    again = Window((1280, 800))

    assert again.panels.list is not None
    first = again.panels.list.matching_levels[0]
    assert (first.path, first.chapter, first.title) == (own, "opened", "A falling ball")


def test_levels_of_the_catalogue_are_not_kept(person: Person) -> None:
    person.window.open_level("kinematics/free-fall")

    assert RecentFiles().paths == ()


def test_the_latest_comes_first_and_once(tmp_path: Path) -> None:
    paths = [tmp_path / f"{i}.json" for i in range(recent_files.MOST + 3)]
    files = RecentFiles()
    for path in (*paths, paths[5]):
        path.touch()
        assert files.add(path) == ""

    assert RecentFiles().paths[0] == paths[5]
    assert len(RecentFiles().paths) == len(set(RecentFiles().paths)) == recent_files.MOST


def test_a_file_that_is_gone_is_left_out(own: Path) -> None:
    RecentFiles().add(own)
    own.unlink()

    assert RecentFiles().paths == ()


def test_two_windows_keep_each_others_files(own: Path, tmp_path: Path) -> None:
    one, other = RecentFiles(), RecentFiles()
    one.add(own)
    another = tmp_path / "another.json"
    another.touch()
    other.add(another)

    assert RecentFiles().paths == (another, own)


@pytest.mark.parametrize(
    "content", [b"", b"{", b"{}", b"[1]", b'["relative.json"]', b'["/a\\u0000b"]', b"\xff\xfe"]
)
def test_a_file_that_something_else_has_written_counts_as_none(content: bytes, own: Path) -> None:
    recent_files.file().parent.mkdir(parents=True)
    recent_files.file().write_bytes(content)

    assert RecentFiles().paths == ()
    assert RecentFiles().add(own) == ""
    assert RecentFiles().paths == (own,)


def test_what_cannot_be_kept_is_told_once_and_the_level_opens(
    person: Person, own: Path, tmp_path: Path
) -> None:
    (tmp_path / "recent").write_text("a file where the folder should be")

    person.window.open_level(str(own))
    person.wait()

    assert person.session.level.title == "A falling ball"
    assert "could not be saved" in person.window.banner._note


def dialog(person: Person, folder: Path) -> None:
    """Ask for a file, with another one opened before."""
    RecentFiles().add(folder / "mine.json")
    person.window.files.recent = RecentFiles()
    person.press(pygame.K_o, "\x0f", pygame.KMOD_LCTRL)
    assert person.window.panels.dialog is not None


def test_a_file_is_chosen_in_a_dialog(person: Person, own: Path) -> None:
    dialog(person, own.parent)
    shown = person.window.panels.dialog
    assert shown is not None
    (item,) = (each["button_element"] for each in shown.file_selection_list.item_list)
    assert item is not None

    person.click(item.rect)
    person.wait(0.1)
    person.click(shown.ok_button.rect)
    person.wait(0.1)

    assert person.session.level.title == "A falling ball"
    assert person.window.panels.dialog is None


def test_the_dialog_begins_where_files_are_saved(
    person: Person, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing was opened yet; it began in the home folder, where the saved files are not."""
    monkeypatch.setattr(save_folder, "folder", lambda: tmp_path)
    (tmp_path / "saved.json").write_text("{}", encoding="utf-8")

    person.press(pygame.K_o, "\x0f", pygame.KMOD_LCTRL)

    assert person.window.panels.dialog is not None
    items = person.window.panels.dialog.file_selection_list.item_list
    assert "saved.json" in [each["text"] for each in items]


@pytest.mark.parametrize("name", ["dark", "light", "contrast"])
def test_the_files_of_the_dialog_can_be_read_in_every_theme(
    person: Person, own: Path, name: str
) -> None:
    """They were dark on dark in the light one."""
    person.window.comfort.choose(theme=name)
    person.window.apply_preferences()

    dialog(person, own.parent)

    assert person.window.panels.dialog is not None
    (item,) = person.window.panels.dialog.file_selection_list.item_list
    button = item["button_element"]
    assert button is not None
    shown = pygame.surfarray.array3d(person.window.surface.subsurface(button.rect)).astype(int)
    corner = shown[-2, 2]
    assert np.abs(shown - corner).sum(axis=2).max() > 300


def test_a_path_is_typed_into_the_dialog(person: Person, own: Path) -> None:
    dialog(person, own.parent)
    shown = person.window.panels.dialog
    assert shown is not None
    person.click(shown.file_path_text_line.rect)
    shown.file_path_text_line.set_text(str(own))

    person.press(pygame.K_RETURN, "\r")

    assert person.session.level.title == "A falling ball"


def test_while_a_file_is_chosen_letters_are_no_commands_and_escape_ends_it(
    person: Person, own: Path
) -> None:
    person.window.open_level("kinematics/free-fall")
    person.wait()
    dialog(person, own.parent)

    person.press(pygame.K_SPACE, " ")
    assert not person.session.playing
    person.press(pygame.K_ESCAPE)

    assert person.window.panels.dialog is None
    assert person.window.open
    person.press(pygame.K_SPACE, " ")
    assert person.session.playing


def test_the_dialog_is_left_by_its_own_buttons(person: Person, own: Path) -> None:
    dialog(person, own.parent)
    shown = person.window.panels.dialog
    assert shown is not None

    person.click(shown.cancel_button.rect)
    person.wait(0.1)

    assert person.window.panels.dialog is None
    assert not person.window.panels.typing


def test_nothing_can_be_removed_in_the_dialog(person: Person, own: Path) -> None:
    dialog(person, own.parent)
    shown = person.window.panels.dialog
    assert shown is not None

    person.click(shown.delete_button.rect)
    person.wait(0.1)

    assert not shown.delete_button.visible
    assert own.is_file()


@pytest.mark.parametrize("name", ["\u200b", "a\u202eb", "née\u0301", "日本語", ".hidden"])
def test_any_name_of_a_file_may_stand_in_the_folder(person: Person, own: Path, name: str) -> None:
    (own.parent / f"{name}.json").touch()
    (own.parent / name).mkdir()

    dialog(person, own.parent)
    person.wait(0.1)

    assert person.window.panels.dialog is not None


def test_the_dialog_leaves_the_locale_alone(
    person: Person, own: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LC_ALL", "no_SUCH.locale")
    before = locale.setlocale(locale.LC_ALL)

    dialog(person, own.parent)

    assert locale.setlocale(locale.LC_ALL) == before


def test_letters_without_width_are_not_taken(person: Person, own: Path) -> None:
    dialog(person, own.parent)
    shown = person.window.panels.dialog
    assert shown is not None
    before = shown.file_path_text_line.get_text()
    person.click(shown.file_path_text_line.rect)

    person.press(0, "\u200b")

    assert shown.file_path_text_line.get_text() == before


def test_in_a_tiny_window_it_is_told_what_is_missing(person: Person) -> None:
    person.resize((320, 200))
    person.press(pygame.K_o, "\x0f", pygame.KMOD_LCTRL)

    assert person.window.panels.dialog is None
    assert "Make the window larger" in person.window.banner._note


@pytest.mark.parametrize("size", [(480, 300), (900, 600)])
def test_the_dialog_has_room_in_a_small_window(
    person: Person, own: Path, size: tuple[int, int]
) -> None:
    person.resize(size)

    dialog(person, own.parent)
    person.wait(0.1)

    assert person.window.panels.dialog is not None


def test_a_file_opened_from_the_catalogues_folder_is_no_file_of_ones_own() -> None:
    assert level_catalog.find("kinematics/free-fall").resolve().is_relative_to(level_catalog.root())
