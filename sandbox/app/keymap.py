"""The key bindings of all commands: those of the window, and those of overlays and pages.

The actions of the commands are in `command_actions`.
"""

import pygame

from sandbox.app.pages.register import PAGES, page
from sandbox.app.stage.overlays.register import OVERLAYS
from sandbox.app.window_keys import CONTROL, PLAYING, SHOWING, WINDOW, Binding
from sandbox.app.words.language import say, say_in

BINDINGS: tuple[Binding, ...] = (
    *PLAYING,
    *(overlay.binding for overlay in OVERLAYS),
    *SHOWING,
    *(binding for page in PAGES for binding in page.bindings),
    *WINDOW,
)
"""All key bindings, in the order of the help."""


def command(event: pygame.event.Event) -> str | None:
    """Return the command of a pressed key, or None."""
    if event.mod & CONTROL:
        return next((b.command for b in BINDINGS if event.key in b.controls), None)
    if event.mod & pygame.KMOD_ALT:
        return None
    for binding in BINDINGS:
        typed = event.unicode and event.unicode in binding.characters
        if typed or event.key in binding.keys:
            return binding.command
    return None


def tip(command: str) -> str:
    """Return the tooltip of a button for a command."""
    binding = next((binding for binding in BINDINGS if binding.command == command), None)
    if binding is None:  # a page without a key
        return say(page(command).text)
    return f"{say(binding.text)} ({say_in('key', binding.shown)})"
