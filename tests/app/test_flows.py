"""Belts and flames, as they are drawn."""

import numpy as np
import pygame

from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.runs.session import Session
from sandbox.app.stage.stage import Stage
from sandbox.model import level_catalog
from sandbox.model.loading import load

SIZE = (800, 600)


def columns(pen: Pen, session: Session, color: Color) -> set[int]:
    """Return the columns of the picture that have a colour."""
    stage = Stage(pen, SIZE)
    stage.use(session.world)
    stage.fit()
    stage.shown["arrows"] = stage.shown["ghosts"] = False
    surface = pygame.Surface(SIZE)
    stage.draw(surface)
    pixels = pygame.surfarray.array3d(surface)
    return {int(x) for x in np.nonzero((pixels == color).all(axis=2).any(axis=1))[0]}


def test_the_marks_of_a_belt_run_with_it(pen: Pen) -> None:
    session = Session(load(level_catalog.find("newton/block-on-a-belt")))
    at_start = columns(pen, session, theme.NOTICE)
    session.step()
    session.step()
    session.step()
    later = columns(pen, session, theme.NOTICE)

    stage = Stage(pen, SIZE)
    stage.use(session.world)
    stage.fit()
    run = session.values["v"] * session.t * stage.camera.scale
    moved = {round(x + run) + i for x in at_start for i in (-1, 0, 1)}
    seen = [x for x in later if min(at_start) + 5 < x < max(at_start) - 5]
    assert len(seen) > 3
    assert run > 1
    assert all(x in moved for x in seen)


def test_a_rocket_burns_as_long_as_it_has_propellant(pen: Pen) -> None:
    level = load(level_catalog.find("newton/rocket"))
    session = Session(level)
    burning = columns(pen, session, theme.FLAME)
    x = float(session.world.snapshot.position[0, 0])
    thrust = (level.effects.thrust or ())[0]
    burnt = thrust.propellant(session.values) / thrust.rate(session.values)
    while session.t < burnt and session.failure is None:
        session.step()

    assert session.failure is None
    assert len(burning) > 5
    stage = Stage(pen, SIZE)
    stage.use(session.world)
    stage.fit()
    assert max(burning) < stage.camera.to_screen((x, 0))[0]  # behind, for it flies to the right
    stage.camera.center = tuple(session.world.snapshot.position[0].tolist())
    surface = pygame.Surface(SIZE)
    stage.draw(surface)
    assert not (pygame.surfarray.array3d(surface) == theme.FLAME).all(axis=2).any()
