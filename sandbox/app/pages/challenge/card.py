"""The card of a challenge: its task, its stars, its goals, and the hints shown."""

from collections.abc import Sequence

import pygame

from sandbox.app.cards.text_column import GAP, TextColumn
from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.runs.session import Session
from sandbox.app.words import formatting, level_translation
from sandbox.app.words.language import later, say
from sandbox.model.challenge import Challenge
from sandbox.physics.measuring.challenge_goals import Attempt, Outcome, Standing

NONE = later("This level sets no challenge. Those of the chapter Challenges do.")
TOUCHED = later("This run was changed by hand, or its effects were: it earns no stars.")
_STAR = 11  # px, its radius


def challenge(pen: Pen, width: int, session: Session) -> pygame.Surface:
    """Draw the task of a session's level, and the standing of its goals."""
    asked = session.level.challenge
    if asked is None:
        return task(pen, width, session)
    card = TextColumn(pen, width)
    for part in (task(pen, width, session), standing(pen, width, session, best=0)):
        card.put(part, 0)
        card.y += part.height + GAP
    return card.drawn()


def task(pen: Pen, width: int, session: Session) -> pygame.Surface:
    """Draw the title of the level and the task."""
    challenge = session.level.challenge
    card, words = TextColumn(pen, width), level_translation.of(session.original)
    card.text(words(session.original.title), 20, bold=True)
    card.y += 4
    card.text(words(challenge.task) if challenge else say(NONE), 15 if challenge else 14)
    return card.drawn()


def standing(pen: Pen, width: int, session: Session, best: int) -> pygame.Surface:
    """Draw the stars and the goals of a session's challenge; `best` are the most stars before."""
    card = TextColumn(pen, width)
    challenge, found = session.level.challenge, session.attempt()
    if challenge is None:
        return card.drawn()
    card.heading(say("Goals"))
    if found is None:
        card.text(say(TOUCHED), 14, theme.NOTICE)
        card.text(say("Restart (R) to try again."), 13, theme.DIM)
        return card.drawn()
    _stars(card, found, best)
    before, words = "", level_translation.of(session.original)
    for index, outcome in enumerate(found.outcomes):
        rank = _rank(index, challenge)
        if rank != before:
            card.text(rank, 12, theme.DIM)
        before = rank
        _goal(card, outcome, words(outcome.goal.label))
    if found.changed_parameters:
        names = ", ".join(found.changed_parameters)
        message = say("No star counts: {names} is locked in this challenge.", names=names)
        card.text(message, 13, theme.NOTICE)
    return card.drawn()


def hints(pen: Pen, width: int, shown: Sequence[str]) -> pygame.Surface:
    """Draw the hints shown so far."""
    card = TextColumn(pen, width)
    if shown:
        card.heading(say("Hints"))
    for index, hint in enumerate(shown):
        card.put(pen.write(f"{index + 1}.", 14, theme.DIM), 0)
        card.text(hint, 14, indent=card.indent)
        card.y += GAP
    return card.drawn()


def _rank(index: int, challenge: Challenge) -> str:
    """Return the name of the star for which a goal counts."""
    extra = index - len(challenge.goals)
    return (say("second star"), say("third star"))[extra] if extra >= 0 else say("first star")


def _stars(card: TextColumn, found: Attempt, best: int) -> None:
    """Draw the stars of this run, and the number earned before."""
    radius = card.pen.px(_STAR)
    for index in range(found.possible_stars):
        card.put(_star(radius, earned=index < found.stars), index * (2 * radius + 6), 2)
    text = (
        say("best so far: {best} of {most}", best=best, most=found.possible_stars) if best else ""
    )
    card.put(card.pen.write(text, 13, theme.DIM), found.possible_stars * (2 * radius + 6) + 8, 5)
    card.y += 2 * radius + 8


def _star(radius: int, *, earned: bool) -> pygame.Surface:
    """Draw a star, filled if it is earned."""
    sign = pygame.Surface((2 * radius + 2, 2 * radius + 2), pygame.SRCALPHA)
    corners = lines.star((radius + 1, radius + 1), radius)
    if earned:
        pygame.draw.polygon(sign, theme.NOTICE, corners)
    pygame.draw.aalines(sign, theme.NOTICE if earned else theme.WAITING, True, corners)
    return sign


def _goal(card: TextColumn, outcome: Outcome, label: str) -> None:
    color = _color(outcome.standing)
    card.put(card.pen.write(_SIGNS[outcome.standing], 14, color, bold=True), 4)
    card.text(label, 14, bold=True, indent=card.indent)
    value = outcome.measured
    now = "–" if value is None else formatting.quantity(value, outcome.unit, 4)
    card.columns(
        (
            (now, theme.TEXT),
            (formatting.bounds(outcome), theme.DIM),
            (say(outcome.standing), color),
        ),
        13,
    )
    card.y += GAP


_SIGNS: dict[Standing, str] = {"met": "✓", "missed": "×", "open": "…"}
"""A sign for each standing, which must not be shown by colour alone."""


def _color(standing: Standing) -> Color:
    return {"met": theme.PASSED, "missed": theme.FAILED, "open": theme.WAITING}[standing]
