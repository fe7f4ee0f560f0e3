"""The keys of the window's own commands; pages and overlays declare their own (see `keymap`)."""

from dataclasses import dataclass

import pygame


@dataclass(frozen=True, slots=True)
class Binding:
    """A command, its keys or characters, and their description in the help."""

    command: str
    shown: str
    text: str
    keys: tuple[int, ...] = ()
    characters: str = ""
    controls: tuple[int, ...] = ()
    """the keys of the command together with Ctrl or Cmd"""


CONTROL = pygame.KMOD_CTRL | pygame.KMOD_META

PLAYING = (
    Binding("play", "Space", "play or pause", (pygame.K_SPACE,)),
    Binding("step", "Right arrow or .", "pause and take a single step", (pygame.K_RIGHT,), "."),
    Binding(
        "step back", "Left arrow or ,", "pause and go a single step back", (pygame.K_LEFT,), ","
    ),
    Binding(
        "impact before",
        "Ctrl ←",
        "pause and go back to an impact, or to the start",
        controls=(pygame.K_LEFT,),
    ),
    Binding(
        "impact after",
        "Ctrl →",
        "pause and go on to an impact, or as far as the run has been",
        controls=(pygame.K_RIGHT,),
    ),
    Binding("restart", "R or Home", "restart", (pygame.K_HOME,), "rR"),
    Binding("faster", "+ or ]", "play faster", (pygame.K_KP_PLUS,), "+=]"),
    Binding("slower", "− or [", "play slower", (pygame.K_KP_MINUS,), "-["),
    Binding("stopwatch", "3", "start or stop the stopwatch", (), "3"),
    Binding("next level", "↓", "next level", (pygame.K_DOWN,)),
    Binding("previous level", "↑", "previous level", (pygame.K_UP,)),
    Binding(
        "home",
        "F2 or Backspace",
        "all levels as cards, and back",
        (pygame.K_F2, pygame.K_BACKSPACE),
    ),
    Binding("challenges", "F3", "all challenges as cards", (pygame.K_F3,)),
    Binding("find", "/", "find a level", (), "/"),
    Binding(
        "next field", "Tab", "next field or button; ↑ ↓ change, Enter presses", (pygame.K_TAB,)
    ),
)

SHOWING = (
    Binding("fit", "F", "fit the view", (), "fF"),
    Binding(
        "observe", "4", "see it from the selected body, the centre of mass, or the ground", (), "4"
    ),
    Binding("zoom in", "Z", "zoom in", (), "z"),
    Binding("zoom out", "Shift Z", "zoom out", (), "Z"),
    Binding("levels", "L", "show or hide the levels", (), "lL"),
    Binding("panel", "P", "show or hide the panel", (), "pP"),
    Binding("checks", "2", "the checks of the level", (), "2"),
    Binding("energy", "E", "energy as a graph, as bars, or folded", (), "eE"),
)

LARGER = (pygame.K_PLUS, pygame.K_EQUALS, pygame.K_KP_PLUS)  # the second is + with Shift
SMALLER = (pygame.K_MINUS, pygame.K_KP_MINUS)
USUAL = (pygame.K_0, pygame.K_KP_0)

NEXT_PAGE = "next page"
"""The command that opens the next page; it also reaches pages without a key."""

WINDOW = (
    Binding("page down", "Page down", "scroll the panel down", (pygame.K_PAGEDOWN,)),
    Binding("page up", "Page up", "scroll the panel up", (pygame.K_PAGEUP,)),
    Binding(NEXT_PAGE, "Ctrl Page down", "next page of the panel", controls=(pygame.K_PAGEDOWN,)),
    Binding(
        "previous page", "Ctrl Page up", "previous page of the panel", controls=(pygame.K_PAGEUP,)
    ),
    Binding("open file", "Ctrl O", "open a level of your own", controls=(pygame.K_o,)),
    Binding("undo", "Ctrl Z", "undo a change of the run", controls=(pygame.K_z,)),
    Binding("redo", "Ctrl Y", "redo (also Ctrl Shift Z)", controls=(pygame.K_y,)),
    Binding("reload", "F5", "read the level's file again", (pygame.K_F5,)),
    Binding("larger", "Ctrl +", "larger text", controls=LARGER),
    Binding("smaller", "Ctrl −", "smaller text", controls=SMALLER),
    Binding("usual size", "Ctrl 0", "text size that suits the screen", controls=USUAL),
    Binding("next theme", "Ctrl T", "dark, light, or high contrast", controls=(pygame.K_t,)),
    Binding("help", "H or F1", "this help", (pygame.K_F1,), "hH?"),
    Binding(
        "leave", "Esc", "close this, leave a field or a search; twice: quit", (pygame.K_ESCAPE,)
    ),
)

MOUSE = (
    ("drag the tip of a force", "change it; the run restarts"),
    ("click on a body", "select it: the page Forces shows its forces"),
    ("drag a body", "pull it, or move it while paused"),
    ("Shift and drag a slider", "change it from now on instead of from the start, or the reverse"),
    ("drag the stage", "move the view; the wheel zooms"),
    ("Shift and drag", "measure a distance; then Ctrl, Shift and drag: an angle at its end"),
    ("rest on a trail", "when it was there, where, and how fast"),
    ("click on the time's bar", "go there, or drag to look through the run; dots are impacts"),
    ("drop a file", "open a level of your own"),
)

COMFORT = frozenset({"larger", "smaller", "usual size", "next theme"})
"""The commands that only change how the window looks."""

AT_HOME = COMFORT | {
    "next field", "home", "challenges", "find", "levels", "open file", "help", "leave",
}  # fmt: skip
"""The commands that work on the home page; any other returns to the stage first."""

WHILE_TYPING = COMFORT | {"next field", "leave", "undo", "redo"}
"""The commands whose keys also work while the user types."""
