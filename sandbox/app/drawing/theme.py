"""The colours of the current theme; each theme declares all of them in a file of `themes`.

Those of the dark theme follow Okabe and Ito's palette, which stays distinct with any common colour
blindness.
"""

import json
from collections.abc import Mapping
from functools import cache, lru_cache
from importlib.resources import files
from typing import Any, Literal, get_args

Color = tuple[int, int, int]

Name = Literal["dark", "light", "contrast"]
"""The name of a theme, and of its file."""
NAMES: tuple[Name, ...] = get_args(Name)
"""All themes, in the order of the menu."""
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
HIGHLIGHT: Color
SHADOW: Color
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
"""The colours of the forces on a body, by name; other forces take colours from `BODIES`."""
LANES: tuple[Color, ...]
"""The colours of companion runs and of earlier runs."""
BODIES: tuple[Color, ...]
SHADING: float
"""How strongly shapes are shaded, from 0 to 1."""

_used = DARK


def use(name: Name) -> None:
    """Switch to a theme's colours; pictures that are already drawn do not change."""
    global _used
    _used = name
    globals().update({key.upper(): value for key, value in palette(name).items()})


def used() -> Name:
    """Return the name of the current theme."""
    return _used


def title(name: Name) -> str:
    """Return the title of a theme, for the menu."""
    return str(_read(name)["title"])


@cache
def palette(name: Name) -> Mapping[str, Any]:
    """Return the colours of a theme by name: single colours, sequences, or mappings.

    `fading` is the exponent of the share in `faded`: with a smaller one, colours stay stronger.
    """
    return {key: _colors(value) for key, value in _read(name).items() if key != "title"}


def widgets(scale: float) -> dict[str, Any]:
    """Return the theme of pygame_gui's widgets, with the current colours and scaled sizes."""
    look = json.loads((_FOLDER / "widgets.json").read_text(encoding="utf-8"))
    declared = _read(_used)
    for part in look.values():
        colours, misc, font = (part.get(kind, {}) for kind in ("colours", "misc", "font"))
        colours.update({key: declared[name] for key, name in colours.items()})
        misc.update({key: _scaled(misc[key], scale) for key in _LENGTHS & set(misc)})
        font.update({key: _scaled(font[key], scale) for key in {"size"} & set(font)})
    return dict(look)


@lru_cache(maxsize=4096)
def mix(a: Color, b: Color, share: float) -> Color:
    """Return a mixture of two colours, with some share of the second."""
    red, green, blue = (round(p + (q - p) * share) for p, q in zip(a, b, strict=True))
    return red, green, blue


def contrasting(color: Color) -> Color:
    """Return the one of the colours of stage and text that is easier to see on a colour."""
    now = palette(_used)
    found: Color = max(now["stage"], now["text"], key=lambda each: abs(_luma(each) - _luma(color)))
    return found


def faded(color: Color, share: float) -> Color:
    """Return a colour faded into that of the stage, with some share of it left."""
    now = palette(_used)
    return mix(now["stage"], color, share ** now["fading"])


def parse(text: str) -> Color:
    """Return the colour of a level's "#rrggbb"."""
    red, green, blue = bytes.fromhex(text[1:])
    return red, green, blue


def _luma(color: Color) -> float:
    red, green, blue = color
    return 0.299 * red + 0.587 * green + 0.114 * blue


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
    """Scale lengths that are separated by commas [px]."""
    return ",".join(str(round(float(each) * scale)) for each in lengths.split(","))


use(DARK)
