"""Choices about files: recovering unsaved work, or keeping one of two versions."""

from functools import partial
from time import localtime, strftime
from typing import NamedTuple

from sandbox.app.building.button_action import ButtonAction
from sandbox.app.building.editor import Editor
from sandbox.app.runs.session import Session
from sandbox.app.words import level_translation
from sandbox.app.words.language import plural, say
from sandbox.editing.draft import Draft
from sandbox.editing.draft_recovery import Recoverable
from sandbox.editing.edits.automatic_title import is_untitled
from sandbox.model.level import Level

MOST = 6
"""The largest number of drafts that are offered."""


class RecoveryChoice(NamedTuple):
    """A choice: its text and its buttons."""

    text: str
    actions: tuple[ButtonAction, ...]


def choices(editor: Editor, session: Session) -> list[RecoveryChoice]:
    """Return the present choices."""
    found = [_recovery_choice(left, editor, session) for left in (editor.drafts.left or ())[:1]]
    if others := editor.drafts.unsaved(editor.work.draft)[:MOST]:
        actions = tuple(_open_other_draft(draft, editor, session) for draft in others)
        found.append(RecoveryChoice(say("Unsaved drawings:"), actions))
    if editor.drafts.outside:
        tip = say("read the file; Ctrl+Z brings your version back")
        reading = ButtonAction(say("Read it"), tip, editor.saving.reload)
        tip = say("overwrite it at the next save")
        mine = ButtonAction(say("Keep mine"), tip, partial(_keep_mine, editor))
        found.append(RecoveryChoice(say("Another program has changed the file."), (reading, mine)))
    return found


def _open_other_draft(draft: Draft, editor: Editor, session: Session) -> ButtonAction:
    """Return the button that opens another draft."""
    level = draft.level
    title = say("a level with mistakes")
    if level is not None:
        title = _name_of(level)
    caption = title if draft.path is None else draft.path.name
    tip = say("go on with it")
    if level is not None:
        count = len(level.bodies)
        tip = plural("{count} body; go on with it", "{count} bodies; go on with it", count)
    return ButtonAction(caption, tip, partial(editor.begin, session, draft))


def _name_of(level: Level) -> str:
    """Return the name of a level; without a title, it is named after its latest body."""
    if is_untitled({"title": level.title}):
        return say("Untitled, with {body}", body=list(level.bodies)[-1])
    return level_translation.title_of_level(level)


def _recovery_choice(left: Recoverable, editor: Editor, session: Session) -> RecoveryChoice:
    name = left.path.name if left.path else say("a level without a file")
    when = strftime("%Y-%m-%d %H:%M", localtime(left.when))
    going_on = partial(recover, left, editor, session)
    act = ButtonAction(say("Recover"), say("go on with it"), going_on)
    forget = ButtonAction(say("Forget it"), say("delete it"), partial(_discard, left, editor))
    message = say("What was drawn in {name} ({when}) was not saved.", name=name, when=when)
    return RecoveryChoice(message, (act, forget))


def recover(left: Recoverable, editor: Editor, session: Session) -> None:
    """Continue an earlier window's draft; once this window keeps it, it is no longer offered."""
    editor.begin(session, left.draft())
    if why := editor.drafts.keep():
        editor.work.show_message(say(why))
    else:
        _discard(left, editor)


def _discard(left: Recoverable, editor: Editor) -> None:
    editor.drafts.forget(left)
    editor.bench.show()


def _keep_mine(editor: Editor) -> None:
    editor.drafts.keep_mine(editor.work.draft)
    editor.bench.show()
