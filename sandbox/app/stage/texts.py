"""Draws the labels of a level, at points of the plane or on bodies."""

from collections.abc import Mapping

import pygame

from sandbox.app.drawing import lines
from sandbox.app.stage.view import View
from sandbox.app.words import level_words
from sandbox.model.expressions import Values
from sandbox.model.joints import End, Held, body_of
from sandbox.model.shapes import evaluate
from sandbox.physics.state.anchor import Anchor


def draw_texts(surface: pygame.Surface, view: View) -> None:
    """Draw the labels of a level, and reserve their places among other labels."""
    world, words = view.world, level_words.of(view.world.level)
    rows = {name: row for row, name in enumerate(world.level.bodies)}
    for label in view.world.level.view.labels:
        place, _ = _anchor(label.at, rows, world.values).find(world.snapshot)
        pixel = view.camera.to_screen((float(place.real), float(place.imag)))
        if lines.near((pixel,)):
            text = view.pen.outlined(words(label.text))
            where = text.get_rect(center=(round(pixel[0]), round(pixel[1])))
            surface.blit(text, where)
            view.labels.take(where)


def _anchor(end: End, rows: Mapping[str, int], values: Values) -> Anchor:
    body = body_of(end)
    if body is None:
        assert isinstance(end, tuple)
        return Anchor(None, complex(*evaluate(end, values)))
    point = complex(*evaluate(end.at, values)) if isinstance(end, Held) else 0j
    return Anchor(rows[body], point)
