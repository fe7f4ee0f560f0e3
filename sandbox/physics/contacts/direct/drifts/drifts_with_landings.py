"""Drifts in which bodies land: each landing is located, and is an impact at its own time.

Between two kicks leapfrog represents motion on a parabola, with the accelerations of the last kick.
Where bodies meet on it, the drift is cut: (1) The kick before it is solved again, for a drift that
ends there. (2) One impact follows, with all joints and contacts that take part in it. (3) Another
drift follows, in which the bodies that met touch, or are on their way back. Thus no body is stopped
above what it lands on, or pushed out of it. A corner that comes down beside another that already
touches lands in the same way, if it is faster than forces within one step could make it.

A drift is also cut where a contact passes the end of a side: a disc that rolls off a table falls
from there, and not from where the step ends; see `support_ends`. Nothing is struck there, but other
contacts act from there on.

It is also cut where friction ends a slip (see `slip_ends`), and sticks from there on if it can. A
rope that becomes taut, or a stop that is reached, is an impact and cuts it too:
`taut_ropes_and_reached_stops`.

Bodies that take no part continue as before. A crowd that lands is stopped: `crowded_landings`.
"""

from collections.abc import Sequence
from contextlib import suppress
from math import inf

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.drifts.crowded_landings import FORESEEN, crowd, stopped
from sandbox.physics.contacts.direct.drifts.first_contact_or_edge import FirstMeeting, MeetingFinder
from sandbox.physics.contacts.direct.drifts.landing_record import LandingRecord
from sandbox.physics.contacts.direct.drifts.landing_time_refinement import until_first
from sandbox.physics.contacts.direct.drifts.slip_ends import slip_ends, until_it_stops
from sandbox.physics.contacts.direct.drifts.subdrift_records import (
    Subdrift,
    around,
    linked,
    movable,
    rows_acting_on,
)
from sandbox.physics.contacts.direct.drifts.subdrift_solver import SubdriftSolver
from sandbox.physics.contacts.direct.drifts.taut_ropes_and_reached_stops import (
    catch_time,
    caught,
    loose,
    not_reached,
    refuse_more,
    restitution,
    until_caught,
)
from sandbox.physics.contacts.direct.kicks import coupled_impacts
from sandbox.physics.contacts.direct.kicks.kick_builder import KickBuilder
from sandbox.physics.contacts.direct.kicks.kick_records import Stage
from sandbox.physics.contacts.direct.kicks.speculative_kicks import close_slow_corners
from sandbox.physics.contacts.direct.prediction.convex_parts import Pair
from sandbox.physics.contacts.direct.prediction.speculative_contacts import SpeculativeContacts
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.solving.warm_start import recalled
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Booleans
from sandbox.physics.state.simulation_errors import JointFailure, NoForces

LEAST = 0.06
"""If contacts do not keep their gaps, parts above this share of the drift are divided: bodies that
turn far in a part gain energy on its curved path, by the third power of its length."""

MOST = 16
"""The most landings of one drift that are located. With more of them all bodies are a crowd."""

CATCHES = 8
"""The most times that one-sided joints catch in a drift that are located."""

STOPS = 2
"""The most ends of slips that are located in a drift."""

AGAIN = 4
"""How often, at most, a drift is followed again because more bodies turn out to take part in it."""


class _Late(Exception):  # noqa: N818 (no error: the drift is followed once more)
    """A body takes part in a landing, but was not followed from the first one on."""


class DriftCutter(SubdriftSolver):
    """Cuts a drift where bodies land in it; N bodies with the plane.

    `laws`, (3 N,), are the accelerations by gravity and force laws [m/s², rad/s²]; the drift ends
    at the time `until` [s]. `driven` tells whether running surfaces or kinematic bodies may add
    energy, and `stopped`, (n,), which bodies are in crowds that were stopped: they do not land.

    `reached`, (n,), tells which bodies take part in landings, and `crowd`, (n,), which are a crowd
    from the start on: then nothing is located. `record` has what collided in them, and how hard.
    """

    def __init__(
        self,
        speculative: SpeculativeContacts,
        build: KickBuilder,
        laws: Array,
        until: float,
        *,
        driven: bool,
        stopped: Booleans,
    ) -> None:
        super().__init__(laws, until, driven=driven)
        self._speculative, self._build, self._still = speculative, build, stopped
        self._meetings, self._may_restart = MeetingFinder(speculative, laws), True
        count = len(laws) // 3 - 1
        self._whole: Subdrift  # the drift
        self.crowd: Booleans = np.zeros(count, dtype=bool)
        self._begin(np.zeros(count, dtype=bool))

    def cut_at_landings(self, whole: Subdrift) -> list[Subdrift]:
        """Return the parts of the drift after a kick: the drift itself if nothing lands.

        A body in a later landing has to be followed from the first one on if other bodies press on
        it. So then the drift is followed once more from its start.
        """
        joints, kick, self._whole = whole.kick.joints, whole.kick.joints.kick, whole
        try:
            for _ in range(AGAIN):
                with suppress(_Late):
                    return self._parts(whole)
                self._begin(self.reached | around(whole.kick, self._near))
            self._may_restart = False
            return self._parts(whole)
        finally:
            joints.time(kick, whole.drift)

    def _begin(self, reached: Booleans) -> None:
        """Begin a drift in whose landings some bodies, (n,), are known to take part."""
        self.reached, self._stopped = reached, self._still
        self._undisturbed = self._stopped & ~reached  # stopped, and not disturbed since
        self._stops = self._catches = 0  # the ends of slips, and the catches, that were located
        self._early: Booleans | None = None  # those that take part from the first landing on
        self._near: list[Pair] = []  # those that might take part
        self.record = LandingRecord(len(reached))

    def _add_bodies(self, bodies: Booleans) -> None:
        """Note which bodies take part: (n,).

        Raises `_Late` if some press on others, but did not take part from the first landing on.
        """
        self.reached = self.reached | bodies
        if self._early is not None and self._may_restart:
            late, whole = self.reached & ~self._early, self._whole
            if np.count_nonzero(whole.forces[rows_acting_on(whole.kick, late)]):
                raise _Late

    def _parts(self, whole: Subdrift) -> list[Subdrift]:
        """Return the parts of a drift."""
        parts = [whole]
        while len(parts) <= MOST and (found := self._cut(parts[-1], len(parts))):
            parts[-1:] = found
        if len(parts) > MOST:
            self.crowd, parts = movable(whole.kick), [whole]
        elif len(parts) > 1:
            last = parts[-1]._replace(stopped_crowds=bool(self._stopped.any()))
            parts[-1] = self._lasting(last, whole.drift)
        return parts

    def _cut(self, part: Subdrift, number: int) -> tuple[Subdrift, ...]:
        """Split a part, counted by `number`, at its first landing, catch or the like.

        Return the two; () if there is none, and the part alone if a crowd was stopped in it.
        """
        kick, saved = part.kick, (self.reached, self._early)
        free = self._loose(part)
        stopped = self._until_it_stops(free)
        kick.joints.time(part.drift, part.drift)
        seen = stopped or free
        ahead = self._meetings.ahead(seen, self._is_calm)
        self._near += ahead.pairs
        met = self._meetings.first(seen, seen.drift, ahead) if any(ahead) else None
        catch = inf if free is part else catch_time(seen, self._laws, self._until, seen.drift)
        met, catch = (None, catch) if met is None or catch < met.time else (met, inf)
        sunk = [] if catch < inf else self._deep_pairs(seen)
        if not (met or stopped or sunk or catch < inf):
            self.reached = saved[0]
            return ()
        if met and ((halted := self._halted(part, met, number, saved[0])) or self.crowd.any()):
            return halted
        self._add_bodies(around(kick, [*(met.pairs if met else ()), *sunk]))
        self._early = self.reached if self._early is None else self._early
        try:
            if met:
                seen, met = until_first(seen, met, self._meetings, self._shortened)
            elif catch < inf:
                self._catches += 1
                seen = until_caught(free, catch, self._laws, self._until, self._shortened)
            elif stopped:
                self._stops += 1
            seen, met = self._kept(free, seen, met)
            left = part.drift - seen.drift
            if met and met.passing:
                return seen, self._pass(seen, left, met, ahead.pairs)
            return seen, self._land(seen, left, met, ahead.pairs)
        except (JointFailure, NoForces):
            self.reached, self._early = saved  # this is left to the end of the drift
            return ()

    def _loose(self, part: Subdrift) -> Subdrift:
        """Return a part, solved without the slack joints that catch in it, if any do."""
        catches = caught(part, self._laws)
        if self._catches == CATCHES or not np.count_nonzero(catches):
            refuse_more(part, catches)
            return part
        saved, acts = self.reached, part.kick.acts[part.kick.layout.joints][catches]
        self.reached = saved | linked(part.kick, np.asarray(acts.any(axis=0)))
        try:
            return self._solved(loose(part, self._laws), part.drift, part.kick_duration)
        except (JointFailure, NoForces):
            self.reached = saved
            return part

    def _until_it_stops(self, part: Subdrift) -> Subdrift | None:
        """Return a part up to where its first slip ends; None if none does."""
        ends = slip_ends(part, self._laws)
        ends = ends[~self._stopped[part.kick.layout.touching.friction_bodies[:, ends]].any(axis=0)]
        if not len(ends) or self._stops == STOPS:
            return None
        saved, slides = self.reached, part.kick.layout.touching.friction_bodies[:, ends]
        self.reached = saved | around(part.kick, slides.T.tolist())
        if (stopped := until_it_stops(part, ends, self._laws, self._shortened)) is None:
            self.reached = saved
        return stopped

    def _halted(
        self, part: Subdrift, met: FirstMeeting, number: int, reached: Booleans
    ) -> tuple[Subdrift, ...]:
        """Return a part in which a crowd comes to touch, if one lands in it.

        If the part is the whole drift, the `crowd` is only noted: the caller stops it by the kick
        before. `number` counts the parts; `reached`, (n,), took part in what has landed so far.
        """
        begins, many = part.time_left == self._whole.drift, number + met.time_count > FORESEEN
        dull, struck = self._speculative.dull, self.record.impacts
        crowded = crowd(part.kick, met, dull, struck, begins=begins)
        if many and (begins or not crowded.any()):
            self.crowd = movable(part.kick)
        elif begins and (crowded & ~self._still).any():
            self.crowd = crowded
        if begins or not crowded.any():
            return ()

        def again(part: Subdrift, kick: Kick) -> Subdrift:
            self._add_bodies(around(kick, kick.contacts.bodies[-kick.closing_count :].tolist()))
            return self._again(part, kick)

        reached_before, self.reached = self.reached, reached
        self._add_bodies(crowded)
        found, crowded = stopped(part, crowded, self._speculative, self._build, again)
        if found is part:
            self.reached = reached_before  # no forces are found
            return ()
        self._stopped, self._undisturbed = self._stopped | crowded, self._undisturbed | crowded
        return (found,)

    def _deep_pairs(self, part: Subdrift) -> list[Pair]:
        """Return the pairs of bodies because of which a part is divided."""
        return part.deep_pairs if part.drift > LEAST * self._whole.drift else []

    def _is_calm(self, pair: Pair) -> bool:
        """Return whether one of two bodies was stopped, and nothing has struck them since."""
        both = [*pair]
        calm, reached = self._undisturbed[both], self.reached[both]
        return bool(calm.any() and not (reached & ~calm).any())

    def _kept(
        self, part: Subdrift, shorter: Subdrift, met: FirstMeeting | None
    ) -> tuple[Subdrift, FirstMeeting | None]:
        """Return a part so short that its contacts keep their gaps, and what meets at its end."""
        while self._deep_pairs(shorter):
            shorter, met = self._shortened(part, shorter.drift / 2, shorter), None
        return shorter, met

    def _land(
        self, shorter: Subdrift, left: float, met: FirstMeeting | None, near: Sequence[Pair]
    ) -> Subdrift:
        """Return the part after a landing, of length `left` [s]; `met` is None after a mere cut."""
        pose, joints, down = shorter.end, shorter.kick.joints, NO_CONTACTS
        if met:
            down = self._speculative.contacts(met.corners, pose, joints.origin, met.hits)
            near = [pair for pair in near if pair not in met.pairs]
        joints.time(left, left)
        lengths = joints.kept_lengths(self._until - left, self._until)
        rest = self._meetings.overlapping(shorter, near)
        known = shorter.kick.contacts_at(pose).followed_by(rest)
        kick = self._following(shorter, self._build.rebuilt(pose, known.followed_by(down), lengths))
        forces, active = recalled(shorter.kick, shorter.forces, shorter.active, kick)
        self._add_bodies(around(kick, down.followed_by(rest).bodies.tolist()))
        part = shorter._replace(kick=kick, forces=forces, active=active)
        struck = ~kick.ahead & (kick.layout.touching.pair >= len(known.bodies))
        catching = not_reached(shorter, self._laws) & ~kick.slack
        if met or catching.any():
            begun, stages = self._struck(part, struck, catching)
        else:
            _, begun, stages = self._arrived(part, struck, catching)
        after = part._replace(
            time_left=left, drift=left, start_velocity=begun, stages=stages, velocity=begun
        )
        return self._close_corners(self._solved(after, left, left / 2))

    def _pass(
        self, shorter: Subdrift, left: float, met: FirstMeeting, near: Sequence[Pair]
    ) -> Subdrift:
        """Return the part after contacts pass the ends of sides, of length `left` [s]."""
        pose, joints, ends = shorter.end, shorter.kick.joints, self._speculative.ends
        joints.time(left, left)
        lengths = joints.kept_lengths(self._until - left, self._until)
        ended = shorter._replace(kick=shorter.kick.between(pose, lengths))
        _, begun, stages = self._arrived(ended, np.zeros(len(ended.kick.ahead), dtype=bool))
        beside = self._meetings.beside(ended, begun, met, near)
        after, at_ends = ends.after(ended.kick, met.passing, begun)
        known = shorter.kick.contacts_at(pose, [one.contact for one in met.passing])
        known = known.followed_by(beside).followed_by(after)
        kick = self._following(shorter, self._build.rebuilt(pose, known, lengths, at_ends))
        self._add_bodies(around(kick, beside.bodies.tolist()))
        forces, active = recalled(shorter.kick, shorter.forces, shorter.active, kick)
        part = Subdrift(kick, left, left, begun, left / 2, forces, active, begun, stages)
        return self._close_corners(self._solved(part, left, left / 2))

    def _following(self, ended: Subdrift, kick: Kick) -> Kick:
        """Return the rows where a part ends, with those that are still to close from there on."""
        self._undisturbed = self._undisturbed & ~self.reached  # the motion of these has changed
        opened = ended.kick.open_at(ended.end)
        return self._build.with_ahead(kick, opened) if len(opened.bodies) else kick

    def _struck(
        self, part: Subdrift, struck: Booleans, catching: Booleans
    ) -> tuple[Array, tuple[Stage, ...]]:
        """Return the velocities after the impact at the end of a part, and its stages.

        The part already has the rows there; `struck` tells which of its gaps land, (k,), and
        `catching` which of its joints catch, (m,).
        """
        some, approach, before = self._arrived(part, struck, catching)
        rebounds = restitution(part, approach, catching, self._laws, self._whole.drift)
        begun, pushes, pairs = coupled_impacts.solve_impacts(
            some, approach, struck, part.active, rebounds
        )
        stages = *before, Stage.of(part.kick, 0.0, begun[self._indices], pushes)
        landed = part.kick.layout.touching.pair[struck]
        time = self._whole.drift - part.time_left + part.drift
        self.record.note(pairs, time, stages[1].contacts, landed)
        if np.count_nonzero(catching):
            self.record.jerked = self.record.jerked | self.reached
        return begun, stages

    def _close_corners(self, part: Subdrift) -> Subdrift:
        """Return a part in which corners have come down; see `close_slow_corners`."""
        return close_slow_corners(part, self._speculative, self._build, self._laws, self._again)[0]
