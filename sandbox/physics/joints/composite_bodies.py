"""Composites: bodies that are welded by the level, or stick at their first contact."""

from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
import pymunk

from sandbox.physics.engine.space_arrays import Contacts, Integers

if TYPE_CHECKING:
    from sandbox.model.shapes import XY


class Solids:
    """Groups bodies into solids, whose parts do not collide with each other."""

    pairs: Integers
    """(k, 2), the indices of the bodies that were joined."""

    def __init__(self, bodies: Mapping[str, pymunk.Body]) -> None:
        self._bodies = bodies
        self._numbers = {name: number for number, name in enumerate(bodies, 1)}
        self._by: list[tuple[str, str, str]] = []
        self._begin()

    def _begin(self) -> None:
        """Make every body a solid of its own."""
        self.pairs = np.empty((0, 2), dtype=np.intp)
        self._parts = {name: {name} for name in self._bodies}

    def part(self, joint: str) -> None:
        """Undo what a joint has joined, unless another joint joins it too."""
        if not any(joint == by for _, _, by in self._by):
            return
        joined, self._by = [entry for entry in self._by if entry[2] != joint], []
        for name in {name for parts in self._parts.values() if len(parts) > 1 for name in parts}:
            for shape in self._bodies[name].shapes:
                shape.filter = shape.filter._replace(group=0)
        self._begin()
        for a, b, by in joined:
            self.join(a, b, by)

    def join(self, a: str, b: str, by: str = "") -> bool:
        """Join two bodies into one solid, by a joint, and return whether they were separate."""
        self._by.append((a, b, by))
        if b in self._parts[a]:
            return False
        joined = self._numbers[a] - 1, self._numbers[b] - 1
        self.pairs = np.concatenate((self.pairs, np.array([joined], dtype=np.intp)))
        parts = self._parts[a] | self._parts[b]
        group = self._numbers[a]
        for name in parts:
            self._parts[name] = parts
            for shape in self._bodies[name].shapes:
                shape.filter = shape.filter._replace(group=group)
        return True


class Touches:
    """Watches pairs of bodies for their first contact, and keeps pymunk from solving its impact.

    The collision type of each body is the index of its name, from 1.
    """

    def __init__(
        self, space: pymunk.Space, names: Sequence[str], pairs: Sequence[tuple[str, str]]
    ) -> None:
        self._index = {name: i for i, name in enumerate(names)}
        self._met: dict[tuple[str, str], tuple[XY, XY]] = {}
        self._latest: dict[tuple[str, str], tuple[XY, XY]] = {}
        for pair in pairs:
            a, b = (self._index[name] + 1 for name in pair)
            space.on_collision(a, b, begin=partial(self._begin, pair))

    def _begin(
        self, pair: tuple[str, str], arbiter: pymunk.Arbiter, _space: pymunk.Space, _data: object
    ) -> None:
        arbiter.process_collision = False
        contact = arbiter.contact_point_set
        self._met[pair] = contact.normal, contact.points[0].point_a

    @property
    def latest(self) -> Iterable[tuple[str, str]]:
        """The pairs that met in the last step."""
        return self._latest

    def end_step(self) -> None:
        """Make the pairs that have met since the last call the latest ones."""
        self._latest, self._met = self._met, {}

    def with_latest(self, contacts: Contacts) -> Contacts:
        """Return the contacts of a step with those of the pairs that met in it, without forces."""
        if not self._latest:
            return contacts
        bodies = [[self._index[name] for name in pair] for pair in self._latest]
        normals, points = zip(*self._latest.values(), strict=True)
        none = np.zeros(len(bodies))
        new_points = np.full((len(bodies), 2, 2), np.nan)
        new_points[:, 0] = points
        return Contacts(
            np.concatenate((contacts.bodies, np.array(bodies, dtype=np.intp))),
            np.append(contacts.first, np.full(len(bodies), fill_value=True)),
            np.concatenate((contacts.direction, normals)),
            np.append(contacts.normal, none),
            np.append(contacts.friction, none),
            np.append(contacts.touches, np.ones(len(bodies), dtype=np.intp)),
            np.concatenate((contacts.points, new_points)),
            np.append(contacts.impulse, np.zeros((len(bodies), 2)), axis=0),
            np.append(contacts.depths, np.zeros((len(bodies), 2)), axis=0),
        )
