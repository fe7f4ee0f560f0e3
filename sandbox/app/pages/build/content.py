"""What the page says and offers besides fields: mistakes, offers, suggestions, effects."""

from functools import partial
from typing import NamedTuple

from sandbox.app import theme
from sandbox.app.building import inspection
from sandbox.app.building.act import Act
from sandbox.app.building.editor import Editor
from sandbox.app.building.offering import offers
from sandbox.app.session import Session
from sandbox.app.theme import Color
from sandbox.model.effects import EFFECTS, Effects

FIRST = "Draw something: take Disc or Box above, and drag on the stage."
NOTHING_SELECTED = "Click on a body or joint on the stage to set its mass, length and so on."
SELECTED = "Effects and suggested checks are shown while nothing is selected."
NO_CHECKS = "No checks to suggest: they are for set-ups that have a closed form."
CHECKED = "The level has checks; its own page (O) tells how they stand."
CHECKS = "Recognised: a click adds the checks of its closed form."


class Block(NamedTuple):
    """A heading or a text, and buttons below it, some of which are pressed."""

    text: str
    color: Color | None = None
    """None for that of what is less important"""
    acts: tuple[Act, ...] = ()
    pressed: frozenset[str] = frozenset()
    heading: bool = False

    @property
    def shape(self) -> tuple[object, ...]:
        """What must be built anew if it changes."""
        return self.text, self.color, self.heading, tuple(act.caption for act in self.acts)


def above(editor: Editor, session: Session) -> list[Block]:
    """Return what comes first: what is wrong, and what there is to decide."""
    found = []
    if editor.trying(session):
        found.append(Block("This is the run. Esc goes back to building.", theme.NOTICE))
    if editor.refusal:
        found.append(Block(f"It cannot run yet: {editor.refusal}", theme.FAILED))
    found += [Block(offer.told, theme.NOTICE, offer.ways) for offer in offers(editor, session)]
    if editor.naming:
        found.append(Block("Save under this name:", theme.TEXT))
    return found


def subject(editor: Editor) -> list[Block]:
    """Return what is inspected, and what can be done with it as a whole."""
    work = editor.work
    title = Block(inspection.subject(work), heading=True)
    if not work.selected:
        drawn = any(body.outline.moves for body in work.sketch.bodies.values())
        return [
            title,
            Block(NOTHING_SELECTED if drawn else FIRST),
            *_suggested(editor),
            _switches(editor),
        ]
    leave = Act("Select nothing", "show the level again (Esc)", partial(work.select, ()))
    return [title, Block(SELECTED, acts=(leave,))]


def arranging(editor: Editor) -> list[Block]:
    """Return what can be done with the bodies that are selected, among each other."""
    acts = tuple(inspection.arrangements(editor.work))
    return [Block("Arrange:", acts=acts)] if acts else []


def _suggested(editor: Editor) -> list[Block]:
    acts = tuple(inspection.suggestions(editor.work))
    if acts:
        return [Block(CHECKS, theme.NOTICE, acts)]
    return [Block(CHECKED if editor.work.document.get("checks") else NO_CHECKS)]


def _switches(editor: Editor) -> Block:
    work = editor.work
    acts = (
        Act(
            name,
            Effects.model_fields[name].description or name,
            partial(inspection.switch, work, name),
        )
        for name in EFFECTS
    )
    told = "Effects: those that are lit act; a click switches one on or off."
    return Block(told, acts=tuple(acts), pressed=frozenset(inspection.declared(work)))
