"""The layout of a step's rows: of joints, gaps and slips, grouped into islands."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.translatable_message import Message
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import (
    NO_FRICTION,
    Friction,
    Problem,
    SystemTooLarge,
)
from sandbox.physics.contacts.direct.complementarity.islands import islands
from sandbox.physics.contacts.direct.rows.contact_outlines import Figures
from sandbox.physics.contacts.direct.rows.contact_points import ContactPoints
from sandbox.physics.engine.space_arrays import Booleans, Contacts, Integers
from sandbox.physics.joints.exact.shake import ExactJoints

MOST_ROWS = 1500
"""The most rows of an island that is solved directly: its dense system takes a fifth of a second.
Several islands count by the sum of the cubes of their rows."""


class Surfaces(NamedTuple):
    """The contact properties of n bodies.

    `figures` are their outlines, and `friction`, `static` and `restitution`, (n, n), the
    coefficients of the pairs; `running`, (n, 2), are the velocities of running surfaces, such as
    belts [m/s]. `correction` is the share of an overlap that a step removes, and `slop` the overlap
    that is left alone [m]. `lands`, (n, n), tells which pairs land where they meet within a drift,
    and wait for nothing else; `in_sequence`, whether impacts at the same time come one after the
    other.
    """

    figures: Figures
    friction: Array
    static: Array
    restitution: Array
    running: Array
    correction: float
    slop: float
    lands: Booleans
    in_sequence: bool = False


class Island(NamedTuple):
    """A group of rows that affect each other, and no others.

    `rows` and `slips` are the indices of its rows among all rows, and of its friction among all
    friction. `problem` has the kinds of its rows, with indices within the island.
    """

    rows: Integers
    slips: Integers
    problem: Problem

    def asking(self, problem: Problem) -> "Island":
        """Return it with the kinds of all rows, and the same friction."""
        free, pushes = problem.free.take(self.rows), problem.pushes.take(self.rows)
        return self._replace(problem=self.problem._replace(free=free, pushes=pushes))


@dataclass(frozen=True)
class Layout:
    """The rows of a step: m of joints, k of gaps, f of slips, in this order.

    `problem` has their kinds, and `islands` the same, island by island; `touching` has the points
    of the gaps and slips. `restitution`, (k,), are the coefficients of the gaps, and `in_sequence`
    tells whether their impacts come one after the other. `joints`, `gaps`, `slips` and `touch` are
    their indices among all rows; `touch` is gaps and slips together. `joined` are the gaps between
    bodies that also share a joint, and `ties` the rows of such joints.
    """

    problem: Problem
    islands: list[Island]
    touching: ContactPoints
    restitution: Array
    joints: slice
    gaps: slice
    slips: slice
    joined: Integers
    ties: Integers
    in_sequence: bool

    @property
    def touch(self) -> slice:
        """The indices of gaps and slips among all rows."""
        return slice(self.gaps.start, None)

    def asking(self, problem: Problem) -> "Layout":
        """Return the same rows with other kinds, or without friction."""
        if problem.friction is self.problem.friction:
            parts = [one.asking(problem) for one in self.islands]
        else:
            parts = [_part(problem, one.rows, one.slips[:0]) for one in self.islands]
        return replace(self, problem=problem, islands=parts)

    def rubbing(self, slips: Array) -> "Layout":
        """Return the same rows with other coefficients of kinetic friction: (f,)."""
        friction = replace(self.problem.friction, kinetic=slips)
        problem = self.problem._replace(friction=friction)
        parts = [_part(problem, one.rows, one.slips) for one in self.islands]
        return replace(self, problem=problem, islands=parts)

    @cached_property
    def tied(self) -> Integers:
        """The rows of the gaps between bodies that share a joint, and of such joints."""
        return np.concatenate((self.joined + self.gaps.start, self.ties))

    @cached_property
    def hangs_together(self) -> bool:
        """Whether all rows take part in one island, of more than the row of a joint."""
        if len(self.islands) != 1 or _is_alone(self.islands[0]):
            return False
        rows, slips, _ = self.islands[0]
        return len(rows) == len(self.problem.free) and len(slips) == len(
            self.touching.friction_points
        )

    @cached_property
    def alone(self) -> Integers:
        """The rows of joints that affect no other rows."""
        lone = [one.rows[0] for one in self.islands if _is_alone(one)]
        return np.array(lone, dtype=np.intp)

    @cached_property
    def together(self) -> list[Island]:
        """All other islands."""
        return [one for one in self.islands if not _is_alone(one)]

    def at_ends(self, ends: Booleans) -> "Layout":
        """Return the same rows, where the last contacts, (2, c), touch with ends of sides."""
        first = int(self.touching.pair.max()) + 1 - ends.shape[1]
        known = np.concatenate((np.zeros((2, first), dtype=bool), ends), axis=1)
        touching = self.touching._replace(ends=known[:, self.touching.pair])
        return replace(self, touching=touching)

    def around(self, some: Booleans) -> "Layout":
        """Return the same rows with only the islands that contain some of them, (r,)."""
        found = [one for one in self.islands if np.count_nonzero(some.take(one.rows))]
        return self if len(found) == len(self.islands) else replace(self, islands=found)

    @cached_property
    def smooth(self) -> "Layout":
        """Return the same rows without friction: its rows take no part."""
        return self.asking(self.problem._replace(friction=NO_FRICTION))


def lay_out(
    contacts: Contacts, joints: ExactJoints, surfaces: Surfaces, movable: Booleans
) -> Layout:
    """Return the rows of joints and contacts; the two points of a side share one row of friction.

    `movable`, (n,), tells which bodies are dynamic. Raises `SystemTooLarge` if there are more rows
    than a step can solve.
    """
    first, count = len(joints.pulls_only), len(contacts.bodies)
    slips, static = (table[tuple(contacts.bodies.T)] for table in surfaces[1:3])
    touching = ContactPoints.between(
        contacts, (slips > 0) | (static > 0), surfaces.figures, movable
    )
    pair, rubs, (a, b) = touching.pair, touching.friction_points, touching.bodies
    contact = _points_of(rubs, pair[count:], count)
    contact = np.where(contact >= 0, contact + first, -1)
    gaps = slice(first, first + len(pair))
    whole = gaps.stop + len(rubs)
    free, pushes = np.zeros(whole, dtype=bool), np.zeros(whole, dtype=bool)
    free[:first], pushes[:first] = ~joints.pulls_only, joints.pulls_only
    pushes[gaps] = True
    row = np.arange(gaps.stop, whole)
    friction = Friction(row, contact, static[rubs], slips[rubs])
    touch = contacts.bodies[pair]
    found = islands([*joints.bodies, *touch, *touch[rubs]], movable)
    problem = Problem(free, pushes, friction, _alike(joints.alike, whole))
    parts = [_part(problem, rows, rows[rows >= gaps.stop] - gaps.stop) for rows in found]
    _refuse_large(parts, touching)
    return Layout(
        problem,
        parts,
        touching,
        surfaces.restitution[a, b],
        slice(first),
        gaps,
        slice(gaps.stop, whole),
        *_joined(touch.tolist(), joints, movable),
        surfaces.in_sequence,
    )


class Layouts:
    """Lays out the rows of a step; reuses the last layout while the same bodies touch.

    For the arguments see `lay_out`.
    """

    def __init__(self, joints: ExactJoints, surfaces: Surfaces, movable: Booleans) -> None:
        self._joints, self._surfaces, self._movable = joints, surfaces, movable
        self._last: tuple[Contacts, int, Layout] | None = None

    def forget(self) -> None:
        """Forget the last layout: the joints have changed."""
        self._last = None

    def of(self, contacts: Contacts) -> Layout:
        """Return the layout for some contacts, and remember it."""
        count, last = len(self._joints.added), self._last
        same = last is not None and last[1] == count and _alike_in(last[0], contacts)
        layout = last[2] if last and same else self.new_layout(contacts)
        self._last = contacts, count, layout
        return layout

    def new_layout(self, contacts: Contacts) -> Layout:
        """Return the layout for some contacts without remembering it."""
        return lay_out(contacts, self._joints, self._surfaces, self._movable)


def _alike_in(one: Contacts, other: Contacts) -> bool:
    """Return whether the same bodies touch, with as many points."""
    return _equal(one.bodies, other.bodies) and _equal(one.touches, other.touches)


def _equal(one: Integers, other: Integers) -> bool:
    return one is other or np.array_equal(one, other)


def _joined(
    touch: Sequence[Sequence[int]], joints: ExactJoints, movable: Booleans
) -> tuple[Integers, Integers]:
    """Return the pairs of touching bodies that share a joint, and the rows of such joints."""
    still = {-1, len(movable), *np.flatnonzero(~movable).tolist()}  # with the plane
    pairs = [frozenset(pair) - still for pair in touch]
    bodies_of_joint = [frozenset(bodies.tolist()) - still for bodies in joints.bodies]
    rows = [
        row for row in np.flatnonzero(~joints.pulls_only).tolist() if bodies_of_joint[row] in pairs
    ]
    tied = {bodies_of_joint[row] for row in rows}
    gaps = [gap for gap, pair in enumerate(pairs) if pair in tied]
    return np.array(gaps, dtype=np.intp), np.array(rows, dtype=np.intp)


def _points_of(rubs: Integers, seconds: Integers, count: int) -> Integers:
    """Return the gaps of each contact with friction: (2, r), −1 for a missing second point.

    `rubs`, (r,), are the contacts with friction, and `seconds` those with a second point, in the
    order of these points; `count` is the number of contacts.
    """
    partner = np.full(count, -1)
    partner[seconds] = count + np.arange(len(seconds))
    return np.stack((rubs, partner[rubs]))


def _refuse_large(parts: Sequence[Island], touching: ContactPoints) -> None:
    """Raise `SystemTooLarge` if an island has more rows than a step can solve."""
    if sum(len(part.rows) ** 3 for part in parts) <= MOST_ROWS**3:
        return
    body = int(np.bincount(touching.bodies[touching.bodies >= 0]).argmax())
    limit = max(len(part.rows) for part in parts)
    reason = Message(
        "{count:,} constraints of contacts and joints are coupled, but at most {most:,} can be"
        " solved directly: let fewer bodies touch, or leave out the 'solver' \"direct\"",
        count=limit,
        most=MOST_ROWS,
    )
    raise SystemTooLarge(body, reason)


def _alike(joints: Integers, whole: int) -> Integers | None:
    """Return which rows are scaled alike: those of each joint; None if each joint has one row."""
    if len(set(joints.tolist())) == len(joints):
        return None
    return np.concatenate((joints, np.arange(len(joints), whole)))


def _is_alone(island: Island) -> bool:
    return len(island.rows) == 1 and bool(island.problem.free[0])


def _part(problem: Problem, rows: Integers, slips: Integers) -> Island:
    """Return the island of some rows, with indices of its own."""
    if len(rows) == len(problem.free):
        return Island(rows, slips, problem)
    number = np.full(len(problem.free) + 1, -1)
    number[rows] = np.arange(len(rows))
    old = problem.friction
    friction = Friction(
        number[old.row[slips]],
        number[old.contact[:, slips]],
        old.static[slips],
        old.kinetic[slips],
    )
    alike = None if problem.alike is None else problem.alike[rows]
    part = Problem(problem.free[rows], problem.pushes[rows], friction, alike)
    return Island(rows, slips, part)
