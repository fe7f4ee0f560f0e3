"""The tool that makes joints of any kind."""

from collections.abc import Mapping, Sequence
from functools import partial
from math import dist
from typing import NamedTuple, get_args

import pygame

from sandbox.app.building import shape_preview
from sandbox.app.building.edited_level import EditedLevel
from sandbox.app.building.mouse_position import MousePosition
from sandbox.app.building.tools.tool import Tool
from sandbox.app.drawing.text import Pen
from sandbox.app.words.formatting import name_in_words
from sandbox.app.words.language import later, say
from sandbox.editing.edits import joint_creation
from sandbox.editing.edits.edit_result import EditResult
from sandbox.editing.edits.joint_creation import Pick
from sandbox.editing.foreseen_faults import Proposed
from sandbox.model.joints import KINDS, Joint

ON = 6.0  # px, the largest distance at which a click is on a body
TOGETHER = 8.0  # px, the largest distance of two clicks that finish a joint of several points


class Clicks(NamedTuple):
    """The clicks for a joint, in order; if `several`, the last can be repeated."""

    hints: tuple[str, ...]
    several: bool = False


PLAIN = Clicks((later("Click one end of it"), later("Click its other end")))

CLICKS: Mapping[str, Clicks] = {
    "pulley": Clicks(
        (
            later("Click what hangs at one end of the string"),
            later("Click the first peg that it runs over"),
            later(
                "Click another peg, or what hangs at the other end; Shift: a body is a peg, too; "
                "Enter ends it at a fixed point"
            ),
        ),
        several=True,
    ),
    "pivot": Clicks((later("Click where the pin goes, through one body or through two"),)),
    "motor": Clicks((later("Click where the driven pin goes, through one body or through two"),)),
    "rail": Clicks((later("Click what runs on the rail"), later("Click where the rail leads"))),
    "winding": Clicks(
        (
            later("Click what is tied to the string"),
            later("Click the wheel, on the side on which the string leaves it"),
        )
    ),
    "wire": Clicks((later("Click the bead"), later("Click a point that its wire goes through"))),
}
"""The clicks for joints that do not simply connect two ends."""


class JoinTool(Tool):
    """Makes a joint from clicks on the stage."""

    def __init__(self, bench: EditedLevel, kind: str = "pivot") -> None:
        super().__init__(bench)
        self.kind = kind
        """The kind of joint, as in a level's file."""
        self._picks: list[Pick] = []
        self._spot: MousePosition | None = None

    def use(self, kind: str) -> None:
        """Change the kind of joint."""
        self.kind = kind
        self._picks.clear()

    @property
    def _clicks(self) -> Clicks:
        return CLICKS.get(self.kind, PLAIN)

    @property
    def busy(self) -> bool:
        """Whether a point is set."""
        return bool(self._picks)

    @property
    def hint(self) -> str:
        """A hint at what to do next."""
        hints = self._clicks.hints
        return hints[min(len(self._picks), len(hints) - 1)]

    def press(self, mouse: MousePosition) -> None:
        """Set the next point, and make the joint with the last."""
        if self._clicks.several and self._is_double_click(mouse):
            self.finish()
            return
        self._picks = self._picks_with(mouse)
        if self._complete(self._picks, mouse):
            self._make()

    @property
    def proposed(self) -> Proposed[EditResult] | None:
        """The edit that a click here would make; None if there is nothing here to be joined."""
        if self._spot is None or (self._clicks.several and self._is_double_click(self._spot)):
            return None
        places = self._picks_with(self._spot)
        makes = self._complete(places, self._spot) and any(place.body for place in places)
        return self._edit(places) if makes else None

    def _edit(self, places: Sequence[Pick]) -> Proposed[EditResult]:
        """Return the edit that makes the joint."""
        edit = partial(joint_creation.add_joint, kind=self.kind, chosen=tuple(places))
        return Proposed(edit, {place.body for place in places if place.body})

    def _picks_with(self, mouse: MousePosition) -> list[Pick]:
        """Return the points, with the one that a click here would add."""
        found = self._bodies_at(mouse)
        if len(self._clicks.hints) == 1:
            return [Pick(mouse.point, body) for body in (*found, None, None)[:2]]
        return [*self._picks, Pick(mouse.point, found[0] if found else None)]

    def _complete(self, places: Sequence[Pick], mouse: MousePosition) -> bool:
        """Return whether the last point, clicked here, makes the joint."""
        ends = not self._clicks.several or (places[-1].body is not None and not mouse.shift)
        return ends and len(places) >= max(2, len(self._clicks.hints))

    def _bodies_at(self, mouse: MousePosition) -> list[str]:
        """Return the moving bodies at a point, the topmost first."""
        sketch, reach = self._bench.sketch, ON / self._bench.camera.scale
        return [
            name
            for name, body in reversed(list(sketch.bodies.items()))
            if body.outline.moves and body.covers(mouse.point, reach)
        ]

    def _is_double_click(self, mouse: MousePosition) -> bool:
        """Return whether a click is the second of a double click."""
        if len(self._picks) < len(self._clicks.hints):
            return False
        last = self._bench.camera.to_screen(self._picks[-1].point)
        return dist(last, self._bench.camera.to_screen(mouse.point)) < TOGETHER

    def move(self, mouse: MousePosition) -> None:
        """Move the end of the preview."""
        self._spot = mouse

    def finish(self) -> None:
        """Make the joint, if it has enough points."""
        if self._clicks.several and len(self._picks) >= len(self._clicks.hints):
            self._make()

    def _make(self) -> None:
        picks = tuple(self._picks)
        self._picks.clear()
        self._spot = None  # nothing is proposed on top of this joint until the mouse moves
        first, second = (
            name_in_words(pick.body) if pick.body else say("the plane")
            for pick in (picks[0], picks[-1])
        )
        self._bench.show_message(say("Tied: {first} to {second}", first=first, second=second))
        effects = self._bench.level.effects
        if self.kind == "motor" and effects.contact and effects.friction is None:
            self._bench.show_message(
                say("Without the effect 'friction', a wheel that it drives slips")
            )
        caption = say("tie a {joint}", joint=say(self.kind))
        self._bench.add_parts(caption, self._edit(picks).edit, "joints")

    def cancel(self) -> None:
        """Remove the last point."""
        if self._picks:
            self._picks.pop()

    def draw(self, surface: pygame.Surface, pen: Pen) -> None:
        """Draw the points, and the line to the mouse with its length."""
        if not self._picks or self._spot is None:
            return
        camera, end = self._bench.camera, self._spot.point
        points = [place.point for place in self._picks]
        shape_preview.outline(surface, camera, [*points, end])
        shape_preview.mark_points(surface, camera, points)
        shape_preview.write_measure(
            surface, pen, self._spot.pixel, shape_preview.metres(dist(points[-1], end))
        )


def kinds() -> Mapping[str, str]:
    """Return all kinds of joints, as in a level's file, with their descriptions."""
    models = get_args(get_args(Joint)[0])
    return {
        name: " ".join((model.__doc__ or "").split("\n\n")[0].split())
        for name, model in zip(KINDS, models, strict=True)
    }
