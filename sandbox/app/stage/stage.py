"""Draws the picture of a world, on any surface."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import pygame

from sandbox.app.drawing import lines, shading, theme
from sandbox.app.drawing.camera import Camera
from sandbox.app.drawing.text import Pen
from sandbox.app.observing.events_of_checks import Milestone
from sandbox.app.observing.thinned_series import ThinnedSeries
from sandbox.app.runs.companion_runs import Companion
from sandbox.app.stage import (
    belts_and_flames,
    bodies,
    grid,
    joint_polylines,
    joints,
    level_labels,
    liquid,
    motion_annotations,
    static_bodies,
    wires,
)
from sandbox.app.stage.body_outlines import Outline
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.frame_of_reference import FrameOfReference
from sandbox.app.stage.given_force_arrows import Arrow
from sandbox.app.stage.label_placement import Labels
from sandbox.app.stage.overlays.overlay import Overlay
from sandbox.app.stage.overlays.register import OVERLAYS, at_first
from sandbox.app.stage.potential_curve_with_body import PotentialLandscape
from sandbox.app.words import level_translation
from sandbox.model.joints import Wire
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.stepping.world import World

EDGE = 4  # px, between labels and the edge of the stage
CORNERS = 8
"""The largest number of corners of a static body whose sides labels avoid."""


class Stage:
    """Draws a world. Static parts are drawn once and kept.

    Attributes
    ----------
    camera
        The part of the plane that is shown.
    seen_from
        The place of the observer, see `FrameOfReference`.
    shown
        Whether each overlay is drawn, by name.
    asked
        The name of an overlay that is always drawn, or empty.
    view
        The view of the world, for overlays.
    plain
        Whether grid, rulers and scale bar are left out, as in a picture too small for them.
    """

    view: DrawingContext

    def __init__(self, pen: Pen, size: tuple[int, int], *, plain: bool = False) -> None:
        self.camera, self.plain = Camera(size), plain
        self.shown, self.asked = at_first(), ""
        self.seen_from: str | None = None
        self._pen = pen
        self._base = pygame.Surface(size)
        self._canvas = pygame.Surface(size)
        self._base_key: object = None
        self._wires: Sequence[Sequence[XY]] = ()  # points along those that are drawn [px]
        self._trail_key: object = None
        self._trail_drawn: list[int] = []
        self._level: object = None

    def use(self, world: World) -> None:
        """Show another world; a part of the plane that the user has chosen stays."""
        again = world.level is self._level and world.values == self.view.world.values
        if world.level is not self._level:
            self._level = world.level
            for overlay in OVERLAYS:
                if overlay.on is not None:
                    self.shown[overlay.name] = overlay.on(world.level)
        fastest = self.view.fastest if again and float(world.snapshot.t) else 0.0  # of the same run
        self.view = DrawingContext(world, self.camera, self._pen, self.shown, self.seen_from)
        self.view.keep_scale(fastest)
        landscape = world.level.view.landscape
        self._relief = landscape and PotentialLandscape(landscape, world)
        self._base_key = None
        if self.camera.fitted:
            self.fit()

    def observe(self, place: str | None) -> None:
        """Show the world as seen from a place, see `FrameOfReference`."""
        self.seen_from, self.view.observer = place, FrameOfReference(self.view.world, place)

    def fit(self) -> None:
        """Show the part of the plane in the level's view."""
        self.camera.fit(self.view.world.level.view, self.view.world.values)

    def resize(self, size: tuple[int, int]) -> None:
        """Set the size of the surfaces to draw on [px]."""
        if size != self.camera.size:
            self.camera.resize(size)
            self._base, self._canvas = pygame.Surface(size), pygame.Surface(size)
            self._base_key = None

    def draw(
        self, surface: pygame.Surface, trail: ThinnedSeries | None = None,
        milestones: Sequence[Milestone] = (), beside: Sequence[Companion] = (),
        earlier: Sequence[ThinnedSeries] = (),
    ) -> None:  # fmt: skip
        """Draw the current world on a surface of the stage's size.

        Companions `beside` it are drawn over it; without any, the trails of `earlier` runs are.
        """
        view, world, outlines = self.view, self.view.world, self.view.outlines
        self.camera.offset, grounded = view.observer.displacement, view.observer.place is None
        area = surface.get_rect() if self.plain else grid.inside(self.camera, self._pen)
        view.trail = trail
        view.labels = Labels(area.inflate(-2 * self._pen.px(EDGE), 0), view.kept)
        wide, high = self._pen.px(130), self._pen.px(90)
        view.labels.occupy(pygame.Rect(surface.width - wide, surface.height - high, wide, high))
        self._draw_base()
        if view.few:
            _mark_lines(view, self._wires)
        traced = view.few and any(each.draw_trail for each in self._overlays)
        others = [(each.trail, each.variant.color) for each in beside] or [
            (trail, theme.LANES[i % len(theme.LANES)]) for i, trail in enumerate(earlier)
        ]
        self._draw_trails(trail if traced else None, others if traced and grounded else ())
        surface.blit(self._canvas, (0, 0))
        if self._relief:
            self._relief.draw_point(surface, self.camera, self._pen)
        self._draw_joints(surface, in_front=False)
        belts_and_flames.draw_belts(surface, self.camera, world, outlines)
        belts_and_flames.draw_flames(surface, self.camera, world, outlines)
        self._draw_bodies(surface)
        liquid.draw_veil(surface, self.camera, world)
        self._draw_joints(surface, in_front=True)
        self._draw_companions(surface, beside)
        level_labels.draw_observer(surface, view)
        level_labels.draw_texts(surface, view)
        marked = milestones if view.few and grounded else ()
        motion_annotations.draw_milestones(surface, self.camera, marked, view.labels)
        for overlay in self._overlays:
            if overlay.draw is not None:
                overlay.draw(surface, view)
        if marked:
            self._write(surface, marked)

    def _write(self, surface: pygame.Surface, milestones: Sequence[Milestone]) -> None:
        """Write the measured values, after the arrows, which cannot move out of the way."""
        view, words = self.view, level_translation.of(self.view.world.level)
        filled = (*view.moving, *(o for o in view.still if o.radius is not None))
        placed = [(each, *view.state(each)) for each in filled]
        avoid = motion_annotations.bounding_boxes(self.camera, placed)
        motion_annotations.mark_large(self.camera, placed, view.labels)
        motion_annotations.write_milestones(
            surface, self.camera, self._pen, milestones, words, view.labels, avoid
        )

    @property
    def _overlays(self) -> Sequence[Overlay]:
        """The overlays to draw."""
        return [each for each in OVERLAYS if self.shown[each.name] or each.name == self.asked]

    def _draw_companions(self, surface: pygame.Surface, beside: Sequence[Companion]) -> None:
        """Draw the bodies of companion runs as dashed outlines."""
        for companion in beside:
            snapshot, lane = companion.world.snapshot, companion.variant.lane
            for outline in self.view.moving:
                x, y = snapshot.position[outline.row].tolist()
                angle = float(snapshot.angle[outline.row])
                motion_annotations.draw_ghost(surface, self.camera, outline, (x, y), angle, lane)

    def body_at(self, pixel: XY, margin: float = 6.0) -> str | None:
        """Return the dynamic body at a pixel, within a margin [px], or None."""
        x, y = self.camera.to_world(pixel)
        reach = margin / self.camera.scale
        for outline in reversed(self.view.moving):
            (px, py), angle = self.view.state(outline)
            if outline.is_dynamic and outline.covers((x - px, y - py), angle, reach):
                return outline.name
        return None

    def tip_at(self, pixel: XY) -> Arrow | None:
        """Return the force whose tip can be dragged at a pixel, or None."""
        if not (self.shown["arrows"] and self.view.few):
            return None
        return self.view.forces.tip_at(self.view.world, self.camera, pixel)

    @property
    def newton(self) -> float:
        """The length of the arrow of a force of 1 N [px]."""
        return self.view.forces.scale(self.camera)

    def _draw_base(self) -> None:
        camera = self.camera
        below = [each.draw_below for each in self._overlays if each.draw_below is not None]
        touched = self.view.world.disturbed
        wired = tuple(wires.holding_wires(self.view.world))
        key = (camera.center, camera.scale, camera.size, touched, wired, *below)
        key = (*key, self.view.observer.place)
        if key == self._base_key:
            return
        self._base_key, self._trail_key = key, None
        shading.backdrop(self._base)
        if not self.plain:
            grid.draw_grid(self._base, camera)
        liquid.draw_liquid(self._base, camera, self.view.world)
        middle = self._middle()
        for outline in self.view.still:
            if outline.layer <= 0:
                self._draw_surface(self._base, outline, middle)
        self._draw_centers()
        self._wires = wires.draw_wires(self._base, camera, self.view.world)
        if self._relief:
            self._relief.draw_curve(self._base, camera, self._pen)
        for draw in below:
            draw(self._base, self.view)
        if not self.plain:
            grid.draw_rulers(self._base, camera, self._pen)
            grid.draw_scale_bar(self._base, camera, self._pen)

    def _draw_surface(self, surface: pygame.Surface, outline: Outline, middle: XY) -> None:
        inside = self._nearest(outline) if outline.curved else middle
        static_bodies.draw_surface(surface, self.camera, outline, *self.view.state(outline), inside)

    def _middle(self) -> XY:
        """Return the mean start position of the moving bodies [m], else the camera's centre."""
        if not self.view.moving:
            return self.camera.center
        x, y = self.view.starts.mean(axis=0).tolist()
        return x, y

    def _nearest(self, outline: Outline) -> XY:
        """Return the start position nearest to an outline among the moving bodies [m]."""
        if not self.view.moving:
            return self.camera.center
        line = np.array(outline.placed(*self.view.state(outline)))
        away = [np.hypot(*(line - start).T).min() for start in self.view.starts]
        x, y = self.view.starts[int(np.argmin(away))].tolist()
        return x, y

    def _draw_centers(self) -> None:
        """Mark the centres of attraction."""
        for attraction in self.view.world.level.effects.attraction or ():
            x, y = self.camera.to_screen(evaluate(attraction.center, self.view.world.values))
            if not self._base.get_rect().collidepoint(x, y):
                continue
            red, green, blue, _ = self._base.get_at((int(x), int(y)))
            color = theme.contrasting((red, green, blue))
            pygame.draw.aacircle(self._base, color, (x, y), 8, 2)
            lines.cross(self._base, color, (x, y), 5, 2)

    def _draw_trails(
        self, own: ThinnedSeries | None, others: Sequence[tuple[ThinnedSeries, theme.Color]]
    ) -> None:
        """Update the trails on the canvas, starting from the base if necessary."""
        trails = [*(trail for trail, _ in others), *([own] if own else [])]
        colors = [*(color for _, color in others), *([None] if own else [])]
        key = [(id(trail), trail.version) for trail in trails]
        counts = [len(trail) for trail in trails]
        fewer = any(a < b for a, b in zip(counts, self._trail_drawn, strict=False))
        if key != self._trail_key or fewer or not key:
            self._canvas.blit(self._base, (0, 0))
            self._trail_key, self._trail_drawn = key, [0] * len(trails)
        for trail, color, drawn in zip(trails, colors, self._trail_drawn, strict=True):
            if len(trail) > drawn:
                paths = self.view.observer.path(trail.points[max(drawn - 1, 0) :])
                for outline in self.view.moving:
                    drawn_in = motion_annotations.trail_color(color or outline.color)
                    motion_annotations.draw_trail(
                        self._canvas, self.camera, drawn_in, paths[:, outline.row]
                    )
        self._trail_drawn = counts

    def _draw_joints(self, surface: pygame.Surface, *, in_front: bool) -> None:
        """Draw the joints in front of bodies, and open ones, or else those behind bodies."""
        world, many = self.view.world, len(self.view.world.level.joints) > bodies.FEW
        at_once = many and not in_front
        paths = joint_polylines.between_all_ends(world) if at_once else joint_polylines.NONE
        t, made = float(world.snapshot.t), world.scene.joints
        for row, (name, joint) in enumerate(world.level.joints.items()):
            drawn = isinstance(joint, joints.IN_FRONT) is in_front and not isinstance(joint, Wire)
            if not drawn and not (in_front and made.latches):
                continue  # wires are a part of the base
            if not made.holds(name, t):
                if in_front:
                    self._draw_open(surface, name)
                continue
            if not drawn:
                continue
            path = joint_polylines.path_of(self.camera, world, name, joint, self._angle_of, paths)
            if many:
                joints.draw_crowd(surface, self.camera, path)
            else:
                slack = bool(world.snapshot.tension[row] == 0)
                joints.draw_joint(surface, self.camera, joint, path, slack)

    def _angle_of(self, body: str) -> float:
        return self.view.state(self.view.outlines[body])[1]

    def _draw_open(self, surface: pygame.Surface, name: str) -> None:
        """Draw an open joint, if it is still to latch."""
        world = self.view.world
        latches = world.scene.joints.latches
        if latches and latches.is_open(name, float(world.snapshot.t)):
            joints.draw_open(surface, self.camera, joint_polylines.between_ends(world, name))

    def _draw_bodies(self, surface: pygame.Surface) -> None:
        many = len(self.view.moving) > bodies.FEW
        turns = self.view.world.level.effects.rotation is not None
        now = self.view.world.snapshot
        places, angles = now.position.tolist(), now.angle.tolist()
        for outline in self.view.in_front:
            position, angle = places[outline.row], angles[outline.row]
            if not outline.moves:
                self._draw_surface(surface, outline, self._middle())
            elif many:
                bodies.draw_crowd(surface, self.camera, outline, position, angle)
            else:
                bodies.draw_body(surface, self.camera, outline, position, angle, turns)

    def note_speeds(self) -> None:
        """Record the current speeds, for a common scale of arrows over a run."""
        self.view.note_speeds()


def _mark_lines(view: DrawingContext, drawn: Sequence[Sequence[XY]]) -> None:
    """Keep labels off drawn wires, surfaces, posts, springs, strings and rods, if possible.

    Outlines with many corners are left out, since each piece takes time in each frame.
    """
    still = [o for o in view.still if len(o.points) <= CORNERS]
    sides = [(view.camera.path(o.placed(*view.state(o))), o.closed) for o in still]
    for line in (*drawn, *([*side, side[0]] if closed else side for side, closed in sides)):
        for start, end in pairwise(line):
            view.labels.mark(start, end)
    for name, joint in view.world.level.joints.items():
        if isinstance(joint, Wire):
            continue
        pixels = view.camera.path(joint_polylines.between_ends(view.world, name))
        for start, end in pairwise(pixels):
            view.labels.mark(start, end)
