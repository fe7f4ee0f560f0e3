"""The card of a run's accuracy, and the computing time that it costs."""

from collections.abc import Mapping

import pygame

from sandbox.app.cards.text_column import GAP, TextColumn
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.words import formatting, level_translation
from sandbox.app.words.language import later, say
from sandbox.app.words.level_translation import Say, title
from sandbox.model.level import Check, Level, Stepping
from sandbox.physics.accuracy.error_causes_and_costs import CurrentSetting, ErrorBudget, Progress
from sandbox.physics.accuracy.trusted_digits import Trust

PARTS = (later("model"), later("numerical"), later("remaining"))


def dial_ends(pen: Pen, width: int, left: str, right: str) -> pygame.Surface:
    """Draw the meanings of the two ends of a dial."""
    card = TextColumn(pen, width)
    card.put(pen.write(left, 12, theme.DIM), 0)
    text = pen.write(right, 12, theme.DIM)
    card.put(text, width - text.width)
    card.y += text.height
    return card.drawn()


def current_accuracy(
    pen: Pen, width: int, target: float | None, stepping: Stepping, current: CurrentSetting | None,
    place: Trust | None,
) -> pygame.Surface:  # fmt: skip
    """Draw the requested accuracy, the present setting, its error, and the least known place."""
    card = TextColumn(pen, width)
    card.heading(say("Accuracy and its cost"))
    wanted = say("Ask for an accuracy:")
    if target is not None:
        wanted = say("Asked for: {error}", error=formatting.error(target))
    card.text(wanted, 14, bold=target is not None)
    message = say("now {setting}", setting=formatting.stepping(stepping))
    if current is not None:
        message = say(
            "{setting}, error {error}", setting=message, error=formatting.error(current.error)
        )
    card.text(message, 13, theme.DIM)
    _least_known(card, place)
    card.y += GAP
    return card.drawn()


def _least_known(card: TextColumn, place: Trust | None) -> None:
    """Add two lines, whose height does not depend on whether the place is known."""
    digits = "" if place is None else formatting.trusted(place)
    what = say("not measured yet") if place is None else place.quantity
    for line in (say("least known place: {place}", place=what), digits):
        text = card.pen.shorten(line, card.width, 12)
        card.put(card.pen.write(text, 12, theme.DIM), 0)
        card.y += card.pen.height(12)


def status(
    pen: Pen, size: tuple[int, int], progress: Progress | None, failure: str
) -> pygame.Surface:
    """Draw the progress of the work, or the reason why it failed."""
    surface = pygame.Surface(size)
    surface.fill(theme.PANEL)
    if failure:
        for i, line in enumerate(pen.paragraph(say(failure), size[0], 11, theme.FAILED)[:2]):
            surface.blit(line, (0, i * pen.px(13) - 1))
    elif progress:
        stage = say(progress.stage, scheme=formatting.scheme(progress.scheme))
        message = say(progress.detail) if progress.detail else stage
        surface.blit(pen.write(pen.shorten(message, size[0], 12), 12, theme.DIM), (0, 0))
        surface.fill(theme.RAISED, (0, pen.px(19), size[0], pen.px(5)))
        surface.fill(theme.ACCENT, (0, pen.px(19), round(size[0] * progress.fraction), pen.px(5)))
    return surface


def shares_and_errors(
    pen: Pen, width: int, shares: Mapping[str, float], level: Level,
    splits: Mapping[int, ErrorBudget],
) -> pygame.Surface:  # fmt: skip
    """Draw the parts of a frame's time, and the parts of the checks' errors."""
    card, words = TextColumn(pen, width), level_translation.of(level)
    _frame(card, shares)
    if splits:
        card.y += 8
        card.heading(say("What the errors are made of"))
        for index, split in sorted(splits.items()):
            _split(card, level.checks[index], words, split)
    return card.drawn()


def _frame(card: TextColumn, shares: Mapping[str, float]) -> None:
    """Add a bar of a frame's 16.7 ms, and the share of each part."""
    card.heading(say("A frame of 16.7 ms"))
    bar = pygame.Surface((card.width, 10))
    bar.fill(theme.RAISED)
    x = 0.0
    for name, share in shares.items():
        bar.fill(_of_load(name), (round(x), 0, round(share * card.width), 10))
        x += share * card.width
    card.put(bar, 0)
    card.y += 14
    column = card.width // len(shares)
    for i, (name, share) in enumerate(shares.items()):
        text = f"{say(name)} {100 * share:.0f} %"
        card.put(card.pen.write(text, 12, _of_load(name)), i * column)
    card.y += card.pen.height(12)


def _split(card: TextColumn, check: Check, words: Say, split: ErrorBudget) -> None:
    """Add the three parts of a check's error, side by side."""
    card.y += GAP
    card.text(title(check, words), 13, bold=True)
    if split.total is None:
        source = check.valid_if.source if check.valid_if else ""
        message = say("its moment never comes")
        if source:
            message = say("model out of range: it needs {condition}", condition=source)
        card.text(message, 12, theme.NOTICE)
        numerical = say("numerical")
        card.text(f"{numerical} {formatting.error(split.numerical)}", 12, theme.DIM)
        return
    column = card.width // len(PARTS)
    values = (split.model, split.numerical, split.remaining)
    largest = max(value or 0.0 for value in values)
    for i, (name, value) in enumerate(zip(PARTS, values, strict=True)):
        color = theme.TEXT if value and value == largest else theme.DIM
        card.put(card.pen.write(say(name), 11, theme.DIM), i * column)
        message = say("none seen") if not value else formatting.error(value)
        card.put(card.pen.write(message, 13, color), i * column, card.pen.height(11) - 1)
    card.y += card.pen.height(11) + card.pen.height(13)


def _of_load(part: str) -> Color:
    """Return the colour of a part of a frame."""
    return {"physics": theme.ACCENT, "hooks": theme.KINETIC, "drawing": theme.LANES[2]}[part]
