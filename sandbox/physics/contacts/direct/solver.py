"""Contacts and exact joints, solved together in one step.

pymunk drifts and finds the contacts. Its own impulses are discarded: the velocities before the kick
are kicked again, and the impulses λ of joints, contacts and friction are found together, so that
after the next drift joints have kept their lengths, no gap has shrunk, and nothing slips that
friction holds:

    q' = q + h v',    v' = v + L a + M⁻¹ Jᵀ λ,    C(q') = 0,    0 <= λ_n  ⊥  V(q') - V(q) >= 0, ...

L is the length of the kick and h that of the drift. This is leapfrog under constraints (SHAKE) with
the complementarity of contact (Moreau 1988; Stewart and Trinkle 1996; Anitescu and Potra 1997),
solved by Newton's method over the problem in `complementarity`. A heavy body on a light one is as
easy as any other, since everything is solved at once.

A contact that approaches faster than forces within one step could cause is an impact. The kick is
then taken in three parts: up to the step, with resting contacts and joints; all impacts at once, at
the level of velocities, with Newton's law of restitution; and the rest of the kick.
"""

from functools import partial

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.detection.contact_queries import Query
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import Active
from sandbox.physics.contacts.direct.drifts.crowded_landings import stopped
from sandbox.physics.contacts.direct.drifts.drift_record import Drifts
from sandbox.physics.contacts.direct.drifts.drifts_with_landings import DriftCutter
from sandbox.physics.contacts.direct.drifts.fallback_subdivision import through
from sandbox.physics.contacts.direct.drifts.slip_ends import slip_ends
from sandbox.physics.contacts.direct.drifts.subdrift_records import CutDrift, Subdrift
from sandbox.physics.contacts.direct.drifts.taut_ropes_and_reached_stops import Pulls, caught
from sandbox.physics.contacts.direct.kicks.breaking_loose import with_breakaway
from sandbox.physics.contacts.direct.kicks.kick_builder import KickBuilder
from sandbox.physics.contacts.direct.kicks.kick_records import KickResult, Stage
from sandbox.physics.contacts.direct.kicks.kick_with_impacts import KickStart, solve_kick
from sandbox.physics.contacts.direct.kicks.speculative_kicks import close_slow_corners
from sandbox.physics.contacts.direct.prediction.speculative_contacts import SpeculativeContacts
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.rows.row_layout import Surfaces
from sandbox.physics.contacts.direct.solving.blocked_drives import is_blocked
from sandbox.physics.contacts.direct.solving.warm_start import WarmStart
from sandbox.physics.contacts.impacts.impact_outcome import ImpactOutcome
from sandbox.physics.engine.space_arrays import Batch, Booleans, Contacts
from sandbox.physics.joints.exact.constraint_interface import Coordinates, coordinate_indices
from sandbox.physics.joints.exact.joint_system import KeptLengths
from sandbox.physics.joints.exact.shake import ExactJoints
from sandbox.physics.state.simulation_errors import JointFailure, NoForces


class DirectSolver:
    """Solves contacts and exact joints together; n bodies.

    `batch` reads and writes the bodies, and `query` finds the contacts of those that were moved.
    `inertia`, (n, 3), has masses twice and moments, 0 for bodies that do not move or
    turn [kg, kg m²]; `dt` is the time step [s].

    `last` are the impacts of the last kick, with the impulses of landings in the drift before it;
    `stages` are its stages, if it had impacts, else empty. `drifts` are those before and after it.
    `expected_change`, (n, 3), is how velocities will change in a step without impacts [m/s, rad/s].
    """

    def __init__(
        self,
        batch: Batch,
        joints: ExactJoints,
        surfaces: Surfaces,
        inertia: Array,
        dt: float,
        query: Query,
    ) -> None:
        self._batch, self._joints, self._dt = batch, joints, dt
        self._movable: Booleans = inertia[:, 0] > 0
        self._fixed, self._none = np.flatnonzero(~self._movable), np.zeros_like(self._movable)
        self._meets = any(body.shapes for body in query.bodies)
        self._lands, self._runs = bool(surfaces.lands.any()), bool(surfaces.running.any())
        self._indices = coordinate_indices(len(inertia))
        self._calm = ImpactOutcome.none(len(inertia))
        self._pre_kick = self._acceleration = self.expected_change = self._calm.jump
        self._lead, self._until, self._starts = 0.0, 0.0, True  # until the drift ends [s]
        self._warm, self._pulls = WarmStart(), Pulls()
        self._crowd: Booleans | None = None  # the one that was stopped in this kick
        self._build = KickBuilder(batch, joints, surfaces, self._movable, query, self._warm)
        self._speculative = SpeculativeContacts(query, surfaces, self._movable)
        self._pushed: tuple[Kick, Array] | None = None  # impulses that the contacts lack so far
        self.last, self.drifts = self._calm, Drifts(len(inertia))
        self.stages: tuple[Stage, ...] = ()
        self._solved: tuple[Kick, Array] | None = None  # the last kick with contacts, its impulses
        self._taken: KickResult | None = None  # the kick now, if contacts were solved in it

    @property
    def contacts(self) -> Contacts:
        """The contacts of the last kick; their impulses are computed on demand."""
        if self._pushed:
            kick, total = self._pushed
            self._build.contacts, self._pushed = kick.contacts_with(total), None
        return self._build.contacts

    def begin(self, acceleration: Array, belated: Array | None = None, *, start: bool) -> None:
        """Record the velocities before a kick, and the accelerations in it.

        `acceleration`, (n, 3), is by gravity and force laws [m/s², rad/s²]; `belated`, (n, 3), is
        added to the velocities first [m/s, rad/s]. `start`: this is the first, begun at its step.
        """
        if start and self._starts:  # it is repeated, and its crowd is known
            self.drifts.forget()
        else:
            self._build.corrects, self._crowd = True, None
        self._pre_kick = self.velocity() if belated is None else self.velocity() + belated
        self._acceleration, self._starts = acceleration, start
        self._lead = 0.0 if start else self._joints.kick - self._dt / 2

    def velocity(self) -> Array:
        """Return the velocities before a kick: (n, 3) [m/s, rad/s]."""
        divided = self.drifts.drift_after
        return divided.pre_kick_velocity if divided else self._batch.velocity()

    def solve(self, until: float) -> None:
        """Find the impulses of a kick, and set the velocities after it.

        The drift that follows ends at the time `until` [s]. Raises `JointFailure` or `NoForces` if
        there are no such impulses.
        """
        if self._meets:
            self._build.find_contacts(lambda: np.abs(self._pre_kick) * self._dt)
        self._pushed = self._taken = None
        self._until, self.last, self.stages = until, self._calm, ()
        self.drifts.begin(self._build.contacts)
        self._build.set_course(until)
        self._joints.check()
        if len(self._build.contacts.bodies) or np.count_nonzero(self._joints.added):
            self._solve_all()
        else:
            self._warm.forget()
            self._solved = None
            self._solve_joints(until)
        self._pulls.note(self._joints)
        landed = None if self.drifts.drift_after else self._land(until)
        if self._meets or self.drifts.drift_after:
            self._note_change(landed)
        if np.count_nonzero(pushed := self.drifts.landings.body_impulse):
            self.last = self.last._replace(impulse=pushed)

    def _note_change(self, landed: CutDrift | None) -> None:
        """Note how velocities change in a step, from the drift after the kick if that is cut."""
        divided = self.drifts.drift_after
        after = divided.post_kick_velocity if divided else self._batch.velocity()
        if landed:
            after = landed.whole.velocity[self._indices]
        change = (after - self._pre_kick) * (self._dt / self._joints.kick)
        if self.last is not self._calm:
            change = np.where(self.last.struck[:, None], 2 * (after - self.last.velocity), change)
        if landed:
            change[landed.reached] = (landed.end_acceleration * self._dt)[landed.reached]
        self.expected_change = change

    def go_on(self, t: float) -> None:
        """Begin at a time, and not at the start [s]."""
        self._build.go_on(t)

    def without_correction(self, kept_lengths: KeptLengths) -> Kick:
        """Return the system of all contacts and joints at present, before a drift."""
        self.relay()
        return self._build.without_correction(kept_lengths)

    def relay(self) -> None:
        """Start again with other joints, at the present positions."""
        self._build.relay()
        self._speculative.approaching.forget()
        self._begin_anew()

    def forget(self) -> None:
        """Start again: bodies were moved."""
        self._build.forget()
        self._begin_anew()

    def _begin_anew(self) -> None:
        """Forget the last kick and the drift after it."""
        self._warm.forget()
        self.drifts.forget()
        self.expected_change, self._crowd = self._calm.jump, None

    def _solve_joints(self, until: float) -> None:
        """Solve joints without contacts; if ropes fail in this way, solve them as contacts are."""
        if self.drifts.drift_before:  # pymunk knows only the mean velocities
            self._batch.set_velocity(self._pre_kick + self._acceleration * self._joints.kick)
        velocity = self._batch.velocity()
        try:
            self._joints.solve(until)
        except JointFailure:
            self._batch.set_velocity(velocity)
            self._solve_all()

    def _solve_all(self) -> None:
        start = self._beginning()
        kick = self._build.corrected(start.velocity * self._dt)
        try:
            taken = solve_kick(kick, start, self._warm)
        except (JointFailure, NoForces) as whole:
            if not self._divides(kick):
                if isinstance(whole, NoForces):
                    whole.blocked = is_blocked(kick, start.velocity)
                raise
            try:
                self._divide(kick, start)
            except (JointFailure, NoForces) as last:  # a joint tells more in a whole step
                raise (whole if isinstance(whole, JointFailure) else last) from None
            return
        smooth = self._is_whole and not taken.impacts
        loose = with_breakaway(kick, taken.active.slip, self._warm.last_two) if smooth else None
        taken = solve_kick(loose, start, self._warm) if loose else taken
        self._keep(self._close_corners(taken, start), start)

    def _keep(self, taken: KickResult, start: KickStart) -> None:
        """Set the velocities after a kick, and remember it."""
        leaning = taken.kick.with_tilt_friction(taken.velocity, taken.forces)
        if leaning is not None:
            taken = solve_kick(leaning, start, self._warm)
        self.last, self.stages, self._taken = taken.impacts or self._calm, taken.stages, taken
        self._batch.set_velocity(taken.velocity.take(self._indices))
        self._warm.note(taken.kick, taken.forces, taken.active)
        self._report(taken.kick, taken.impulse, taken.active)

    def _close_corners(self, taken: KickResult, start: KickStart) -> KickResult:
        """Return a kick after which slow corners have come down; see `close_slow_corners`."""
        look, build, warm, locates = self._speculative, self._build, self._warm, self._locates
        laws, again = start.acceleration, lambda _, kick: solve_kick(kick, start, warm)
        taken, strikes = close_slow_corners(taken, look, build, laws, again, locates=locates)
        return taken._replace(strikes=True) if strikes else taken

    @property
    def _locates(self) -> bool:
        """Whether landings are located in the drift after this kick."""
        kick, dt = self._dt / 2 if self._starts else self._dt, self._dt
        return self._lands and self._joints.drift == dt and self._joints.kick == kick

    def _divides(self, kick: Kick) -> bool:
        """Whether a drift can be taken in parts: it is a whole one, and nothing drives bodies."""
        return self._is_whole and not (self._driven() or np.count_nonzero(kick.joint_rates()))

    @property
    def _is_whole(self) -> bool:
        """Whether this kick and the drift after it are as long as a step."""
        return not self._starts and self._joints.kick == self._joints.drift == self._dt

    def _divide(self, kick: Kick, start: KickStart) -> None:
        """Take the drift after a kick in parts, and set its mean velocities."""
        takes = partial(solve_kick, start=start, warm_start=self._warm)
        found = through(kick, start.acceleration, self._until, takes)
        first = found.first
        self.last = first.impacts or self._calm
        mean = found.displacement[self._indices] / self._joints.drift
        self.drifts.divide(found.drift_record(self._batch.state()[:, :3], self._indices), mean)
        self._batch.set_velocity(mean)
        self._warm.note(first.kick, first.forces, first.active)
        self._report(first.kick, found.full_impulse, first.active)

    def _land(self, until: float, stopped: Booleans | None = None) -> CutDrift | None:
        """Locate the landings in the drift after a kick, which ends at a time [s].

        Crowds are stopped; then the other landings are looked for again, without the `stopped`.
        """
        pulls = self._pulls.begins
        if not (self._locates and (self._meets or pulls)):
            return None
        taken, look = self._taken, self._speculative
        pose, motion = taken.coordinates if taken else self._joints.coordinates()
        displacement = self._dt * motion.values
        ends = taken and (
            taken.strikes or taken.flat or look.ends.passing(taken.kick, displacement, taken.forces)
        )
        lands = ends or look.approaching.near(self._build.contacts, pose, displacement)
        if not (lands or pulls or (taken and taken.slides)):
            return None
        whole, (laws,) = self._whole_drift(pose, motion.values), self._spread(self._acceleration)
        if not (lands or (pulls and caught(whole, laws).any()) or len(slip_ends(whole, laws))):
            return None
        driven, calm = self._driven(), self._none if stopped is None else stopped
        if stopped is None and self._crowd is not None:
            self._stop(whole.kick, self._crowd)
            return self._land(until, self._crowd)
        landings = DriftCutter(look, self._build, laws, until, driven=driven, stopped=calm)
        parts = landings.cut_at_landings(whole)
        if landings.crowd.any():
            self._crowd = landings.crowd | calm
            self._stop(whole.kick, self._crowd)
            return None if calm[self._movable].all() else self._land(until, self._crowd)
        if len(parts) == 1:
            return None
        last, start = parts[-1], self._batch.state()[:, :3]
        landed = CutDrift(whole, parts, laws, landings.reached, start)
        divided = landed.divided
        mean_velocity = (divided.end_pose - start) / self._dt
        mean = np.where(landed.reached[:, None], mean_velocity, divided.post_kick_velocity)
        self.drifts.divide(divided, mean)
        self.drifts.land(landings.record)
        self._batch.set_velocity(mean)
        self._warm.note(last.kick, last.later_forces, last.active)
        return landed

    def _stop(self, kick: Kick, crowded: Booleans) -> None:
        """Let what would land in a crowd, (n,), come to touch after a kick, and go no further."""
        start, warm, look, build = self._beginning(), self._warm, self._speculative, self._build
        taken = self._taken or solve_kick(kick, start, warm)
        found = stopped(taken, crowded, look, build, lambda _, kick: solve_kick(kick, start, warm))
        self._keep(found[0], start)

    def _whole_drift(self, pose: Coordinates, velocity: Array) -> Subdrift:
        """Return the drift after a kick as one part, with velocities (3 N,)."""
        dt, joints = self._dt, self._joints
        if self._taken:
            return Subdrift.whole_drift(self._taken, dt, velocity)
        begun = self._spread(self._pre_kick)[0]
        active = Active(joints.expected()[1], np.zeros(0, dtype=np.intp))
        duration, kick = joints.kick, self._build.at(pose)
        return Subdrift(kick, dt, dt, begun, duration, joints.tension, active, velocity)

    def _beginning(self) -> KickStart:
        """Return the state and the forces at the beginning of this kick."""
        rates = self._pre_kick, self._acceleration, self.expected_change
        velocity, acts, change = self._spread(*rates)
        return KickStart(velocity, acts, change, self._lead, self._dt, self._driven())

    def _spread(self, *rates: Array) -> Array:
        """Return s arrays of rates (n, 3) in the order of coordinates: (s, 3 N)."""
        values = np.zeros((len(rates), 3 * len(self._movable) + 3))
        values[:, self._indices] = rates
        return values

    def _driven(self) -> bool:
        """Whether running surfaces or kinematic bodies may add energy."""
        return self._runs or bool(np.count_nonzero(self._pre_kick.take(self._fixed, axis=0)))

    def _report(self, kick: Kick, total: Array, active: Active) -> None:
        """Pass the impulses of the whole kick, (r,), and its active rows to joints and contacts."""
        joints = kick.layout.joints
        struck = self.last is not self._calm and bool(self.last.struck.any())
        forces = total[joints] / self._joints.kick
        self._joints.store_forces(forces, active.on[joints], struck=struck)
        self._solved = self._pushed = kick, total

    def wrenches(self, body: int) -> Array:
        """Return the impulses on a body by each contact in the last kick: (2, k, 3) [N s, N m s].

        First the normal ones, then friction. The torque about the centre of mass shows where
        between its two points a side bears.
        """
        solved = self._solved
        return solved[0].wrenches(solved[1], body) if solved else np.zeros((2, 0, 3))
