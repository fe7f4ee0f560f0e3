"""The selected body, and the forces on it at the current step."""

from collections.abc import Mapping, Sequence
from itertools import cycle
from time import perf_counter
from typing import TYPE_CHECKING

from sandbox.app.drawing import theme
from sandbox.app.drawing.theme import Color
from sandbox.app.words.formatting import name_in_words, number, rounded_up
from sandbox.app.words.language import say
from sandbox.model.effects import EFFECTS
from sandbox.model.joints import KINDS
from sandbox.model.level import Level
from sandbox.model.shapes import XY
from sandbox.physics.measuring.free_body import (
    FRICTION,
    HAND,
    IMPACT,
    NORMAL,
    AppliedForce,
    FreeBody,
)
from sandbox.physics.measuring.free_body_forces import FreeBodies
from sandbox.physics.stepping.world import World

if TYPE_CHECKING:
    from sandbox.physics.state.snapshot import Snapshot

_NAMES = (
    *(NORMAL, FRICTION, IMPACT, HAND),
    *(effect.shown_force_name for effect in EFFECTS.values() if effect.is_force),
    *(kind.force_name for kind in KINDS.values()),
)

FAINT = 1e-9
"""A force below this fraction of the largest one counts as a rounding error."""


LITTLE = 0.1
"""If the largest force is below this fraction of the scale, the scale is reduced."""


HELD = 0.3
"""For this time the stage shows the numbers of a page, which is updated less often [s]."""


class SelectedBody:
    """The body that the user has selected, and the forces on it."""

    def __init__(self) -> None:
        self.chosen: str | None = None
        """The body that was clicked last; it may not exist in another level or at an earlier
        step."""
        self.seen_from: str | None = None
        """The place from which the user sees the scene, see `FrameOfReference`."""
        self._bodies: tuple[World, FreeBodies] | None = None
        self._seen: tuple[Snapshot, str, FreeBody | None] | None = None
        self._full: dict[str, float] = {}
        self._last_shown: tuple[World, FreeBody, float] | None = None

    def body(self, level: Level) -> str | None:
        """Return the selected body if it exists, else the first dynamic body, or None."""
        if self.chosen in level.bodies:
            return self.chosen
        return next((n for n, body in level.bodies.items() if body.type == "dynamic"), None)

    def select_next(self, level: Level) -> None:
        """Select the next dynamic body, in the order of the level; after the last, the first."""
        names = [name for name, body in level.bodies.items() if body.type == "dynamic"]
        if names:
            selected = self.body(level)
            self.chosen = (
                names[(names.index(selected) + 1) % len(names)] if selected in names else names[0]
            )

    def at(self, world: World) -> FreeBody | None:
        """Return the forces on the selected body; None if unknown, see `FreeBodies.of`."""
        body = self.body(world.level)
        if body is None:
            return None
        if self._bodies is None or self._bodies[0] is not world:
            self._bodies, self._seen, self._full = (world, FreeBodies(world)), None, {}
        snapshot, seen = world.snapshot, self._seen
        if seen is None or seen[0] is not snapshot or seen[1] != body:
            seen = self._seen = snapshot, body, self._bodies[1].of(body)
        return seen[2]

    def note_shown(self, world: World, found: FreeBody) -> None:
        """Record that a page shows these forces."""
        self._last_shown = world, found, perf_counter()

    def as_last_shown(self, world: World, found: FreeBody) -> FreeBody:
        """Return the forces as last shown by a page, if they are the same ones, else as found.

        Otherwise numbers on the stage would change in every frame, and differ from the page's.
        """
        if self._last_shown is None or self._last_shown[0] is not world:
            return found
        _, texts, at = self._last_shown
        same = texts.body == found.body and _whom(texts) == _whom(found)
        return texts if same and perf_counter() - at < HELD else found

    def force_of_longest_arrow(self, found: FreeBody) -> float:
        """Return the force that corresponds to the longest arrow on a body [N].

        It is a round number that stays until forces exceed it or become much smaller; impacts do
        not count.
        """
        now = 0.0 if found.struck else max(found.largest, *map(abs, found.mass_times_acceleration))
        full_force = self._full.get(found.body, 0.0)
        if now > full_force or 0 < now < full_force * LITTLE:
            self._full[found.body] = rounded_up(now)
        return self._full.get(found.body) or rounded_up(found.largest)


def _whom(found: FreeBody) -> Sequence[tuple[str, str]]:
    return [(acting.name, acting.by) for acting in not_negligible(found)]


def color(acting: AppliedForce) -> Color:
    """Return the colour of a force."""
    return colors().get(acting.name, theme.BODIES[0])


def colors() -> Mapping[str, Color]:
    """Return the colours of forces by name."""
    free = cycle(theme.BODIES)
    return {name: theme.ACTING.get(name) or next(free) for name in dict.fromkeys(_NAMES)}


def texts(found: FreeBody) -> Sequence[tuple[AppliedForce, str]]:
    """Return the forces on a body, each with the text beside its arrow, which is unique.

    The text is as short as possible: the name of the force; for several forces of the same name
    the body or joint that exerts each, together with the name if several names are ambiguous; and
    a number if that is still ambiguous.
    """
    forces = not_negligible(found)
    alike = [acting for acting in forces if _count(forces, acting) > 1]
    short = len({acting.name for acting in alike}) == 1 and all(acting.by for acting in alike)
    captions = [
        say(a.name) if a not in alike else _with_source(a) if short else _in_full(a) for a in forces
    ]
    sizes = [f"{newtons(acting.magnitude)} N" for acting in forces]
    return [*zip(forces, map(" ".join, zip(_numbered(captions), sizes, strict=True)), strict=True)]


def titles(found: FreeBody) -> Sequence[tuple[AppliedForce, str]]:
    """Return the forces on a body, each with its name and what exerts it."""
    forces = not_negligible(found)
    return [*zip(forces, _numbered([*map(_in_full, forces)]), strict=True)]


def _with_source(acting: AppliedForce) -> str:
    return say("from {giver}", giver=name_in_words(acting.by))


def _in_full(acting: AppliedForce) -> str:
    called = say(acting.name)
    return f"{called}, {name_in_words(acting.by)}" if acting.by else called


def _count(forces: Sequence[AppliedForce], acting: AppliedForce) -> int:
    return sum(other.name == acting.name for other in forces)


def _numbered(names: Sequence[str]) -> Sequence[str]:
    """Return the names, with a number after equal ones."""
    return [
        name if names.count(name) == 1 else f"{name} ({names[: place + 1].count(name)})"
        for place, name in enumerate(names)
    ]


def not_negligible(found: FreeBody) -> Sequence[AppliedForce]:
    """Return the forces on a body, without those negligible compared with the largest."""
    return [acting for acting in found.forces if acting.magnitude > FAINT * found.largest]


def without_rounding(vector: XY, found: FreeBody) -> XY:
    """Return a sum of forces, with 0 for components that are only rounding errors."""
    x, y = (0.0 if abs(part) < FAINT * found.largest else part for part in vector)
    return x, y


def newtons(value: float) -> str:
    """Format a force with three digits, or more from 1e3 on to avoid a power of ten."""
    return number(value, 5 if abs(value) >= 1e4 else 4 if abs(value) >= 1e3 else 3)
