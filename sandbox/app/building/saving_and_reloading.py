"""The file of the level under edit: save, save as, and reload."""

from pathlib import Path

from sandbox.app.building.current_tool import CurrentTool
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.kept_drafts import Drafts
from sandbox.app.words.language import say
from sandbox.editing.edits.automatic_title import entitled_by
from sandbox.model.errors import SandboxError


class Saving:
    """Saves the level under edit."""

    def __init__(self, work: EditedLevel, drafts: Drafts, tools: CurrentTool) -> None:
        self._work, self._drafts, self._tools = work, drafts, tools
        self.naming = False
        """Whether the page asks for a name to save under."""

    def save(self, path: Path | None = None, *, overwrite: bool = False) -> None:
        """Save the level to its file, or to another.

        If it has no file of its own, as a level of the project, a name is asked for.
        """
        work, draft = self._work, self._work.draft
        if path is None and not self._drafts.is_own(draft):
            self.save_as()
            return
        if path is not None:
            draft.amend(entitled_by(draft.text, path), say("give it a title"))
            work.refresh()
        try:
            self._drafts.save(draft, path, overwrite=overwrite)
        except SandboxError as error:
            work.show_message(say(error.message))
            return
        self.naming = False
        work.show_message(say("Saved {path}", path=draft.path))

    def save_as(self) -> None:
        """Ask for the name under which to save."""
        self.naming = True
        self._tools.bench.show()

    def stop_naming(self) -> None:
        """Stop asking for a name."""
        self.naming = False
        self._tools.bench.show()

    def reload(self) -> None:
        """Read the file again, as an undoable step."""
        try:
            self._work.draft.reload()
        except SandboxError as error:
            self._work.show_message(say(error.message))
            return
        self._drafts.outside = False
        self._work.refresh()
        self._work.show_message(say("Read again; Ctrl+Z brings your version back"))

    @property
    def proposed(self) -> Path:
        """The proposed name of the file."""
        return self._drafts.proposed(self._work.draft, str(self._work.document.get("title", "")))
