"""The blocks of the page besides the fields: mistakes, offers, suggestions, effects."""

from collections.abc import Iterable
from functools import partial
from typing import NamedTuple

from sandbox.app.building import editable_fields, inspected_fields
from sandbox.app.building.arrangement_actions import arrangements
from sandbox.app.building.button_action import ButtonAction
from sandbox.app.building.check_challenge_and_event_actions import actions
from sandbox.app.building.draft_recovery_and_conflict_choices import choices
from sandbox.app.building.editor import Editor
from sandbox.app.building.effect_costs import costs_in_words
from sandbox.app.building.selected_part_actions import part_actions
from sandbox.app.drawing import theme
from sandbox.app.drawing.theme import Color
from sandbox.app.runs.session import Session
from sandbox.app.words.language import later, say
from sandbox.editing.edits.automatic_title import is_untitled
from sandbox.model.effects import EFFECTS, Effects

FIRST = later("Draw something: take Disc or Box above, and drag on the stage.")
IN_RUN = later(
    "Add things with a tool, or click on a body to change it. The checks then no longer apply."
)
NO_FORMULA = later("The run was changed on the way: the level's checks no longer apply.")
NOTHING_SELECTED = later("Click on a body or joint on the stage to set its mass, length and so on.")
EVERYDAY = "gravity", "contact", "friction", "restitution", "rotation"
"""The effects that most scenes need, whose switches are beside the fields of a body, too."""
SELECTED = later("Effects (all of them, and checks, are shown while nothing is selected):")
SAVE = later("Save under this name:")
SAVE_TITLED = later("Save under this name, which becomes the level's title, too:")
NO_CHECKS = later("No checks to suggest: they are for set-ups that have a closed form.")
CHECKED = later("The level has checks; its own page (O) shows their results.")
CHECKS = later("Recognised: a click adds the checks of its closed form.")


class Block(NamedTuple):
    """A heading or a text, with buttons below it, some of them pressed."""

    text: str
    color: Color | None = None
    """None: the colour of less important texts"""
    actions: tuple[ButtonAction, ...] = ()
    pressed: frozenset[str] = frozenset()
    heading: bool = False

    @property
    def shape(self) -> tuple[object, ...]:
        """A key that changes whenever new widgets are needed."""
        return self.text, self.color, self.heading, tuple(act.caption for act in self.actions)


def mistakes_and_choices(editor: Editor, session: Session) -> list[Block]:
    """Return the top blocks: mistakes, and pending decisions."""
    found = []
    if editor.trying.is_shown(session):
        keep = ButtonAction(
            say("Keep as a level"),
            say("continue with the present state as a level of its own"),
            partial(editor.keep_run, session),
        )
        found.append(
            Block(say("This is the run. Esc goes back to building."), theme.NOTICE, (keep,))
        )
        if session.world.disturbed and session.original.checks:
            found.append(Block(say(NO_FORMULA), theme.NOTICE))
    elif (
        left := editor.trial.run_of(editor.work.draft.text)
    ) is not None and not editor.applying.refusal:
        back = ButtonAction(
            say("Back to the run at {t:.2f} s", t=left.t),
            say("return to the run that you left, where it was (Ctrl Y right after Esc)"),
            partial(editor.trying.return_to_run, session),
        )
        found.append(Block("", actions=(back,)))
    if editor.applying.refusal:
        found.append(
            Block(say("It cannot run yet: {reason}", reason=editor.applying.refusal), theme.FAILED)
        )
    found += [Block(offer.text, theme.NOTICE, offer.actions) for offer in choices(editor, session)]
    if editor.saving.naming:
        untitled = is_untitled(editor.work.document)
        found.append(Block(say(SAVE_TITLED if untitled else SAVE), theme.TEXT))
    return found


def subject(editor: Editor) -> list[Block]:
    """Return the blocks about the inspected parts, with the actions on them."""
    work = editor.bench
    in_run = work is editor.trial.live
    heading = say("The run") if in_run and not work.selected else inspected_fields.subject(work)
    title = Block(heading, heading=True)
    if not work.selected and in_run:
        return [title, Block(say(IN_RUN)), _switches(editor)]
    if not work.selected:
        drawn = any(body.outline.moves for body in work.sketch.bodies.values())
        return [
            title,
            Block(say(NOTHING_SELECTED if drawn else FIRST)),
            *_suggested(editor),
            Block("", actions=tuple(actions(work))),
            _switches(editor),
            _costs(editor),
        ]
    if in_run:
        leave = ButtonAction(say("Select nothing"), "(Esc)", partial(work.select, ()))
        return [title, Block("", actions=(_taking_out(editor), leave))]
    tip = say("show the level again (Esc)")
    leave = ButtonAction(say("Select nothing"), tip, partial(work.select, ()))
    switches = _switches(editor, EVERYDAY)
    return [title, switches._replace(text=say(SELECTED), actions=(*switches.actions, leave))]


def arranging(editor: Editor) -> list[Block]:
    """Return the blocks with actions on the selected parts, and with those that arrange bodies."""
    if editor.bench is not editor.work:
        return []
    work = editor.work
    acts = (*part_actions(work), *arrangements(work))
    return [Block("", actions=acts)] if acts else []


def _suggested(editor: Editor) -> list[Block]:
    acts = tuple(inspected_fields.suggestions(editor.work))
    if acts:
        return [Block(say(CHECKS), theme.NOTICE, acts)]
    return [Block(say(CHECKED if editor.work.document.get("checks") else NO_CHECKS))]


def _taking_out(editor: Editor) -> ButtonAction:
    tip = say("take it out of the run, and its joints (Delete)")
    return ButtonAction(say("Delete"), tip, editor.bench.delete)


def _costs(editor: Editor) -> Block:
    """Return the block with the time per step of each effect, or what it would add if used."""
    work, costs = editor.work, editor.costs
    if costs.is_for(work.version):
        found = costs_in_words(costs.of(work.version))
        if found or not costs.running:
            return Block(say("Time of a step: {costs}", costs=found or say("no effect to measure")))
        return Block(say("The effects are being timed ..."))
    tip = say("times a step of this level with and without each effect, which takes some seconds")
    return Block(
        "", actions=(ButtonAction(say("What does each effect cost?"), tip, editor.time_effects),)
    )


def _switches(editor: Editor, names: Iterable[str] = EFFECTS) -> Block:
    work = editor.bench
    acts = (
        ButtonAction(
            say(name),
            say(editable_fields.help_of(Effects, name) or name),
            partial(inspected_fields.switch, work, name),
        )
        for name in names
    )
    message = say("Effects: those that are lit are on; click to switch one on or off.")
    lit = frozenset(map(say, inspected_fields.declared(work)))
    return Block(message, actions=tuple(acts), pressed=lit)
