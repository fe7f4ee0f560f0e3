"""Colours, after Okabe and Ito's palette, which no common colour blindness confuses."""

from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path

Color = tuple[int, int, int]

STAGE: Color = (13, 18, 26)
PANEL: Color = (22, 29, 40)
RAISED: Color = (32, 42, 57)
EDGE: Color = (44, 57, 76)
GRID: Color = (24, 33, 46)
GRID_STRONG: Color = (37, 50, 69)
AXIS: Color = (70, 89, 117)
FLAME: Color = (255, 140, 60)
FLAME_CORE: Color = (255, 224, 130)
TEXT: Color = (232, 238, 246)
DIM: Color = (145, 160, 181)
ACCENT: Color = (86, 180, 233)
STRING: Color = (226, 220, 205)
SPRING: Color = (190, 176, 224)
SURFACE: Color = (58, 71, 91)
SURFACE_EDGE: Color = (128, 146, 172)
GHOST: Color = (240, 228, 66)
ARROW: Color = (64, 224, 170)
ACROSS: Color = (96, 205, 240)
UPWARDS: Color = (178, 156, 255)
ACCELERATION: Color = (255, 150, 90)
RESULTANT: Color = (255, 214, 80)
FORCES: tuple[Color, ...] = ((255, 128, 96), (232, 140, 200), (150, 200, 120))

ACTING: Mapping[str, Color] = {
    "weight": (178, 156, 255),
    "normal force": (86, 180, 233),
    "friction": (255, 128, 96),
    "tension": (240, 200, 120),
    "rod force": (240, 200, 120),
    "reaction": (226, 170, 110),
    "spring force": (150, 200, 120),
    "drag": (232, 140, 200),
    "applied force": (64, 200, 170),
    "magnetic force": (120, 150, 255),
    "impact": (255, 80, 80),
    "hand": (255, 255, 255),
}
"""Of the forces on a body, by what they are called; others have one of those of bodies."""

LANES: tuple[Color, ...] = (GHOST, (255, 112, 67), (232, 140, 200))
"""Of what runs beside the level that is played."""

KINETIC: Color = (230, 159, 0)
POTENTIAL: Color = (86, 180, 233)
TOTAL: Color = (214, 222, 233)

PASSED: Color = (45, 200, 150)
FAILED: Color = (255, 112, 67)
WAITING: Color = (145, 160, 181)
NOTICE: Color = (240, 200, 90)

BODIES: tuple[Color, ...] = (
    (86, 180, 233),
    (230, 159, 0),
    (204, 121, 167),
    (0, 178, 130),
    (213, 110, 50),
    (170, 150, 235),
)

JSON = Path(str(files("sandbox.app") / "theme.json"))
"""The look of the widgets."""


def mix(a: Color, b: Color, share: float) -> Color:
    """Return a colour on the way from one to another."""
    red, green, blue = (round(p + (q - p) * share) for p, q in zip(a, b, strict=True))
    return red, green, blue


def parse(text: str) -> Color:
    """Return the colour of a level's "#rrggbb"."""
    red, green, blue = bytes.fromhex(text[1:])
    return red, green, blue
