"""Moving bodies are visible at the start, whatever the shape of the window."""

import pytest

from sandbox.app.drawing.camera import Camera
from sandbox.app.stage.body_outlines import outlines
from sandbox.model import level_catalog
from sandbox.model.loading import load
from sandbox.physics.run import build

SIZES = ((716, 740), (1280, 720), (480, 300))  # px: of the window, the README, a small picture


@pytest.mark.sweep
@pytest.mark.parametrize("name", level_catalog.names())
def test_what_moves_is_seen_at_the_start(name: str) -> None:
    """The lander fell from above the picture, and the rocket stood below it."""
    world = build(load(level_catalog.find(name)))
    moving = [o for o in outlines(world.level, world.values).values() if o.moves and not o.hidden]
    for size in SIZES:
        camera = Camera(size)
        camera.fit(world.level.view, world.values)
        for outline in moving:
            x, y = camera.to_screen(tuple(world.snapshot.position[outline.row].tolist()))

            assert 0 <= x <= size[0], (outline.name, size)
            assert 0 <= y <= size[1], (outline.name, size)
