"""The overlay with the accelerations of bodies as arrows."""

import numpy as np
import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.stage import momentum_scale
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.motion_annotations import LONGEST
from sandbox.app.stage.overlays.overlay import Overlay
from sandbox.app.words.formatting import number


def _draw(surface: pygame.Surface, view: DrawingContext) -> None:
    rows = dict(momentum_scale.bodies_with_momentum(view.world))
    every = view.observer.relative(view.world.snapshot.acceleration)
    sizes = np.hypot(*every[list(rows)].T) if rows and view.few else np.zeros(0)
    if not sizes.any() or not np.isfinite(sizes).all():
        return
    typical = float(np.median(sizes[sizes > 0]))  # an impact does not set the scale
    full = view.full_length_value("acceleration", typical)  # m/s²
    longest = LONGEST * view.camera.size[0]
    for (row, name), size in zip(rows.items(), sizes.tolist(), strict=True):
        if not size:
            continue
        share = min(longest / full, 2 * longest / size)
        x, y = view.camera.to_screen(view.state(view.outlines[name])[0])
        end = x + float(every[row, 0]) * share, y - float(every[row, 1]) * share
        lines.arrow(surface, theme.ACCELERATION, (x, y), end)
        image = view.pen.outlined(f"a = {number(size, 3)} m/s²")
        places = (
            image.get_rect(center=(end[0] + dx * (image.width / 2 + 8), end[1] + dy * image.height))
            for dx, dy in ((0, 1), (0, -1), (1, 0), (-1, 0))
        )
        if lines.are_close((end,)) and (place := view.labels.place_for(places)):
            surface.blit(image, place)


OVERLAY = Overlay(
    name="accelerations",
    key=";",
    text="arrows of accelerations",
    draw=_draw,
    caption="Accelerations",
    on=lambda _level: False,
)
