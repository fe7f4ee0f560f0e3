"""The dialog for choosing a file."""

import locale
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pygame
from pygame_gui import (
    UI_FILE_DIALOG_PATH_PICKED,
    UI_SELECTION_LIST_DOUBLE_CLICKED_SELECTION,
    UI_TEXT_ENTRY_FINISHED,
    UIManager,
)
from pygame_gui.windows import UIFileDialog

from sandbox.app.drawing.text import legible
from sandbox.app.widgets.text_field import TextField
from sandbox.app.words.language import say

SIZE = 560, 460  # px, if there is room
SMALLEST = 260, 300  # px, the minimum of pygame_gui


class FileDialog(UIFileDialog):
    """A dialog that opens a level in a folder; it neither writes nor removes files."""

    def __init__(self, manager: UIManager, stage: pygame.Rect, folder: Path) -> None:
        room = stage.inflate(-20, -20).size
        size = [max(min(a, b), c) for a, b, c in zip(SIZE, room, SMALLEST, strict=True)]
        rect = pygame.Rect((0, 0), size)
        rect.center = stage.center
        with _as_before():
            super().__init__(
                rect, manager, say("Open a level"), {".json"}, str(_nameable(folder)),
                allow_existing_files_only=True,
            )  # fmt: skip
        self._take_letters_that_can_be_drawn(manager)
        self.delete_button.hide()  # type: ignore[no-untyped-call]
        self.set_blocking(True)

    def _take_letters_that_can_be_drawn(self, manager: UIManager) -> None:
        """Replace pygame_gui's field by the app's own."""
        line = self.file_path_text_line
        self.file_path_text_line = TextField(
            line.relative_rect, manager, container=self, initial_text=line.get_text(),
            anchors={"left": "left", "right": "right", "top": "top", "bottom": "top"},
        )  # fmt: skip
        line.kill()  # type: ignore[no-untyped-call]

    def picked(self, event: pygame.event.Event) -> Path | None:
        """Return the file that was chosen by the button, Enter or a double click, or None."""
        element = getattr(event, "ui_element", None)
        if event.type == UI_FILE_DIALOG_PATH_PICKED and element is self:
            return Path(event.text)
        path = None
        if event.type == UI_TEXT_ENTRY_FINISHED and element is self.file_path_text_line:
            path = Path(os.path.expanduser(event.text))  # an unknown ~name stays
        elif (
            event.type == UI_SELECTION_LIST_DOUBLE_CLICKED_SELECTION
            and element is self.file_selection_list
        ):
            path = Path(self.current_directory_path) / event.text
        return path if path is not None and os.path.isfile(path) else None

    def _create_list_of_directories_and_files_on_current_path(self) -> None:
        """Leave out hidden files, and names that cannot be drawn."""
        super()._create_list_of_directories_and_files_on_current_path()  # type: ignore[no-untyped-call]
        self.current_file_list = [
            each
            for each in self.current_file_list
            if each[0] == legible(each[0]) and not each[0].startswith(".")
        ]


def _nameable(folder: Path) -> Path:
    """Return a folder, or the nearest one above it whose path can be drawn."""
    shown = (each for each in (folder, *folder.parents) if str(each) == legible(str(each)))
    return next(shown, Path("/"))


@contextmanager
def _as_before() -> Iterator[None]:
    """Restore the process's locale afterwards, since pygame_gui's dialog sets it."""
    before, wanted = locale.setlocale(locale.LC_ALL), os.environ.get("LC_ALL")
    try:
        locale.setlocale(locale.LC_ALL, "")
    except locale.Error:
        os.environ["LC_ALL"] = "C"
    try:
        yield
    finally:
        locale.setlocale(locale.LC_ALL, before)
        if wanted is not None:
            os.environ["LC_ALL"] = wanted
        else:
            os.environ.pop("LC_ALL", None)
