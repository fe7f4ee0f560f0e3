"""The bar below: playing, speed, time, and what is shown."""

from collections.abc import Iterator, Mapping

import pygame
from pygame_gui import UI_BUTTON_PRESSED, UIManager
from pygame_gui.core import ObjectID
from pygame_gui.elements import UIButton

from sandbox.app import theme, wording
from sandbox.app.commands import tip
from sandbox.app.session import Session
from sandbox.app.stage.overlays.register import OVERLAYS
from sandbox.app.text import Pen
from sandbox.app.widgets.gui import press

HEIGHT = 34  # px, of a button
GAP = 6  # px
MARGIN = 12  # px
SPEED = 58  # px, for the number between the two buttons

ROOMY = 900  # px, the window's width from which on there is room for what is shown
TIGHT = 560  # px, the width below which the clock takes the place of the speed

LEFT: tuple[tuple[str, str, int], ...] = (
    ("play", "Play", 76), ("step", "Step", 56), ("restart", "Restart", 70),
)  # fmt: skip
WAYS: tuple[tuple[str, str, int], ...] = (("fit", "Fit", 40), ("help", "Help", 52))
KNOB = 7.0  # px, the radius of what is dragged along the time
REACH = 24  # px, how much higher than the bar of the time the area is that can be clicked on
PADDING = 22  # px, beside the caption of an overlay's button


class Controls:
    """Buttons for the commands that are used all the time, and the clock between them."""

    def __init__(self, manager: UIManager, pen: Pen, rect: pygame.Rect) -> None:
        self._manager, self._pen, self._rect = manager, pen, rect
        self._buttons: dict[str, UIButton] = {}
        px = pen.px
        x = px(MARGIN)
        for command, text, width in LEFT:
            x = self._button(command, text, x, width)
        self._speed = pygame.Rect(0, 0, 0, 0)
        if rect.width >= px(TIGHT):
            x = self._button("slower", "−", x + px(GAP), 32)
            self._speed = pygame.Rect(x, 0, px(SPEED), 0)
            x = self._button("faster", "+", x + px(SPEED), 32)
        shown = (*self._overlays(), *WAYS) if rect.width >= px(ROOMY) else WAYS[-1:]
        right = rect.width - px(MARGIN - GAP) - sum(px(width) + px(GAP) for _, _, width in shown)
        self._clock = pygame.Rect(x + px(12), rect.y, right - x - px(28), rect.height)
        self._seeking = False
        for command, text, width in shown:
            right = self._button(command, text, right, width)

    def _overlays(self) -> list[tuple[str, str, int]]:
        """Return the overlays that have buttons, their captions and the buttons' widths."""
        captions = [(each.name, each.caption) for each in OVERLAYS if each.caption]
        return [
            (name, text, round(self._pen.write(text).width / self._pen.scale) + PADDING)
            for name, text in captions
        ]

    def _button(self, command: str, text: str, x: int, width: int) -> int:
        """Make a button, and return where the next one begins."""
        width, height = self._pen.px(width), self._pen.px(HEIGHT)
        place = pygame.Rect(x, self._rect.y + (self._rect.height - height) // 2, width, height)
        self._buttons[command] = UIButton(
            place, text, self._manager, tool_tip_text=tip(command),
            object_id=ObjectID(class_id="@main") if command == "play" else None,
        )  # fmt: skip
        return x + width + self._pen.px(GAP)

    def process(self, event: pygame.event.Event) -> str | None:
        """Return the command whose button was pressed, if one was."""
        if event.type != UI_BUTTON_PRESSED:
            return None
        pressed = (c for c, button in self._buttons.items() if button is event.ui_element)
        return next(pressed, None)

    def sought(self, event: pygame.event.Event) -> float | None:
        """Return which part of the run was clicked on or dragged to, from 0 to 1; None if none."""
        track = self._track
        if event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
            self._seeking = track.inflate(8, self._pen.px(REACH)).collidepoint(event.pos)
        elif event.type == pygame.MOUSEBUTTONUP:
            self._seeking = False
        if not self._seeking or event.type not in (pygame.MOUSEBUTTONDOWN, pygame.MOUSEMOTION):
            return None
        return min(max((event.pos[0] - track.x) / max(track.width, 1), 0.0), 1.0)

    @property
    def _track(self) -> pygame.Rect:
        """The bar that shows how much of the run is over."""
        area = self._clock
        px = self._pen.px
        return pygame.Rect(area.x, area.centery + px(8), area.width, px(5))

    def button(self, command: str) -> UIButton:
        """Return the button of a command."""
        return self._buttons[command]

    def update(self, session: Session | None, shown: Mapping[str, bool]) -> None:
        """Let the buttons say what is the case."""
        playing = session is not None and session.playing
        text = "Pause" if playing else "Play"
        if self._buttons["play"].text != text:
            self._buttons["play"].set_text(text)
        for command, on in shown.items():
            if command in self._buttons:
                press(self._buttons[command], on)

    def draw(self, surface: pygame.Surface, session: Session | None) -> None:
        """Draw the bar's ground, the speed and the clock; the buttons are the manager's."""
        surface.fill(theme.PANEL, self._rect)
        surface.fill(theme.EDGE, (*self._rect.topleft, self._rect.width, 1))
        if session is None:
            return
        if self._speed.width:
            speed = self._pen.write(f"{session.speed:g}×", 15, bold=True)
            center = self._speed.centerx - self._pen.px(GAP) // 2, self._rect.centery
            surface.blit(speed, speed.get_rect(center=center))
        self._draw_clock(surface, session)

    def _draw_clock(self, surface: pygame.Surface, session: Session) -> None:
        area, pen = self._clock, self._pen
        middle = area.centery
        now = pen.write(f"t = {wording.seconds(session.t)}", 15, bold=True)
        surface.blit(now, (area.x, middle - pen.px(20)))
        room = area.width - now.width - pen.px(10)
        notes = (pen.write(text, 13, color) for text, color in _notes(session))
        if note := next((note for note in notes if note.width <= room), None):
            surface.blit(note, (area.right - note.width, middle - pen.px(18)))
        track = self._track
        pygame.draw.rect(surface, theme.RAISED, track, border_radius=2)
        share = min(session.t / session.duration, 1.0)
        if share > 0:
            done = pygame.Rect(track.topleft, (round(track.width * share), track.height))
            pygame.draw.rect(surface, theme.ACCENT, done, border_radius=2)
        knob = track.x + track.width * share, float(track.centery)
        pygame.draw.aacircle(surface, theme.ACCENT, knob, pen.px(KNOB))
        if session.sought is not None:
            goal = track.x + track.width * session.sought / session.end, float(track.centery)
            pygame.draw.aacircle(surface, theme.NOTICE, goal, pen.px(KNOB), 2)


def _notes(session: Session) -> Iterator[tuple[str, theme.Color]]:
    """Yield what is said beside the time, the longest first: there may be no room for it."""
    reduced = session.pace.reduced if session.playing else None
    if reduced is None:
        yield f"of {wording.seconds(session.duration)}", theme.DIM
        return
    told = f"running at {reduced:.2g}×"
    if session.remaining:
        yield (
            f"{told}, not {session.speed:g}×: {wording.span(session.remaining)} more",
            theme.NOTICE,
        )
        yield f"{told}: {wording.span(session.remaining)} more", theme.NOTICE
    yield told, theme.NOTICE
