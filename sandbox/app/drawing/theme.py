"""The colours of the current theme; each theme declares all of them in a file of `themes`.

The dark ones are after Okabe and Ito's palette, which no common colour blindness confuses.
"""

import json
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any, Literal, get_args

Color = tuple[int, int, int]

Name = Literal["dark", "light", "contrast"]
"""The name of a theme, and of its file."""
NAMES: tuple[Name, ...] = get_args(Name)
"""All themes, in the order in which they are offered."""
DARK: Name = "dark"
"""The default theme."""

STAGE: Color
PANEL: Color
RAISED: Color
EDGE: Color
GRID: Color
GRID_STRONG: Color
AXIS: Color
TEXT: Color
DIM: Color
ACCENT: Color
NOTICE: Color
PASSED: Color
FAILED: Color
WAITING: Color
FLAME: Color
FLAME_CORE: Color
STRING: Color
SPRING: Color
SURFACE: Color
SURFACE_EDGE: Color
GHOST: Color
ARROW: Color
ACROSS: Color
UPWARDS: Color
ACCELERATION: Color
RESULTANT: Color
KINETIC: Color
POTENTIAL: Color
TOTAL: Color
FORCES: tuple[Color, ...]
ACTING: Mapping[str, Color]
"""The colours of the forces on a body, by name; other forces use colours of bodies."""
LANES: tuple[Color, ...]
"""The colours of the runs beside the one that is played."""
BODIES: tuple[Color, ...]

_used = DARK


def use(name: Name) -> None:
    """Use another theme's colours from now on; what is drawn already stays as it is."""
    global _used
    _used = name
    globals().update({key.upper(): value for key, value in palette(name).items()})


def used() -> Name:
    """Return the name of the theme that is in use."""
    return _used


def title(name: Name) -> str:
    """Return what a theme is called where one is chosen."""
    return str(_read(name)["title"])


@cache
def palette(name: Name) -> Mapping[str, Any]:
    """Return the colours of a theme: one each, or several that are numbered or named.

    `fading` is how far colours fade: the less, the stronger they stay; 1 for as far as is asked.
    """
    return {key: _colors(value) for key, value in _read(name).items() if key != "title"}


def widgets(scale: float) -> dict[str, Any]:
    """Return the look of pygame_gui's widgets: colours of the theme in use, and scaled sizes."""
    look = json.loads((_FOLDER / "widgets.json").read_text(encoding="utf-8"))
    declared = _read(_used)
    for part in look.values():
        colours, misc, font = (part.get(kind, {}) for kind in ("colours", "misc", "font"))
        colours.update({key: declared[name] for key, name in colours.items()})
        misc.update({key: _scaled(misc[key], scale) for key in _LENGTHS & set(misc)})
        font.update({key: _scaled(font[key], scale) for key in {"size"} & set(font)})
    return dict(look)


def mix(a: Color, b: Color, share: float) -> Color:
    """Return a colour on the way from one to another."""
    red, green, blue = (round(p + (q - p) * share) for p, q in zip(a, b, strict=True))
    return red, green, blue


def faded(color: Color, share: float) -> Color:
    """Return what is left of a colour that fades into the stage."""
    now = palette(_used)
    return mix(now["stage"], color, share ** now["fading"])


def parse(text: str) -> Color:
    """Return the colour of a level's "#rrggbb"."""
    red, green, blue = bytes.fromhex(text[1:])
    return red, green, blue


_FOLDER = files("sandbox.app") / "themes"
_LENGTHS = {
    "list_item_height", "padding", "rect_width", "shape_corner_radius", "sliding_button_width",
    "text_horiz_alignment_padding", "title_bar_height",
}  # fmt: skip


@cache
def _read(name: str) -> Mapping[str, Any]:
    return dict(json.loads((_FOLDER / f"{name}.json").read_text(encoding="utf-8")))


def _colors(declared: object) -> object:
    """Return the colours of a declaration, in the same shape."""
    if isinstance(declared, dict):
        return {name: _colors(each) for name, each in declared.items()}
    if isinstance(declared, list):
        return tuple(map(_colors, declared))
    if isinstance(declared, float):
        return declared
    return parse(str(declared))


def _scaled(lengths: str, scale: float) -> str:
    """Scale lengths that are parted by commas [px]."""
    return ",".join(str(round(float(each) * scale)) for each in lengths.split(","))


use(DARK)
