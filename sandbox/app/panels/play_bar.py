"""The bar at the bottom: play, speed, time, and overlays."""

from collections.abc import Iterator, Mapping, Sequence

import pygame
from pygame_gui import UIManager

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.panels.button_bar import GAP, MARGIN, Bar
from sandbox.app.runs.session import Session
from sandbox.app.stage.overlays.register import OVERLAYS
from sandbox.app.widgets.widget_states_and_scrolling import show_pressed
from sandbox.app.words import formatting
from sandbox.app.words.language import later, say

Caption = tuple[str, str]
"""A command and the caption of its button."""

SPEED, SMALL = 58, 32  # px, the widths of the number between two buttons, and of each of them

CLOCK = 130  # px, the least width of the clock for which other buttons make way
TIGHT = 560  # px, the smallest width of the window with the speed and its buttons

PLAY, PAUSE = later("Play"), later("Pause")
HOME: tuple[Caption, ...] = (("home", later("Home")),)
LEFT: tuple[Caption, ...] = (
    ("play", PLAY), ("step", later("Step")), ("restart", later("Restart")),
)  # fmt: skip
WAYS: tuple[Caption, ...] = (("fit", later("Fit")), ("help", later("Help")))
KNOB = 7.0  # px, the radius of the knob on the time bar
SNAP = 6  # px: a click snaps to a mark within this distance
REACH = 24  # px, the additional height of the clickable area of the time bar
MARKED = "grab", "release", "place", "branch", "alter"
"""The actions that are marked on the time bar; a pull lasts from one to the next."""
NEARLY = 0.95  # a speed above this share of the chosen one is not reported as lower


class PlayBar(Bar):
    """Buttons for the most frequent commands, and the clock between them.

    Parameters
    ----------
    home
        Whether there is a button for the home page.
    """

    def __init__(
        self, manager: UIManager, pen: Pen, rect: pygame.Rect, *, home: bool = False
    ) -> None:
        super().__init__(manager, pen, rect)
        px = pen.px
        x = px(MARGIN)
        for command, text in self._leading((*HOME, *LEFT) if home else LEFT):
            x = self._button(
                command, say(text), x, self._width(command, text), main=command == "play"
            )
        self._speed = pygame.Rect(0, 0, 0, 0)
        if rect.width >= px(TIGHT):
            x = self._button("slower", "−", x + px(GAP), SMALL)
            self._speed = pygame.Rect(x, 0, px(SPEED), 0)
            x = self._button("faster", "+", x + px(SPEED), SMALL)
        right = self._make_right_buttons(x)
        self._clock = pygame.Rect(x + px(12), rect.y, right - x - px(28), rect.height)
        self._seeking = False
        self._snaps: Sequence[float] = ()

    def _make_right_buttons(self, left: int) -> int:
        """Make the buttons at the right that leave the clock its room, and return their left edge.

        `left` is the right edge of the other buttons [px].
        """
        for wanted in ((*_overlays(), *WAYS), WAYS, WAYS[-1:]):
            if self._fits(left, wanted):
                break
        right = edge = self._edge(wanted)
        for command, text in wanted:
            right = self._button(command, say(text), right, self._width(command, text))
        return edge

    def _leading(self, buttons: Sequence[Caption]) -> Sequence[Caption]:
        """Return the buttons at the left; Step is left to its key if the clock lacks room."""
        px = self._pen.px
        speed = px(GAP + SPEED) + 2 * px(SMALL + GAP) if self._rect.width >= px(TIGHT) else 0
        if self._fits(px(MARGIN) + self._taken(buttons) + speed, WAYS[-1:]):
            return buttons
        return [button for button in buttons if button[0] != "step"]

    def _width(self, command: str, text: str) -> int:
        """Return the width of the button of a command, at scale 1 [px]."""
        main = command == "play"
        return self._room(*map(say, (PLAY, PAUSE) if main else (text,)), main=main)

    def _taken(self, buttons: Sequence[Caption]) -> int:
        """Return the width of buttons beside each other [px]."""
        return sum(self._pen.px(self._width(*each)) + self._pen.px(GAP) for each in buttons)

    def _edge(self, buttons: Sequence[Caption]) -> int:
        """Return the left edge of buttons at the right [px]."""
        return self._rect.width - self._pen.px(MARGIN - GAP) - self._taken(buttons)

    def _fits(self, left: int, buttons: Sequence[Caption]) -> bool:
        """Whether buttons at the right leave the clock its room beside those up to `left` [px]."""
        return self._edge(buttons) - left - self._pen.px(28) >= self._pen.px(CLOCK)

    def clicked_share(self, event: pygame.event.Event) -> float | None:
        """Return the share of the run that was clicked or dragged to, from 0 to 1; None if none."""
        track = self._track
        if event.type == pygame.MOUSEBUTTONDOWN and event.button == 1:
            self._seeking = track.inflate(8, self._pen.px(REACH)).collidepoint(event.pos)
        elif event.type == pygame.MOUSEBUTTONUP:
            self._seeking = False
        if not self._seeking or event.type not in (pygame.MOUSEBUTTONDOWN, pygame.MOUSEMOTION):
            return None
        share = min(max((event.pos[0] - track.x) / max(track.width, 1), 0.0), 1.0)
        if event.type == pygame.MOUSEBUTTONDOWN:  # a click snaps to an impact, a drag does not
            near = min(self._snaps, key=lambda snap: abs(snap - share), default=share)
            share = near if abs(near - share) * track.width <= self._pen.px(SNAP) else share
        return share

    @property
    def _track(self) -> pygame.Rect:
        """The time bar."""
        area = self._clock
        px = self._pen.px
        return pygame.Rect(area.x, area.centery + px(8), area.width, px(5))

    def update(self, session: Session | None, shown: Mapping[str, bool]) -> None:
        """Update the buttons."""
        playing = session is not None and session.playing
        text = say(PAUSE if playing else PLAY)
        if self._buttons["play"].text != text:
            self._buttons["play"].set_text(text)
        for command, on in shown.items():
            if command in self._buttons:
                show_pressed(self._buttons[command], on)

    def draw(self, surface: pygame.Surface, session: Session | None) -> None:
        """Draw the background, the speed and the clock; the manager draws the buttons."""
        super().draw(surface, session)
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
        shown = float(session.shown.snapshot.t)
        now = pen.write(f"t = {formatting.seconds(shown)}", 15, bold=True)
        surface.blit(now, (area.x, middle - pen.px(20)))
        room = area.width - now.width - pen.px(10)
        lines = [*self._pointed_at(session), *notes(session)]
        written = (pen.write(text, 13, color) for text, color in lines)
        if note := next((note for note in written if note.width <= room), None):
            surface.blit(note, (area.right - note.width, middle - pen.px(18)))
        track = self._track
        pygame.draw.rect(surface, theme.RAISED, track, border_radius=2)
        share = min(shown / (session.span * session.world.dt), 1.0)
        if share > 0:
            done = pygame.Rect(track.topleft, (round(track.width * share), track.height))
            pygame.draw.rect(surface, theme.ACCENT, done, border_radius=2)
        self._mark_impacts(surface, session)
        self._mark_actions(surface, session)
        knob = track.x + track.width * share, float(track.centery)
        pygame.draw.aacircle(surface, theme.ACCENT, knob, pen.px(KNOB))
        if session.sought is not None:
            other = session.world.steps if session.recalled else session.sought
            ring = track.x + track.width * other / session.span, float(track.centery)
            pygame.draw.aacircle(surface, theme.NOTICE, ring, pen.px(KNOB), 2)

    def _mark_impacts(self, surface: pygame.Surface, session: Session) -> None:
        """Mark the impacts, including those after the present time in a repeated run."""
        track, px = self._track, self._pen.px
        self._snaps = [min(blow.steps / session.span, 1.0) for blow in session.run.marks.shown]
        for x in {round(track.x + track.width * snap) for snap in self._snaps}:
            pygame.draw.aacircle(surface, theme.DIM, (x, track.bottom + px(6)), max(px(2), 2))

    def _pointed_at(self, session: Session) -> Iterator[tuple[str, theme.Color]]:
        """Yield the description of an impact while the mouse is at its mark."""
        track, (x, y), snap = self._track, pygame.mouse.get_pos(), self._pen.px(SNAP)
        if not track.inflate(2 * snap, self._pen.px(REACH)).collidepoint(x, y):
            return
        away = {
            abs(track.x + track.width * b.steps / session.span - x): b
            for b in session.run.marks.shown
        }
        if away and min(away) <= snap:
            blow = away[min(away)]
            a, b = map(formatting.name_in_words, blow.names)
            impulse = formatting.quantity(blow.impulse, "N s", 3)
            t = formatting.seconds(blow.t)
            yield say("{t}: {a} strikes {b}, {impulse}", t=t, a=a, b=b, impulse=impulse), theme.TEXT

    def _mark_actions(self, surface: pygame.Surface, session: Session) -> None:
        """Mark the user's actions, including those after the present time in a repeated run."""
        track, px = self._track, self._pen.px
        steps = {action.step for action in session.all_actions if action.kind in MARKED}
        for x in {round(track.x + track.width * min(step / session.span, 1.0)) for step in steps}:
            mark = pygame.Rect(0, 0, max(px(2), 2), track.height + px(6))
            mark.center = x, track.centery
            surface.fill(theme.NOTICE, mark)


def _overlays() -> list[Caption]:
    """Return the overlays with buttons, and their captions."""
    return [(each.name, each.caption) for each in OVERLAYS if each.caption and each.on is None]


def notes(session: Session) -> Iterator[tuple[str, theme.Color]]:
    """Yield the notes beside the time, the longest first, in case there is no room for it."""
    if session.recalled:
        yield say("recorded; the run is still on its way there"), theme.NOTICE
        yield say("as recorded"), theme.NOTICE
        return
    reduced = session.pace.reduced if session.playing else None
    if reduced is None or reduced > NEARLY * session.speed:
        beyond = session.world.steps > session.end
        caption = later("complete at {time}") if beyond else later("of {time}")
        yield say(caption, time=formatting.seconds(session.duration)), theme.DIM
        return
    message = say("running at {speed:.2g}×", speed=reduced)
    if session.remaining:
        more = formatting.span(session.remaining)
        wanted = say(
            "{told}, not {speed:g}×: {time} more", told=message, speed=session.speed, time=more
        )
        yield wanted, theme.NOTICE
        yield say("{told}: {time} more", told=message, time=more), theme.NOTICE
    yield message, theme.NOTICE
