"""A view of a world: the data from which the stage and its overlays draw."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
import pygame

from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.stage import motion_annotations
from sandbox.app.stage.body_outlines import Outline, outlines
from sandbox.app.stage.frame_of_reference import FrameOfReference
from sandbox.app.stage.given_force_arrows import Forces
from sandbox.app.stage.label_placement import Labels
from sandbox.app.words.formatting import rounded_up
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.measuring.recording import count_steps
from sandbox.physics.stepping.world import World

if TYPE_CHECKING:
    from sandbox.app.observing.forces_on_selected_body import SelectedBody
    from sandbox.app.observing.impacts import Flash
    from sandbox.app.observing.thinned_series import ThinnedSeries
    from sandbox.model.expressions import Array

NAMED = 12
"""The largest number of moving bodies that have names, arrows and trails."""

LONGER = 1.1
"""An arrow longer than this multiple of the longest length makes the scale shrink."""


class DrawingContext:
    """A world with its camera and its outlines."""

    def __init__(
        self, world: World, camera: Camera, pen: Pen, shown: Mapping[str, bool],
        seen_from: str | None = None,
    ) -> None:  # fmt: skip
        self.world, self.camera, self.pen = world, camera, pen
        self.observer = FrameOfReference(world, seen_from)
        """The observer of the picture."""
        self.shown = shown
        """Whether each overlay is drawn, by name."""
        self.outlines = outlines(world.level, world.values)
        """The outlines of all bodies, by name."""
        seen = sorted((o for o in self.outlines.values() if not o.hidden), key=lambda o: o.layer)
        self.moving: Sequence[Outline] = [o for o in seen if o.moves]
        """The outlines of moving bodies without hidden ones, the lowest layer first."""
        self.still: Sequence[Outline] = [o for o in seen if not o.moves]
        """The same of static bodies."""
        raised = [o for o in self.still if o.layer > 0]
        self.in_front = sorted([*self.moving, *raised], key=lambda o: o.layer)
        """The outlines drawn in every frame: moving bodies, and static ones on a layer above 0."""
        self.few = len(self.moving) <= NAMED
        """Whether there are at most `NAMED` moving bodies, so that each can be explained."""
        self.duration = count_steps(world) * world.dt
        """The duration of the run [s]."""
        self.forces = Forces(world.level)
        """The level's given forces as arrows."""
        self.trail: ThinnedSeries | None = None
        """The paths of the bodies, or None."""
        self.looking: SelectedBody | None = None
        """The selected body, or None."""
        self.flashes: Sequence[Flash] = ()
        """The flashes of recent impacts."""
        self.kept: dict[str, int] = {}
        """The place last chosen for each label, as its index among the candidates."""
        self.labels = Labels(pygame.Rect((0, 0), camera.size), self.kept)
        """The places of labels in the current frame."""
        self._full: dict[str, float] = {}
        self.starts: Array = np.array(
            [evaluate(world.level.bodies[o.name].position, world.values) for o in self.moving]
        )
        """The positions of moving bodies in the level: (k, 2) [m]."""
        self._fastest = motion_annotations.expected_highest_speed(world, self.duration)

    def state(self, outline: Outline) -> tuple[XY, float]:
        """Return the position [m] and the angle [rad] of a body."""
        snapshot = self.world.snapshot
        x, y = snapshot.position[outline.row].tolist()
        return (x, y), float(snapshot.angle[outline.row])

    def velocity(self, outline: Outline) -> XY:
        """Return the velocity of a body as the observer sees it [m/s]."""
        vx, vy = self.observer.relative(self.world.snapshot.velocity)[outline.row].tolist()
        return vx, vy

    @property
    def colors(self) -> Sequence[Color]:
        """The colours of moving bodies, without repetition."""
        return list(dict.fromkeys(outline.color for outline in self.moving))

    @property
    def boxes(self) -> Sequence[pygame.Rect]:
        """The bounding boxes of the moving bodies near the picture [px]."""
        placed = ((each, *self.state(each)) for each in self.moving)
        return motion_annotations.bounding_boxes(self.camera, placed)

    @property
    def width(self) -> float:
        """The width of the visible part of the plane [m]."""
        return self.camera.size[0] / self.camera.scale

    @property
    def fastest(self) -> float:
        """The speed that corresponds to the longest arrow [m/s], for a common scale over a run.

        If the run becomes faster than expected, this speed is raised to a round number, so that the
        scale changes rarely.
        """
        self.note_speeds()
        return self._fastest

    def full_length_value(self, kind: str, now: float) -> float:
        """Return the value of a full-length arrow of some kind, given the largest at present.

        It is a round number, which grows if necessary, so that the scale changes rarely.
        """
        full = self._full.get(kind, 0.0)
        self._full[kind] = full if now <= full else rounded_up(now)
        return self._full[kind]

    def keep_scale(self, speed: float) -> None:
        """Raise `fastest` to at least a speed [m/s], such as that of an earlier view of the run."""
        self._fastest = max(self._fastest, speed)

    def note_speeds(self) -> None:
        """Adapt the scale of arrows to the current speeds."""
        velocity = self.observer.relative(self.world.snapshot.velocity)
        speed = float(np.hypot(velocity[:, 0], velocity[:, 1]).max(initial=0.0))
        if speed > LONGER * self._fastest:
            self._fastest = rounded_up(speed)
