"""Draws the labels of a level, at points of the plane or on bodies, and who observes it."""

from collections.abc import Mapping

import pygame

from sandbox.app.drawing import lines
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.frame_of_reference import CENTER
from sandbox.app.words import level_translation
from sandbox.app.words.formatting import name_in_words
from sandbox.app.words.language import say
from sandbox.model.expressions import Values
from sandbox.model.joints import End, Held, body_of
from sandbox.model.shapes import evaluate
from sandbox.physics.state.joint_anchors import Anchor

MARGIN = 8  # px, from the corner to the name of the observer


def draw_texts(surface: pygame.Surface, view: DrawingContext) -> None:
    """Draw the labels of a level, and reserve their places among other labels."""
    world, words = view.world, level_translation.of(view.world.level)
    rows = {name: row for row, name in enumerate(world.level.bodies)}
    for label in view.world.level.view.labels:
        place, _ = _anchor(label.at, rows, world.values).position_and_arm(world.snapshot)
        pixel = view.camera.to_screen((float(place.real), float(place.imag)))
        if lines.are_close((pixel,)):
            text = view.pen.outlined(words(label.text))
            where = text.get_rect(center=(round(pixel[0]), round(pixel[1])))
            if where.colliderect(view.labels.bounds):  # one at the edge is not cut off
                where.clamp_ip(view.labels.bounds)
            surface.blit(text, where)
            view.labels.occupy(where)


def draw_observer(surface: pygame.Surface, view: DrawingContext) -> None:
    """Write in the lower left corner from where the world is seen, unless from the ground."""
    place = view.observer.place
    if place is None:
        return
    text = view.pen.outlined(seen_from(place))
    where = text.get_rect(bottomleft=view.labels.bounds.move(MARGIN, -MARGIN).bottomleft)
    surface.blit(text, where)
    view.labels.occupy(where)


def seen_from(place: str | None) -> str:
    """Describe the place of an observer."""
    if place is None:
        return say("seen from the ground")
    if place == CENTER:
        return say("seen from the centre of mass")
    return say("seen from {body}", body=name_in_words(place))


def _anchor(end: End, rows: Mapping[str, int], values: Values) -> Anchor:
    body = body_of(end)
    if body is None:
        assert isinstance(end, tuple)
        return Anchor(None, complex(*evaluate(end, values)))
    point = complex(*evaluate(end.at, values)) if isinstance(end, Held) else 0j
    return Anchor(rows[body], point)
