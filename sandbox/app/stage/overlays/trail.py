"""The overlay with the paths of bodies."""

from itertools import pairwise

import pygame

from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.overlays.overlay import Overlay

PIECES, PIECE = 120, 8
"""The number of straight pieces of paths that labels avoid, and of steps in a piece."""


def _keep_labels_off(_: pygame.Surface, view: DrawingContext) -> None:
    """Keep labels off the last part of each path, which the stage draws on its own canvas."""
    if view.trail is None or not view.few or not view.moving:
        return
    recent = view.observer.path(view.trail.points[-PIECE * PIECES // len(view.moving) - 1 :])
    for outline in view.moving:
        for piece in pairwise(view.camera.path(recent[-1::-PIECE, outline.row].tolist())):
            view.labels.mark(*piece)


OVERLAY = Overlay(
    name="trail", key="t", text="trail", draw=_keep_labels_off, draw_trail=True, caption="Trail"
)
