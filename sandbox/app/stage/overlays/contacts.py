"""The overlay with the forces at all contacts, and whether each of them slides.

The force at a contact on one body, normal force and friction together, lies within the friction
cone: at most atan(mu) from the normal. A contact that slides has its force on the edge of the cone.
Both bodies are shown with their own force, so action and reaction are seen together. Of many bodies
only a line from centre to centre is drawn, as wide as the force is strong: a force chain.
"""

from collections.abc import Iterator, Sequence
from functools import partial
from math import atan, cos, hypot, sin
from typing import TYPE_CHECKING, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
import pygame

from sandbox.app.drawing import lines, theme
from sandbox.app.drawing.theme import Color
from sandbox.app.observing.forces_on_selected_body import not_negligible
from sandbox.app.stage import overlay_legend
from sandbox.app.stage.drawing_context import DrawingContext
from sandbox.app.stage.motion_annotations import LONGEST
from sandbox.app.stage.overlays.overlay import Overlay
from sandbox.app.words.formatting import nice
from sandbox.app.words.language import say
from sandbox.model.expressions import Array
from sandbox.model.shapes import XY
from sandbox.physics.contacts.coefficients.pair_coefficients import pair_coefficients
from sandbox.physics.engine.space_arrays import Integers
from sandbox.physics.measuring.free_body import FRICTION, NORMAL, FreeBody
from sandbox.physics.measuring.free_body_forces import FreeBodies
from sandbox.physics.stepping.world import World

if TYPE_CHECKING:
    from sandbox.physics.state.snapshot import Snapshot

MANY = 24
"""The largest number of moving bodies of which each force has an arrow."""
WIDTH, WIDEST = 3.5, 9.0  # px, of an arrow, and of the line of the strongest force
SIGN = 5.0  # px, the radius of the sign at a contact
CUT = 1.5
"""The largest arrow of an impact's force, relative to the longest arrow of other forces."""
ROUNDING = 1e-6
"""Friction counts as being at its limit if it differs by less than this share."""
VEIL = 160
"""The opacity of the veil over many bodies, from 0 to 255."""
KEY = 40.0  # px, about the length of the arrow in the key


class Touch(NamedTuple):
    """The force of a contact on a body."""

    at: XY
    """The point of application [m]."""
    normal: XY
    """The normal force [N]."""
    friction: XY
    """The friction [N]."""
    mu: float
    """The coefficient of friction that limits it: the static one while it holds."""
    slides: bool

    @property
    def force(self) -> XY:
        """The whole force [N]."""
        return self.normal[0] + self.friction[0], self.normal[1] + self.friction[1]


class Touches:
    """The contacts of a world, read once per snapshot."""

    def __init__(self, world: World) -> None:
        self._world, self._bodies = world, FreeBodies(world)
        self._rows = {name: row for row, name in enumerate(world.scene.bodies)}
        self._mu = pair_coefficients(world.level, world.values, "friction")
        self._seen: Snapshot | None = None
        self.all: Sequence[Touch] = ()
        self.struck = False
        """Whether there is an impact among them, whose force depends on the time step."""

    def of_bodies(self, names: Sequence[str]) -> Sequence[Touch]:
        """Return the forces of all contacts on some bodies."""
        if self._seen is not self._world.snapshot:
            self._seen = self._world.snapshot
            found = [each for name in names if (each := self._bodies.of(name))]
            self.all = [touch for each in found for touch in self._on(each)]
            self.struck = any(each.struck for each in found)
        return self.all

    def _on(self, found: FreeBody) -> Iterator[Touch]:
        """Yield the contacts of a body, each from its normal force and the friction after it."""
        forces = not_negligible(found)
        for acting, after in zip(forces, (*forces[1:], None), strict=False):
            if acting.name != NORMAL or acting.by not in self._rows:  # a wire has one, too
                continue
            rubs = after is not None and (after.name, after.by) == (FRICTION, acting.by)
            friction = after.force if rubs and after else (0.0, 0.0)
            mu, slides = self._limit(found.body, acting.by, acting.magnitude, hypot(*friction))
            yield Touch(acting.at, acting.force, friction, mu, slides)

    def _limit(self, body: str, other: str, normal: float, friction: float) -> tuple[float, bool]:
        """Return the coefficient that limits a contact's friction, and whether it slides."""
        pair = self._rows[body], self._rows[other]
        mu = float(self._mu[pair])
        slides = abs(friction - mu * normal) <= ROUNDING * mu * normal
        stick = self._world.scene.sticking.get(frozenset(pair))
        return (stick.static if stick and not slides else mu), slides


_touches: WeakKeyDictionary[DrawingContext, Touches] = WeakKeyDictionary()


def _draw(surface: pygame.Surface, view: DrawingContext) -> None:
    if len(view.moving) > MANY:
        _draw_chains(surface, view)
        return
    touches = _touches.get(view)
    if touches is None:
        touches = _touches[view] = Touches(view.world)
    found = touches.of_bodies([outline.name for outline in view.moving])
    largest = max((hypot(*touch.force) for touch in found), default=0.0)
    full = view.full_length_value("contacts", 0.0 if touches.struck else largest) or largest
    if not full:
        return
    longest = LONGEST * view.camera.size[0]
    for touch in found:
        _draw_touch(surface, view, touch, longest / full, CUT * longest)
    _draw_key(surface, view, longest / full)


def _draw_touch(
    surface: pygame.Surface, view: DrawingContext, touch: Touch, scale: float, most: float
) -> None:
    """Draw the cone of a contact, its force, and a sign that tells whether it slides."""
    start, (x, y) = view.camera.to_screen(touch.at), touch.force
    size = hypot(x, y) * scale
    share = scale * min(1.0, most / size) if size else 0.0
    end = start[0] + x * share, start[1] - y * share
    if touch.mu and lines.are_close((start, end)):
        _draw_cone(surface, start, touch, share)
    color = _color(touch.slides)
    lines.arrow(surface, color, start, end, WIDTH)
    view.labels.mark(start, end)
    if lines.are_close((start,)):
        _sign(surface, touch.slides, start)


def _draw_cone(surface: pygame.Surface, start: XY, touch: Touch, scale: float) -> None:
    """Draw the sides of the friction cone as far as the normal force reaches."""
    reach = complex(touch.normal[0], -touch.normal[1]) * scale
    dim = theme.faded(_color(touch.slides), 0.6)
    sides = []
    for turn in (atan(touch.mu), -atan(touch.mu)):
        side = reach * complex(cos(turn), sin(turn)) / cos(turn)  # its end is level with the tip
        sides.append((start[0] + side.real, start[1] + side.imag))
        lines.stroke(surface, dim, start, sides[-1], 1)
    lines.dashed(surface, dim, sides, 3, 4)


def _draw_chains(surface: pygame.Surface, view: DrawingContext) -> None:
    """Draw a line for each contact between many bodies, as wide as its force is strong."""
    world, last = view.world, view.world.last
    contacts = last.contacts.without_first(last.impact_count)
    sizes = np.hypot(*contacts.impulse.T)
    full = view.full_length_value("chains", float(sizes[~contacts.first].max(initial=0.0)))
    if not full:
        return
    mu = pair_coefficients(world.level, world.values, "friction")[tuple(contacts.bodies.T)]
    limit = mu * contacts.normal
    _veil(surface)
    slides = np.abs(contacts.friction - limit) <= ROUNDING * limit
    ends = _ends(view, contacts.bodies, contacts.points[:, 0])
    for pair in np.argsort(sizes).tolist():
        width = WIDEST * min(sizes[pair] / full, 1.0)
        if width > WIDEST / 100:
            a, b = (view.camera.to_screen((float(x), float(y))) for x, y in ends[pair])
            lines.stroke(surface, _color(bool(slides[pair])), a, b, width)
    kick = last.parts[-1].kick / (2 if last.post_kick_velocity is None else 1)
    _draw_chain_key(surface, view, full / kick)


def _veil(surface: pygame.Surface) -> None:
    """Dim the bodies, so that the lines in them are seen."""
    veil = pygame.Surface(surface.size)
    veil.fill(theme.STAGE)
    veil.set_alpha(VEIL)
    surface.blit(veil, (0, 0))


def _ends(view: DrawingContext, bodies: Integers, points: Array) -> Array:
    """Return the ends of a line for each contact, the centre of a body or the point: (k, 2, 2)."""
    moves = view.world.scene.mass[bodies] > 0
    centers = view.world.snapshot.position[bodies]
    ends: Array = np.where(moves[..., None], centers, points[:, None])
    return ends


def _color(slides: bool) -> Color:
    return theme.ACTING[FRICTION if slides else NORMAL]


def _sign(surface: pygame.Surface, slides: bool, place: XY) -> None:
    """Draw a dot where a contact holds, a ring where it slides."""
    pygame.draw.aacircle(surface, _color(slides), place, SIGN, 2 if slides else 0)


def _draw_key(surface: pygame.Surface, view: DrawingContext, scale: float) -> None:
    """Draw the key to arrows at a scale [px/N]."""
    force = nice(KEY / scale)

    def sample(canvas: pygame.Surface, start: XY, _: XY, *, slides: bool) -> None:
        lines.arrow(canvas, _color(slides), start, (start[0] + force * scale, start[1]), WIDTH)
        _sign(canvas, slides, start)

    slides = say("slides: its force is on the edge of the friction cone")
    rows = (
        (partial(sample, slides=False), say("holds, {force:g} N", force=force)),
        (partial(sample, slides=True), slides),
    )
    overlay_legend.draw(surface, view, rows, "key of contacts")


def _draw_chain_key(surface: pygame.Surface, view: DrawingContext, full: float) -> None:
    """Draw the key to lines of which the widest has a force [N]."""

    def sample(canvas: pygame.Surface, start: XY, end: XY, *, slides: bool) -> None:
        lines.stroke(canvas, _color(slides), start, end, WIDEST if not slides else WIDEST / 2)

    rows = (
        (partial(sample, slides=False), say("holds, {force:g} N", force=full)),
        (partial(sample, slides=True), say("slides, {force:g} N", force=full / 2)),
    )
    overlay_legend.draw(surface, view, rows, "key of contacts")


OVERLAY = Overlay(
    name="contacts",
    key="6",
    text="forces at all contacts, and which of them slide",
    draw=_draw,
    caption="Contacts",
    on=lambda _level: False,
)
