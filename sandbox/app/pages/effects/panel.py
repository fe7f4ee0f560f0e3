"""The page Effects: a switch for each effect, and below them the resulting differences."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import pygame
from pygame_gui import UI_BUTTON_PRESSED
from pygame_gui.elements import UIButton

from sandbox.app.cards.text_column import label
from sandbox.app.observing.checks_of_unfinished_run import TimeShare
from sandbox.app.pages.effects import switching_effects
from sandbox.app.pages.effects.card import compared, effects_intro, unchanged
from sandbox.app.pages.page import Desk
from sandbox.app.runs.companion_runs import NONE
from sandbox.app.widgets.scrolling_area import Sheet, below, in_rows
from sandbox.app.widgets.widget_states_and_scrolling import set_enabled, show_pressed
from sandbox.app.words import formatting, level_translation
from sandbox.app.words.language import later, say
from sandbox.model.levels_with_changed_effects import DEFAULTS

if TYPE_CHECKING:
    from sandbox.physics.measuring.run_comparison import Difference

SWITCH = 28  # px, the height of a switch
GAP = 6  # px
SCALE = 24  # px, the width of a button beside a switch
SCALES: Mapping[str, tuple[float, str]] = {
    formatting.MINUS: (0.5, later("half as strong")),
    "+": (2.0, later("twice as strong")),
}
LEFT = later("Fourth order does not allow this: both runs use leapfrog.")


class EffectsPage:
    """A switch for each effect, and the differences between the changed run and the original."""

    def __init__(self, sheet: Sheet, desk: Desk) -> None:
        self._sheet, self._session = sheet, desk.session
        session = desk.session
        level, pen, width = session.original, sheet.pen, sheet.width
        self._switches: dict[str, UIButton] = {}
        self._scales: dict[UIButton, tuple[str, float]] = {}
        y = below(sheet.image(effects_intro(pen, width), sheet.margin // 2)) + GAP
        y = self._row_of(level.effects.declared, y)
        if added := switching_effects.addable(level):
            y = below(sheet.image(label(pen, width, say("try with")), y + 2)) + GAP
            y = self._row_of(added, y, adjustable=True)
        caption = say("Reset the effects")
        reset = pygame.Rect(0, y + 4, sheet.widest_button(caption), sheet.px(SWITCH))
        self.reset = sheet.button(reset, caption, say("play the level as it is declared"))
        self._time_share: TimeShare[tuple[Difference, ...]] = TimeShare(
            lambda: switching_effects.compared(session), ()
        )
        self._world = session.world
        self._told = sheet.image(self._drawn(), y + sheet.px(SWITCH) + 14)
        self.update()

    def _row_of(self, effects: Sequence[str], y: int, *, adjustable: bool = False) -> int:
        """Make rows of switches, as many in a row as fit, and return their lower end [px]."""
        sheet, px = self._sheet, self._sheet.px
        scales = [SCALES if adjustable and DEFAULTS[name] else {} for name in effects]
        widths = [sheet.widest_button(say(name)) for name in effects]
        whole = (w + len(s) * px(SCALE) for w, s in zip(widths, scales, strict=True))
        for name, width, own, place in zip(
            effects, widths, scales, in_rows(whole, sheet.width, px(SWITCH), px(GAP)), strict=True
        ):
            place.move_ip(0, y)
            switch = pygame.Rect(place.topleft, (width, place.height))
            self._switches[name] = sheet.button(switch, say(name), self._tip(name))
            scale = pygame.Rect(switch.topright, (px(SCALE), place.height))
            for sign, (times, tip) in own.items():
                self._scales[sheet.button(scale, sign, say(tip))] = name, times
                scale = scale.move(scale.width, 0)
        return (place.bottom if effects else y) + px(GAP)

    def _tip(self, effect: str) -> str:
        if effect in self._session.original.effects.declared:
            return say("switch {effect} off or on for this run", effect=say(effect))
        defaults = ", ".join(f"{say(name)} {value}" for name, value in DEFAULTS[effect].items())
        message = say("add {effect} to this run", effect=say(effect))
        return f"{message}: {defaults}" if defaults else message

    def switch(self, effect: str) -> UIButton:
        """Return the switch of an effect."""
        return self._switches[effect]

    def scale(self, effect: str, times: float) -> UIButton:
        """Return the button that scales the strength of an effect."""
        return next(b for b, chosen in self._scales.items() if chosen == (effect, times))

    def process(self, event: pygame.event.Event) -> str | None:
        """Switch or scale an effect, or reset all, and return the message."""
        if event.type != UI_BUTTON_PRESSED:
            return None
        name = next((n for n, b in self._switches.items() if b is event.ui_element), None)
        scale = self._scales.get(event.ui_element)
        if name is None and scale is None and event.ui_element is not self.reset:
            return None
        if name is not None:
            switching_effects.toggle(self._session, name)
        elif scale is not None:
            switching_effects.strengthen(self._session, *scale)
        else:
            switching_effects.change(self._session, NONE)
        return say(LEFT) if self._session.changes.replaced_scheme else ""

    def update(self) -> None:
        """Update the switches and the table of differences."""
        acting = self._session.level.effects.declared
        for name, button in self._switches.items():
            show_pressed(button, name in acting)
        for button, (name, _) in self._scales.items():
            set_enabled(button, name in self._session.changes.on)
        set_enabled(self.reset, bool(self._session.changes))
        self._sheet.replace(self._told, self._drawn())
        self._sheet.set_content_height(below(self._told) + 2)

    def _drawn(self) -> pygame.Surface:
        session, pen, width = self._session, self._sheet.pen, self._sheet.width
        if not session.changes:
            return unchanged(pen, width)
        if session.world is not self._world:
            self._world = session.world
            self._time_share = TimeShare(lambda: switching_effects.compared(session), ())
        found = self._time_share(session.world.steps + 1, hurried=session.playing)
        cost = switching_effects.cost(session)
        words, disturbed = level_translation.of(session.original), session.world.disturbed
        return compared(pen, width, session.changes.label, found, words, cost, disturbed=disturbed)
