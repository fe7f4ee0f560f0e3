"""A view of a world: what the stage and its overlays draw from."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
import pygame

from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.stage import marks
from sandbox.app.stage.given_forces import Forces
from sandbox.app.stage.labels import Labels
from sandbox.app.stage.outline import Outline, outlines
from sandbox.app.words.formatting import rounded_up
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.stepping.world import World

if TYPE_CHECKING:
    from sandbox.app.observing.impacts import Flash
    from sandbox.app.observing.selected_body import Looking
    from sandbox.app.observing.thinned_series import Trail
    from sandbox.model.expressions import Array

NAMED = 12
"""Up to how many moving bodies have a name, an arrow and a trail."""

LONGER = 1.1
"""How far an arrow may exceed the longest length before all are drawn shorter."""


class View:
    """A world with its camera and its outlines.

    Attributes
    ----------
    world, camera, pen
        The world, the camera, and the pen.
    outlines, moving, still
        The outlines of all bodies by name, and those of the bodies that move, and that do not, but
        for hidden ones; the lowest layer first.
    in_front
        The outlines drawn in every frame: moving bodies, and those above them.
    few
        Whether so few bodies move that each can be explained.
    duration
        When the run is complete [s].
    forces
        The level's given forces as arrows.
    shown
        Which overlays are drawn, by name.
    trail
        Where the bodies have been; None if nobody keeps it.
    looking
        The selected body; None if there is none.
    starts
        Where the level places what moves: (k, 2) [m].
    flashes
        Of the impacts that have just been.
    labels
        Where there is room for words in the present frame.
    """

    def __init__(self, world: World, camera: Camera, pen: Pen, shown: Mapping[str, bool]) -> None:
        self.world, self.camera, self.pen, self.shown = world, camera, pen, shown
        self.outlines = outlines(world.level, world.values)
        seen = sorted((o for o in self.outlines.values() if not o.hidden), key=lambda o: o.layer)
        self.moving: Sequence[Outline] = [o for o in seen if o.moves]
        self.still: Sequence[Outline] = [o for o in seen if not o.moves]
        raised = [o for o in self.still if o.layer > 0]
        self.in_front = sorted([*self.moving, *raised], key=lambda o: o.layer)
        self.few = len(self.moving) <= NAMED
        self.duration = count_steps(world) * world.dt
        self.forces = Forces(world.level)
        self.trail: Trail | None = None
        self.looking: Looking | None = None
        self.flashes: Sequence[Flash] = ()
        self.labels = Labels(pygame.Rect((0, 0), camera.size))
        self.starts: Array = np.array(
            [evaluate(world.level.bodies[o.name].position, world.values) for o in self.moving]
        )
        self._fastest = marks.fastest(world, self.duration)

    def state(self, outline: Outline) -> tuple[XY, float]:
        """Return where a body is [m], and its angle [rad]."""
        snapshot = self.world.snapshot
        x, y = snapshot.position[outline.row].tolist()
        return (x, y), float(snapshot.angle[outline.row])

    @property
    def colors(self) -> Sequence[Color]:
        """The colours of what moves, each once."""
        return list(dict.fromkeys(outline.color for outline in self.moving))

    @property
    def width(self) -> float:
        """How much of the plane is seen [m]."""
        return self.camera.size[0] / self.camera.scale

    @property
    def fastest(self) -> float:
        """The speed that the longest arrow stands for [m/s]: they keep to one scale over a run.

        Where a run becomes faster than was expected, it is a round number, so that arrows grow
        with the speed until the next.
        """
        self.watch()
        return self._fastest

    def keep_scale(self, speed: float) -> None:
        """Let the longest arrow stand for a speed at least, as in another view of the run [m/s]."""
        self._fastest = max(self._fastest, speed)

    def watch(self) -> None:
        """Note how fast the world is now."""
        velocity = self.world.snapshot.velocity
        speed = float(np.hypot(velocity[:, 0], velocity[:, 1]).max(initial=0.0))
        if speed > LONGER * self._fastest:
            self._fastest = rounded_up(speed)
