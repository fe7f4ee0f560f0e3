"""Drifts in which bodies land: each landing is located, and is an impact at its own time.

Between two kicks leapfrog stands for a motion with the accelerations of the last kick: a parabola.
Where bodies meet on it, the drift is cut. The kick before it is solved again for a drift that ends
there. Then comes an impact, all at once with the joints and contacts that take part in it, and then
another drift, in which what has met touches, or is on its way back. Thus nothing is stopped before
it has come down, or lifted out of what it has come down on. A corner that comes down beside another
that touches already lands in the same way, if it does so faster than what acts in a step makes it.

A drift is also cut where a contact passes the end of a side: a disc that rolls off a table falls
from there, and not from where the step ends; see `support_ends`. Nothing is struck there, but other
contacts act from there on.

Bodies that take no part in a landing go on as they were.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct import impacts
from sandbox.physics.contacts.direct.closing_gaps import closed
from sandbox.physics.contacts.direct.constraint_impulses import hold
from sandbox.physics.contacts.direct.constraint_rows import Active
from sandbox.physics.contacts.direct.convex_parts import Pair
from sandbox.physics.contacts.direct.drift_meetings import SOON, Meetings, Met, goes_on
from sandbox.physics.contacts.direct.drift_parts import Part, around, concerned
from sandbox.physics.contacts.direct.kick_builder import KickBuilder
from sandbox.physics.contacts.direct.kick_parts import Stage
from sandbox.physics.contacts.direct.kick_system import Kick
from sandbox.physics.contacts.direct.landing_record import LandingRecord
from sandbox.physics.contacts.direct.landing_times import until_first
from sandbox.physics.contacts.direct.speculative_contacts import (
    LOOKS,
    SpeculativeContacts,
)
from sandbox.physics.contacts.direct.warm_start import recalled
from sandbox.physics.engine.batch import Booleans
from sandbox.physics.joints.exact.constraints import order
from sandbox.physics.state.errors import JointFailure, NoForces

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.passing_contacts import Passing

SHORT = 0.1
"""The share of a drift below which the forces of its last part are solved for a whole one: those of
a short part follow from small differences of positions, and their rounding is traced far back."""

MOST = 8
"""The most landings of one drift that are located. What would land later comes to touch in it, and
its impact is at its end."""

AGAIN = 4
"""The most times that a drift is followed anew, since more bodies take part in its landings."""


class _Late(Exception):  # noqa: N818 (no error: the drift is followed once more)
    """Somebody takes part in a landing who should have been followed from the first one on."""


class Landings:
    """Cuts a drift where bodies land in it; N bodies with the plane.

    Parameters
    ----------
    speculative
        Finds the landings.
    build
        Builds the systems of kicks.
    laws
        (3 N,), the accelerations by gravity and force laws [m/s², rad/s²].
    until
        The time at the end of the drift [s].
    driven
        Whether running surfaces or kinematic bodies may add energy.

    Attributes
    ----------
    reached
        (n,), which bodies take part in landings.
    record
        What collided in them, and how hard.
    """

    def __init__(
        self,
        speculative: SpeculativeContacts,
        build: KickBuilder,
        laws: Array,
        until: float,
        *,
        driven: bool,
    ) -> None:
        self._speculative, self._build = speculative, build
        self._laws, self._until, self._driven = laws, until, driven
        self._meetings = Meetings(speculative, laws)
        count = len(laws) // 3 - 1
        self._order, self._anew = order(count), True
        self._whole: Part  # the drift
        self._begin(np.zeros(count, dtype=bool))

    def follow(self, whole: Part) -> list[Part]:
        """Return the parts of the drift after a kick: the drift itself if nothing lands.

        Whoever takes part in a later landing has to be followed from the first one on, where other
        bodies press on it. So then the drift is followed once more from its start.
        """
        joints, kick, self._whole = whole.kick.joints, whole.kick.joints.kick, whole
        try:
            for _ in range(AGAIN):
                with suppress(_Late):
                    return self._parts(whole)
                self._begin(self.reached | around(whole.kick, self._near))
            self._anew = False
            return self._parts(whole)
        finally:
            joints.time(kick, whole.drift)

    def _begin(self, reached: Booleans) -> None:
        """Begin a drift in whose landings some bodies, (n,), are known to take part."""
        self.reached = reached
        self._early: Booleans | None = None  # who takes part from the first landing on
        self._near: list[Pair] = []  # who might take part
        self._carried: list[Passing] = []  # those at the ends of curves that go on
        self.record = LandingRecord(len(reached))

    def _take_in(self, bodies: Booleans) -> None:
        """Note who takes part: (n,).

        Raises `_Late` if some press on others, but did not take part from the first landing on.
        """
        self.reached = self.reached | bodies
        if self._early is not None and self._anew:
            late, whole = self.reached & ~self._early, self._whole
            if np.count_nonzero(whole.forces[concerned(whole.kick, late)]):
                raise _Late

    def _parts(self, whole: Part) -> list[Part]:
        """Return the parts of a drift."""
        parts = [whole]
        while len(parts) <= MOST and (found := self._cut(parts[-1])):
            parts[-1:] = found
        if len(parts) > MOST:
            parts[-1] = self._stopped(parts[-1])
        elif len(parts) > 1:
            parts[-1] = self._lasting(parts[-1], whole.drift)
        return parts

    def _stopped(self, part: Part) -> Part:
        """Return a part in which what would still land comes to touch, and goes no further."""
        part.kick.joints.time(part.drift, part.drift)
        for _ in range(LOOKS):
            part = self._closed(part, locates=False)
            ahead = self._speculative.meeting(part.kick, part.moved)
            if not len(ahead.bodies):
                break
            more = self._build.with_ahead(part.kick, ahead)
            self._take_in(around(more, ahead.bodies.tolist()))
            try:
                part = self._again(part, more)
            except (JointFailure, NoForces):
                break  # at the end of the drift it will be found as an overlap
        return part.closing if part.kick.closes else part

    def _lasting(self, last: Part, drift: float) -> Part:
        """Return the last part with forces that last for a whole drift [s].

        They stay its own if other rows would be active then.
        """
        if last.drift >= SHORT * drift:
            return last
        try:
            longer = self._solved(last, drift, drift / 2)
        except (JointFailure, NoForces):
            return last
        same = longer.active.equals(last.active)
        return last._replace(lasting=longer.forces) if same else last

    def _cut(self, part: Part) -> tuple[Part, Part] | None:
        """Return a part up to its first landing, and the rest of it; None if nothing lands."""
        kick, known = part.kick, (self.reached, self._early)
        kick.joints.time(part.drift, part.drift)
        ahead = self._meetings.ahead(part, self._carried)
        self._near += ahead.pairs
        met = self._meetings.first(part, part.drift, ahead) if any(ahead) else None
        if met is None:
            return None
        self._take_in(around(kick, met.pairs))
        self._early = self.reached if self._early is None else self._early
        try:
            shorter, met = until_first(part, met, self._meetings, self._shortened)
            left = part.drift - shorter.drift
            if met.passing:
                after = self._pass(shorter, left, met, ahead.pairs)
            else:
                after = self._land(shorter, left, met)
        except (JointFailure, NoForces):
            self.reached, self._early = known  # it is found where the drift ends
            return None
        if after is None:
            self._carried += met.passing
            self.reached, self._early = known
            return self._cut(part)
        return shorter, after

    def _shortened(self, part: Part, drift: float, near: Part) -> Part:
        """Return a part with a shorter drift [s]; Newton's method begins with a similar part."""
        lasts = part.lasts - (part.drift - drift) / 2
        if drift >= SOON * part.drift:
            return self._solved(part._replace(forces=near.forces, active=near.active), drift, lasts)
        moved = part.begun + lasts * (self._laws + part.pulls)
        return part._replace(drift=drift, lasts=lasts, moved=moved)

    def _land(self, shorter: Part, left: float, met: Met) -> Part:
        """Return the part after a landing, of length `left` [s]."""
        place, joints = shorter.end, shorter.kick.joints
        down = self._speculative.contacts(met.corners, place, joints.origin, met.hits)
        joints.time(left, left)
        lengths = joints.lengths(self._until - left), joints.lengths(self._until)
        kick = self._build.anew(place, shorter.kick.contacts_at(place).and_(down), lengths)
        forces, active = recalled(shorter.kick, shorter.forces, shorter.active, kick)
        self._take_in(around(kick, down.bodies.tolist()))
        part = shorter._replace(kick=kick, forces=forces, active=active)
        struck = kick.layout.touching.pair >= len(kick.contacts.bodies) - len(down.bodies)
        begun, stages = self._struck(part, struck)
        after = part._replace(left=left, drift=left, begun=begun, before=stages, moved=begun)
        return self._closed(self._solved(after, left, left / 2))

    def _pass(self, shorter: Part, left: float, met: Met, near: Sequence[Pair]) -> Part | None:
        """Return the part after contacts pass the ends of sides, of length `left` [s].

        None where a curve goes on as another body; see `goes_on`.
        """
        place, joints, ends = shorter.end, shorter.kick.joints, self._speculative.ends
        joints.time(left, left)
        lengths = joints.lengths(self._until - left), joints.lengths(self._until)
        ended = shorter._replace(kick=shorter.kick.between(place, *lengths))
        _, begun, stage = self._arrived(ended, np.zeros(len(ended.kick.ahead), dtype=bool))
        beside = self._meetings.beside(ended, begun, met, near)
        if goes_on(ended.kick, met.passing, beside):
            return None
        after, at_ends = ends.after(ended.kick, met.passing, begun)
        known = shorter.kick.contacts_at(place, [one.contact for one in met.passing])
        kick = self._build.anew(place, known.and_(beside).and_(after), lengths, at_ends)
        self._take_in(around(kick, beside.bodies.tolist()))
        forces, active = recalled(shorter.kick, shorter.forces, shorter.active, kick)
        part = Part(kick, left, left, begun, left / 2, forces, active, begun, (stage,))
        return self._closed(self._solved(part, left, left / 2))

    def _arrived(self, part: Part, struck: Booleans) -> tuple[Kick, Array, Stage]:
        """Return the velocities at the end of a part, before any impact, and the stage up to there.

        See `_struck`; also the rows of bodies that are `reached`.
        """
        mine, others, drive = self._others(part)
        some = replace(part.kick, layout=part.kick.layout.around(mine))
        half = part.drift / 2
        came, to_it = impacts.come(some, part.moved + half * drive, struck, part.active)
        return some, came, Stage.of(part.kick, half, came[self._order], to_it + half * others)

    def _struck(self, part: Part, struck: Booleans) -> tuple[Array, tuple[Stage, ...]]:
        """Return the velocities after the impact at the end of a part, and its stages.

        The part already has the rows there; `struck` tells which of its gaps land, (k,).
        """
        some, came, before = self._arrived(part, struck)
        begun, pushes, pairs = impacts.bounce(some, came, struck, part.active)
        stages = before, Stage.of(part.kick, 0.0, begun[self._order], pushes)
        landed = part.kick.layout.touching.pair[struck]
        time = self._whole.drift - part.left + part.drift
        self.record.note(pairs, time, stages[1].contacts, landed)
        return begun, stages

    def _others(self, part: Part) -> tuple[Booleans, Array, Array]:
        """Return which rows act on `reached` bodies, and the forces of the others: (r,) each.

        Also the accelerations by these forces and by laws, (3 N,).
        """
        mine = concerned(part.kick, self.reached)
        others = np.where(mine, 0.0, part.forces)
        return mine, others, self._laws + others @ part.kick.response

    def _solved(self, part: Part, drift: float, lasts: float) -> Part:
        """Return a part solved for given lengths of its drift and of its kick [s]."""
        joints, start = part.kick.joints, self._until - part.left
        joints.time(drift, drift)
        kick = part.kick.lasting(joints.lengths(start), joints.lengths(start + drift))
        mine, _, drive = self._others(part)
        motion = part.begun + lasts * drive
        part = part._replace(kick=kick, drift=drift, lasts=lasts, moved=motion)
        if not mine.any():
            return part
        slips = mine[kick.layout.slips]
        some = replace(kick, layout=kick.layout.around(mine))
        guess = Active(part.active.on & mine, np.where(slips, part.active.slip, 0))
        impulse, moved, held = hold(
            some, motion, (np.where(mine, part.forces * lasts, 0.0), guess), driven=self._driven
        )
        leaning = some.leaning(moved, impulse)
        if leaning is not None:
            impulse, moved, held = hold(leaning, motion, (impulse, held), driven=self._driven)
            kick = replace(leaning, layout=kick.layout)
        return part._replace(
            kick=kick,
            forces=np.where(mine, impulse / lasts, part.forces),
            active=Active(
                np.where(mine, held.on, part.active.on),
                np.where(slips, held.slip, part.active.slip),
            ),
            moved=moved,
        )

    def _closed(self, part: Part, *, locates: bool = True) -> Part:
        """Return a part in which corners have come down; see `closed`."""
        look, build = self._speculative, self._build
        return closed(part, look, build, self._laws, self._again, locates=locates)[0]

    def _again(self, part: Part, kick: Kick) -> Part:
        """Return a part, solved with more rows."""
        forces, active = recalled(part.kick, part.forces, part.active, kick)
        more = part._replace(kick=kick, forces=forces, active=active)
        return self._solved(more, part.drift, part.lasts)
