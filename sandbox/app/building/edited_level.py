"""The level under edit as the tools see it: its text, drawing, selection and changes."""

import json
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any, TypeVar

from sandbox.app.building.mouse_position import Part
from sandbox.app.building.partial_level import PartialLevel
from sandbox.app.building.snapping import Snapping
from sandbox.app.drawing.camera import Camera
from sandbox.app.words.language import later, say
from sandbox.editing import suggested_checks
from sandbox.editing.draft import Draft
from sandbox.editing.edits import bodies, copying, grouping, moving_and_aligning
from sandbox.editing.edits.edit_result import EditResult
from sandbox.editing.written_out_shorthand import expanded
from sandbox.model.comments import members
from sandbox.model.errors import LevelError, Mistake, SandboxError
from sandbox.model.level import Level
from sandbox.model.shapes import XY
from sandbox.model.translatable_message import Message

ASIDE = 40.0  # px, from the original to its copy
MARGIN = 6.0  # px, the largest distance at which a click is on a part

Found = TypeVar("Found")


class EditedLevel:
    """The level under edit.

    Attributes
    ----------
    fixed
        The fields of bodies that cannot be set.
    draft
        The level's text, with its undo steps and its file.
    text
        The edited text: that of the draft, with repetitions and placed groups written out.
    document
        The data of the text.
    sketch
        The drawing of the text.
    camera
        The camera of the stage.
    selected
        The selected parts, the latest last.
    ignored
        The bodies to which nothing snaps, since they are being moved.
    version
        An object that differs after every change of the text.
    news
        An object that differs whenever the display must change.
    """

    fixed: Collection[str] = ()

    def __init__(self) -> None:
        self.camera = Camera((1, 1))
        self.ignored: frozenset[str] = frozenset()
        self.snapping = Snapping(self)
        self._message: str | None = None
        self.selected: tuple[Part, ...] = ()
        self._copied = ""
        self._left: list[tuple[Part, ...]] = []  # the selection when each step was undone
        self._cache: tuple[object, dict[object, Any]] = (None, {})
        self.edit_draft(Draft.empty())

    def edit_draft(self, draft: Draft) -> None:
        """Edit another level."""
        self.draft, self.selected = draft, ()
        self._left.clear()
        self.refresh()

    def refresh(self) -> None:
        """Draw the present text."""
        self.text = expanded(self.draft.text)
        self.document: Mapping[str, Any] = json.loads(self.text, object_pairs_hook=members)
        self.sketch = PartialLevel(self.document)
        self.version = object()
        self.select(self.selected)

    def cached(self, compute: Callable[[Level], Found]) -> Found:
        """Return the result of a function of the level, cached until the level changes."""
        if self._cache[0] is not self.version:
            self._cache = self.version, {}
        computed = self._cache[1]
        if compute not in computed:
            computed[compute] = compute(self.level)
        found: Found = computed[compute]
        return found

    def show(self) -> None:
        """Let the page be drawn again."""
        self.news = object()

    def show_message(self, text: str) -> None:
        """Show a message in the banner."""
        self._message = text

    def take_message(self) -> str | None:
        """Return the latest message, once."""
        message, self._message = self._message, None
        return message

    # changes

    def replace_text(self, text: str, caption: str, merge: str | None = None) -> None:
        """Replace the text; suggested checks are adapted to it."""
        if text != self.text:
            text = self._with_updated_checks(text)
            if self.text != self.draft.text:
                self.show_message(
                    say("Repeated parts and groups are written out now; Ctrl Z brings them back")
                )
            self.draft.change(text, caption, merge)
            self._left.clear()
        self.refresh()

    def _with_updated_checks(self, text: str) -> str:
        level = self.draft.level
        found = text if level is None else suggested_checks.with_updated_checks(level, text)
        if found.count('"formula"') < text.count('"formula"'):
            self.show_message(
                say("The suggested checks were removed with the parts that they were about")
            )
        return found

    def change(
        self, caption: str, edit: Callable[[str, Level], str], merge: str | None = None
    ) -> bool:
        """Change the level, and return whether that was possible."""
        try:
            self.replace_text(edit(self.text, self.level), caption, merge)
        except LevelError as error:
            self.show_message(say(_first(error.mistakes)))
            return False
        except SandboxError as error:
            self.show_message(say(error.message))
            return False
        return True

    @property
    def level(self) -> Level:
        """The level of the text; raise `SandboxError` if the text has mistakes."""
        level = self.draft.level
        if level is None:
            raise SandboxError(self.mistake)
        return level

    @property
    def mistake(self) -> Message:
        """The first mistake of the text."""
        return _first(self.draft.mistakes)

    def add_parts(
        self, caption: str, edit: Callable[[str, Level], EditResult], family: str = "bodies"
    ) -> bool:
        """Add parts to the level and select them, and return whether that was possible."""
        names: list[str] = []

        def made(text: str, level: Level) -> str:
            found = edit(text, level)
            names.extend(found.names)
            return found.text

        done = self.change(caption, made)
        if done:
            self.select([(family, name) for name in names])
        return done

    def undo(self) -> None:
        """Undo the last step."""
        messages = later("Undone: {step}"), later("Nothing to undo")
        if self.draft.undo_description:
            self._left.append(self.selected)
        self._stepped(*messages, self.draft.undo())

    def redo(self) -> None:
        """Redo the last undone step, and restore the selection that it had left."""
        messages = later("Done again: {step}"), later("Nothing to redo")
        self._stepped(*messages, self.draft.redo())
        if self._left:
            self.select(self._left.pop())

    def _stepped(self, done: str, otherwise: str, step: str | None) -> None:
        self.show_message(say(done, step=step) if step else say(otherwise))
        self.refresh()

    def delete(self) -> None:
        """Delete the selection."""
        names = [name for _, name in self.selected]
        if names:
            caption = say("delete {names}", names=", ".join(names))
            self.change(caption, lambda text, level: bodies.remove_parts(text, level, names))

    def nudge(self, across: int, upwards: int, share: float) -> None:
        """Move the selected bodies by a share of a step of the grid."""
        step, names = self.snapping.grid * share, self.selected_bodies
        by = across * step, upwards * step
        if names:
            self.change(
                say("move"), lambda t, level: moving_and_aligning.move(t, level, names, by), "nudge"
            )

    def copy(self) -> None:
        """Copy the selected bodies, with the joints among them."""
        try:
            self._copied = copying.copy(self.text, self.level, self.selected_bodies)
        except SandboxError as error:
            self.show_message(say(error.message))

    def paste(self) -> None:
        """Paste the copied bodies beside the originals, and select them."""
        copied, by = self._copied, self._copy_displacement
        self.add_parts(say("paste"), lambda text, level: copying.paste(text, level, copied, by))

    def duplicate(self) -> None:
        """Duplicate the selected bodies beside the originals, and select the copies."""
        names, by = self.selected_bodies, self._copy_displacement
        self.add_parts(
            say("duplicate"), lambda text, level: copying.duplicate(text, level, names, by)
        )

    def group(self) -> None:
        """Make the selected bodies a group, which is selected as a whole."""
        names = self.selected_bodies
        if self.change(say("group"), lambda text, level: grouping.group(text, level, names)):
            self.show_message(
                say("A click now selects the group; a second click selects the body alone")
            )

    def ungroup(self) -> None:
        """Ungroup the selected bodies, so that each is selected alone again."""
        names = self.selected_bodies
        self.change(say("ungroup"), lambda text, level: grouping.ungroup(text, level, names))

    @property
    def _copy_displacement(self) -> XY:
        """The displacement of copies [m]."""
        return ASIDE / self.camera.scale, ASIDE / self.camera.scale

    # selection

    def select(self, parts: Sequence[Part]) -> None:
        """Replace the selection by those parts that exist."""
        existing: Mapping[str, Collection[str]] = {
            "bodies": self.sketch.bodies,
            "joints": self.sketch.joints,
        }
        self.selected = tuple((f, n) for f, n in parts if n in existing[f])
        self.show()

    def select_all(self) -> None:
        """Select all bodies and joints."""
        found = [("bodies", name) for name in self.sketch.bodies]
        self.select([*found, *(("joints", name) for name in self.sketch.joints)])

    @property
    def selected_bodies(self) -> list[str]:
        """The selected bodies."""
        return [name for family, name in self.selected if family == "bodies"]

    @property
    def groups(self) -> Sequence[Sequence[str]]:
        """The groups of bodies; none while the level has mistakes."""
        return self.draft.level.view.together if self.draft.level else ()

    def with_group(self, part: Part) -> tuple[Part, ...]:
        """Return a part, with the other bodies of its group if it has one."""
        family, name = part
        if family != "bodies" or self.draft.level is None:
            return (part,)
        return tuple((family, other) for other in grouping.group_of(self.draft.level, name))

    def part_at(self, pixel: XY) -> Part | None:
        """Return the body or joint at a pixel: pins, moving bodies, other joints, other bodies."""
        reach, point = MARGIN / self.camera.scale, self.camera.to_world(pixel)
        joint = self.sketch.joint_at(point, reach)
        body = self.sketch.body_at(point, 0.0 if joint else reach)
        covered = body is not None and self.sketch.bodies[body].outline.moves
        if joint and (self.sketch.is_pin(joint) or not covered):
            return "joints", joint
        return ("bodies", body) if body else None


def _first(mistakes: Sequence[Mistake]) -> Message:
    """Return the first of some mistakes, without its line, as the text is not visible."""
    first = mistakes[0]
    if not first.path:
        return first.rule
    return Message("{path}: {rule}", path=first.path, rule=first.rule)
