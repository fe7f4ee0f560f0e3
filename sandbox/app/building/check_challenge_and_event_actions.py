"""Actions that add checks, ghosts and a challenge to a level, and remove them."""

from functools import partial
from typing import Literal

from sandbox.app.building.button_action import ButtonAction
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.words import level_translation
from sandbox.app.words.language import say
from sandbox.editing.edits import events
from sandbox.editing.edits.challenges import add_challenge, drop_challenge
from sandbox.editing.edits.checks_and_ghosts import add_checks, drop_check_or_ghost
from sandbox.model.expressions import Expression
from sandbox.model.level import Level

MOST_TOLD = 12
"""The largest number of checks, and of ghosts, that have a button to remove them."""
LONGEST = 30
"""The largest number of letters of a check's title on its button."""


def actions(work: EditedLevel) -> list[ButtonAction]:
    """Return the actions that add or remove checks, ghosts and a challenge, or change events."""
    if work.draft.level is None:
        return []
    level = work.level
    moving = [name for name, body in level.bodies.items() if body.type == "dynamic"]
    adding = [
        ButtonAction(
            say("Add a check"),
            say("of any quantity; its fields are below"),
            partial(_check, work, name),
        )
        for name in moving[:1]
    ]
    words = level_translation.of(level)
    checks = [
        ButtonAction(
            f"− {_shortened(level_translation.title(check, words))}",
            say("take this check out"),
            partial(_remove, work, "checks", index),
        )
        for index, check in enumerate(level.checks)
    ]
    ghosts = [
        ButtonAction(
            say("− ghost of {name}", name=name),
            say("take this ghost out"),
            partial(_remove, work, "ghosts", name),
        )
        for name in level.ghosts
    ]
    parts = [*checks[:MOST_TOLD], *ghosts[:MOST_TOLD]]
    return [*adding, *_challenge(work, level, moving), *_event_actions(work, level), *parts]


def _shortened(title: str) -> str:
    """Return a title that fits on a button."""
    return title if len(title) <= LONGEST else f"{title[: LONGEST - 1].rstrip()}…"


def _challenge(work: EditedLevel, level: Level, moving: list[str]) -> list[ButtonAction]:
    """Return the action that adds a challenge, or removes the present one."""
    if level.challenge is not None:
        tip = say("remove the task from the level")
        drop = partial(
            work.change, say("take out the challenge"), lambda text, _: drop_challenge(text)
        )
        return [ButtonAction(say("− challenge"), tip, drop)]
    tip = say("a task to solve with the sliders: bring a body to a target")
    return [
        ButtonAction(say("Add a challenge"), tip, partial(_set_task, work, name))
        for name in moving[:1]
    ]


def _set_task(work: EditedLevel, body: str) -> None:
    task = say("Bring {body} to where it belongs.", body=body)
    labels = say("between left and right"), say("not above")
    edit = partial(add_challenge, body=body, task=task, labels=labels)
    if work.change(say("add a challenge"), edit):
        work.show_message(say("Its task and its goals are fields below, under challenge"))


def _event_actions(work: EditedLevel, level: Level) -> list[ButtonAction]:
    """Return the actions that let events wait for a quantity instead of a time."""
    tip = say("it waits until a quantity crosses a value; its fields are below, under events")
    return [
        ButtonAction(
            say("{event}: when ...", event=name), tip, partial(_let_event_wait, work, name)
        )
        for name, event in level.events.items()
        if isinstance(event.at, Expression)
    ][:MOST_TOLD]


def _let_event_wait(work: EditedLevel, event: str) -> None:
    caption = say("let {event} wait for a quantity", event=event)
    work.change(caption, lambda text, level: events.wait_for_quantity(text, level, event))


def _check(work: EditedLevel, body: str) -> None:
    new = {"quantity": f"{body}.position.x", "formula": "0", "tolerance": 1e-3}
    if work.change(say("add a check"), lambda text, level: add_checks(text, level, [new])):
        work.show_message(say("Type its quantity and its formula below, under checks"))


def _remove(work: EditedLevel, part: Literal["checks", "ghosts"], which: int | str) -> None:
    caption = say("take out a check") if part == "checks" else say("take out a ghost")
    work.change(caption, lambda text, _: drop_check_or_ghost(text, part, which))
