"""The faults that an edit would bring, found before it is made.

While something is drawn, the edit is made again and again on the part of the level that it
concerns: the bodies in hand, what is joined to them, and the bodies that they come near. So it
takes the same time in a level of five hundred bodies as in one of five.
"""

import json
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import cached_property
from itertools import count
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np

from sandbox.editing.bodies_at_start import PlacedBody, placed
from sandbox.editing.cleanup_after_edit import without_meaning
from sandbox.editing.edits.edit_result import EditResult
from sandbox.model.body import Body
from sandbox.model.comments import read_level
from sandbox.model.effects import Effects
from sandbox.model.effects.contact import Contact
from sandbox.model.errors import LevelError, SandboxError
from sandbox.model.expressions import Array
from sandbox.model.joints import bodies_of
from sandbox.model.level import Level
from sandbox.physics.advising.start_faults import Fault, start_faults

MOST = 60
"""The most bodies that are looked at; beyond, faults are found once the edit is made."""

Text = TypeVar("Text", bound=str | EditResult, covariant=True)


class Proposed(NamedTuple, Generic[Text]):
    """An edit that was not made yet."""

    edit: Callable[[str, Level], Text]
    names: Collection[str] = ()
    """The existing bodies that it changes or joins."""


class ForeseenFaults(NamedTuple):
    """The faults of an edit that was not made."""

    faults: Sequence[Fault]
    changed: Level | None = None
    """The bodies and joints that it concerns, as they would be; None if it is refused itself."""


class Foresight:
    """Looks ahead at edits of one state of a level.

    `document` is the data of the level's text, with repetitions and groups written out.
    """

    def __init__(self, document: Mapping[str, Any], level: Level) -> None:
        self._document, self._level = document, level
        self._parts: dict[frozenset[str], str] = {}

    def of(self, proposed: Proposed[str | EditResult]) -> ForeseenFaults | None:
        """Return the faults that an edit would bring; None if it concerns too many bodies."""
        names = self._joined(proposed.names)
        if names is None:
            return None
        part = self._part(names)
        try:
            made = proposed.edit(part, self._level)
            text = made.text if isinstance(made, EditResult) else made
            level = read_level(text)
        except LevelError as error:
            return ForeseenFaults([Fault(error.mistakes[0].rule, frozenset())])
        except SandboxError as error:
            return ForeseenFaults([Fault(error.message, frozenset())])
        before, after = json.loads(part)["bodies"], json.loads(text)
        changed = {name for name, body in after["bodies"].items() if before.get(name) != body}
        near = self._near(level, changed)
        if len(near) > MOST:
            return None
        concerned = changed | level.joints.keys()
        faults = [f for f in start_faults(self._among(level, near)) if f.names & concerned]
        return ForeseenFaults(faults, level)

    def _joined(self, names: Collection[str]) -> frozenset[str] | None:
        """Return bodies with those that are joined to them, the nearest first, as far as possible.

        Joints that repeat each other among these do so among all. None if even the bodies' own
        partners are too many.
        """
        found, layer = frozenset[str](), frozenset(names)
        for depth in count():
            if not layer or len(found) + len(layer) > MOST:
                return found if depth > 1 or not layer else None
            found |= layer
            layer = frozenset().union(*(self._partners.get(one, ()) for one in layer)) - found
        return None

    @cached_property
    def _partners(self) -> Mapping[str, set[str]]:
        """The bodies to which each body is joined."""
        partners: dict[str, set[str]] = {}
        for joint in self._level.joints.values():
            joined = set(bodies_of(joint))
            for body in joined:
                partners.setdefault(body, set()).update(joined)
        return partners

    def _part(self, names: frozenset[str]) -> str:
        """Return the text of a level with some bodies only, and the joints among them."""
        if names not in self._parts:
            document, level = self._document, self._level
            bodies = [name for name in level.bodies if name in names] or list(level.bodies)[:1]
            joints = [n for n, joint in level.joints.items() if {*bodies_of(joint)} <= names]
            part = {
                "format": 1,
                "title": "part",
                "parameters": document.get("parameters", {}),
                "constants": document.get("constants", {}),
                "effects": document.get("effects", {}),
                "bodies": {name: document["bodies"][name] for name in bodies},
                "joints": {name: document["joints"][name] for name in joints},
            }
            self._parts[names] = without_meaning(json.dumps(part))
        return self._parts[names]

    @cached_property
    def _boxes(self) -> tuple[list[str], Array]:
        """The bodies, and their bounding boxes (n, 4) [m]."""
        return list(self._level.bodies), np.array(
            [_box(one) for one in placed(self._level).values()]
        )

    def _near(self, level: Level, names: Collection[str]) -> list[str]:
        """Return the bodies whose bounding box meets one of those of new or changed bodies."""
        all_names, boxes = self._boxes
        values, meets = level.defaults, np.zeros(len(all_names), dtype=bool)
        for name in names:
            left, low, right, high = _box(PlacedBody(name, level.bodies[name], values))
            across = (boxes[:, 0] <= right) & (boxes[:, 2] >= left)
            meets |= across & (boxes[:, 1] <= high) & (boxes[:, 3] >= low)
        return [all_names[row] for row in np.flatnonzero(meets)]

    def _among(self, changed: Level, near: Collection[str]) -> Level:
        """Return the level of the changed bodies among those near them."""
        bodies = {name: self._level.bodies[name] for name in near} | dict(changed.bodies)
        contact = _apart(self._level.effects.contact, changed.effects.contact, bodies)
        effects = Effects.model_construct(contact=contact, rotation=changed.effects.rotation)
        parts = {"bodies": bodies, "joints": changed.joints, "effects": effects, "events": {}}
        return self._level.model_copy(update=parts)


def _box(one: PlacedBody) -> tuple[float, float, float, float]:
    low, high = one.bounds
    return low.real, low.imag, high.real, high.imag


def _apart(
    before: Contact | None, after: Contact | None, bodies: Mapping[str, Body]
) -> Contact | None:
    """Return the contacts among some bodies after an edit.

    A part with a single body has lost its contacts, which the edit leaves as they were.
    """
    contact = before or after
    if contact is None:
        return None
    groups = (*contact.apart, *(after.apart if after else ()))
    among = [tuple(name for name in group if name in bodies) for group in groups]
    return contact.model_copy(update={"apart": tuple(filter(None, among)), "located": None})
