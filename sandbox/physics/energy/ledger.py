"""The ledger: the sources and sinks of the energy and momentum of a run.

A step drifts, then kicks. From the middle of one drift to the middle of the next there are half a
drift, one kick, and half a drift, and only the kick changes velocities. An impulse J in a kick that
takes a velocity from v₋ to v₊ does the work J · (v₋ + v₊)/2, whatever else acts in the same kick.
So the change of kinetic energy is exactly the sum of the works of all impulses, and each is booked
separately.

A force with a potential is booked by the change of its potential energy, read in the middle of the
drift, instead of by its work. The two differ if a step is too coarse. That difference, and any
other change without a cause, is `unexplained`: the numerical error. Nothing corrects it.

A step of higher order has several drifts and kicks, and shares its last kick with the next step. It
is read from step to step instead: half of that kick is booked before the step, and half after it.

Some causes cannot add energy: contacts, impacts with e = 1, joints of constant length. If they seem
to, that energy is not booked, and stays unexplained.
"""

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.kicks.kick_records import Stage
from sandbox.physics.contacts.impacts.contact_work import KickRecord
from sandbox.physics.energy.balance import Balance
from sandbox.physics.energy.energy_and_momentum import MechanicalEnergy, velocity_of
from sandbox.physics.energy.impulse_attribution import Attribution
from sandbox.physics.energy.kicks_within_drifts import before_landings, kicks_within
from sandbox.physics.energy.ledger_entries import Entries
from sandbox.physics.energy.step_record import Recorded
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.events.impact_response import DriftImpacts
from sandbox.physics.events.joint_cuts_and_force_switches import EventEntries
from sandbox.physics.events.slip_phases import SlipEntries
from sandbox.physics.forces.variable_mass import MassFlows
from sandbox.physics.joints.joint_forces import pulls_of
from sandbox.physics.state.motion import Instant

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.drifts.fallback_subdivision import DividedDrift
    from sandbox.physics.forces.law import Law

SEEN = 1e-12
"""The share of a position, or of a metre, by which a body must have moved to count as moved."""


class Ledger:
    """Keeps the books of a run, such as a world, at no cost to the run itself; n bodies.

    Open it on a run, call `note` after every step, and read its `balance`. All it knows of a step
    is the run's record of it. `steps` counts the steps that are booked. `pre_kick_velocity`, (n,
    3), are the velocities at the beginning of the last kick [m/s, rad/s], to open the books one
    step earlier.
    """

    def __init__(self, run: Recorded, pre_kick_velocity: Array | None = None) -> None:
        scene, level = run.scene, run.level
        self._run, self._scene, self._step = run, scene, run.last
        self._laws: tuple[Law, ...] = (*([scene.gravity] if scene.gravity else []), *scene.laws)
        self._mechanics = MechanicalEnergy(level, self._laws, scene.inertia, scene.mass_fraction)
        self._entries = Entries(level)
        self._attribution = Attribution(run, self._laws, self._entries)
        self._composed = self._step.composed
        if self._composed:
            pre_kick_velocity = None
            run.keep_trail()
        self._opens_early = pre_kick_velocity is not None
        self.steps = self._step.steps - self._opens_early
        self._velocity = self._coming_velocity() if pre_kick_velocity is None else pre_kick_velocity
        forces = pulls_of(scene.joints, len(scene.inertia))
        self._joint_forces = forces, forces  # of the last kick, and of that before it
        self._was_slack = forces.tension <= 0
        self._overlaps = 0.0
        ahead = -0.5 if self._opens_early else 0.5 * self._first_share()
        start = self._motion_at(ahead, self._velocity)
        if self._composed:
            start = Instant.of(self._step.snapshot)
        mechanics = self._mechanics
        energy = mechanics.kinetic(start) + sum(mechanics.potential_by_account(start).values())
        self._start = energy, self._mechanics.momentum(start)
        self._end = start
        step, motion = self._step, (start.position, self._velocity, scene.inertia)
        seen = step.law_motion or start, *motion, step.turning_acceleration
        self._last_kick = KickRecord(float(start.t), step.dt, *seen)

    def note(self) -> None:
        """Book the world's last step, unless it is booked already.

        Raises `ValueError` if the world has taken more than one step since.
        """
        self._step = step = self._run.last
        if step.steps == self.steps:
            return
        if step.steps != self.steps + 1:
            raise ValueError(f"the ledger has seen step {self.steps}, the world {step.steps}")
        self.steps = step.steps
        if self._composed and step.composed:
            self._book_composed_step()
            return
        if self._composed:
            self._change_over()
        before = self._velocity if self._opens_early else self._book_drift_events()
        self._opens_early = False
        self._book_overlap_correction(before)
        after = self._coming_velocity()
        law_motion = step.law_motion or self._motion_at(0.0, before)
        t = float(law_motion.t)
        motion = step.snapshot.position, before, self._mechanics.inertia(t)
        moment = KickRecord(t, step.dt, law_motion, *motion, step.turning_acceleration)
        self._book_matter_flows(t, before, after)
        forces = pulls_of(self._scene.joints, len(self._scene.inertia))
        slack, start = forces.slack_before(*self._joint_forces), before
        stuck = not step.events and bool(forces.new(self._joint_forces[0]).any())
        for number, stage in enumerate(self._stages(after, forces.tension)):
            duration, end, tension, contacts = stage
            if number or not step.divided_drift:
                self._attribution.begin()
            kick = moment.part(duration, (start + end) / 2, first=not number)
            joint_forces = forces._replace(tension=tension)
            self._attribution.book(
                step, kick, end - start, joint_forces, contacts, None if stuck else slack
            )
            start, slack = end, slack | (tension <= 0)
        self._joint_forces = forces, self._joint_forces[0]
        self._velocity, self._end = after, self._motion_at(0.5 * self._first_share(), after)
        self._last_kick, self._was_slack = moment, slack

    def _stages(self, after: Array, tension: Array) -> Iterable[Stage]:
        """Return the parts of the last kick, with impulses in place of forces."""
        dt, direct = self._step.dt, self._scene.direct
        if direct and direct.drifts.drift_after:
            return direct.drifts.drift_after.stages_before
        if direct and direct.stages:
            return direct.stages
        return (Stage(dt, after, tension * dt, self._kick_contacts()),)

    def _book_composed_step(self) -> None:
        """Book the kicks of a composed step, in which only smooth forces and joints act.

        Half of the kicks at its two ends belongs to the step.
        """
        step, end = self._step, self._end
        parts, begun = step.parts, float(end.t)
        half = parts[-1].kick / 2
        self._push(begun, half, end, self._velocity)
        velocity = self._velocity
        for part, state in zip(parts, step.trail, strict=False):
            t = begun + part.ahead * step.dt
            before = Instant.at(t, state, velocity)
            velocity = state[:, 3:]
            self._push(t, part.kick, before, velocity)
        self._end = Instant.of(step.snapshot)
        before = self._end._replace(velocity=velocity[:, :2], angular_velocity=velocity[:, 2])
        self._push(float(self._end.t), half, before, velocity_of(self._end))
        self._velocity = self._scene.batch.velocity()

    def _change_over(self) -> None:
        """Book the half kick with which the world has changed to leapfrog, for a hand."""
        self._velocity = self._step.pre_kick_velocity
        self._push(float(self._end.t), self._step.dt / 2, self._end, self._velocity)
        self._composed = False

    def _push(self, t: float, length: float, start: Instant, after: Array) -> None:
        """Book a kick in which only laws and joints act, up to the velocities `after`, (n, 3)."""
        before, inertia = velocity_of(start), self._mechanics.inertia(t)
        kick = KickRecord(t, length, start, start.position, (before + after) / 2, inertia)
        laws = sum(
            (self._attribution.book_law(law, kick) for law in self._laws), np.zeros_like(after)
        )
        if self._scene.joints.together:
            self._entries.add_impulse("supports", inertia * (after - before) - laws, kick.positions)

    @property
    def balance(self) -> Balance:
        """The present balance of the books."""
        kinetic, entries = self._mechanics.kinetic(self._end), self._entries
        potential = self._mechanics.potential_by_account(self._end)
        (energy, momentum), total = (self._start, sum(entries.impulses.values(), np.zeros(3)))
        return Balance(
            kinetic,
            potential,
            dict(entries.works),
            {name: -work for name, work in entries.losses.items()},
            kinetic + sum(potential.values()) - energy - entries.explained,
            {name: impulse.copy() for name, impulse in entries.impulses.items()},
            self._mechanics.momentum(self._end) - momentum - total,
            self._overlaps,
        )

    def _motion_at(self, ahead: float, velocity: Array) -> Instant:
        """Return the motion a number of steps after (or before) the last one, at this velocity."""
        now, later = self._step.snapshot, ahead * self._step.dt
        return Instant(
            np.asarray(self._step.t + later),
            now.position + later * velocity[:, :2],
            now.angle + later * velocity[:, 2],
            velocity[:, :2],
            velocity[:, 2],
        )

    def _book_drift_events(self) -> Array:
        """Book the events within the last drift; return the velocities at its end: (n, 3)."""
        step = self._step
        if step.events and step.divided_drift:  # at the start of a drift with landings
            self._leave_foreseen_path(step.divided_drift)
            self._book_events(step.events)
            return self._book_divided_drift(step.divided_drift)
        if step.events:
            self._set_mid_drift(step.events.pre_kick_velocity, step.events.reading_shift)
            self._book_events(step.events)
            return step.events.pre_kick_velocity
        if step.slip_ends:
            return self._book_slip_ends(step.slip_ends)
        if step.divided_drift:
            return self._book_divided_drift(step.divided_drift)
        return self._book_impacts(step.impacts) if step.impacts else self._velocity

    def _coming_velocity(self) -> Array:
        """Return the velocities of the coming drift, or of its first part: (n, 3) [m/s, rad/s]."""
        direct = self._scene.direct
        if direct and direct.drifts.drift_after:
            return direct.drifts.drift_after.stages_before[-1].velocity
        return self._scene.batch.velocity()

    def _first_share(self) -> float:
        """Return the length of the first part of the coming drift, as a share of the drift."""
        divided = self._scene.direct and self._scene.direct.drifts.drift_after
        return divided.first_fraction if divided else 1.0

    def _book_divided_drift(self, divided: "DividedDrift") -> Array:
        """Book a drift in parts; return the velocities at its end, as of a whole drift: (n, 3).

        Its first kick may belong to the whole kick before it, and takes back the excess of that;
        its last kick belongs to the whole kick after it, for the same reason.
        """
        kicks = kicks_within(divided, self._end, self._last_kick, self._mechanics.inertia)
        for number, (kick, change, impulses, jacobian, contacts) in enumerate(kicks):
            if number or kick.length >= 0:
                self._attribution.begin()
            forces = self._joint_forces[0]._replace(tension=impulses, jacobian=jacobian)
            if kick.length >= 0:
                self._was_slack = forces.slack_before(*self._joint_forces)
                self._joint_forces = forces, self._joint_forces[0]
            self._attribution.book(self._step, kick, change, forces, contacts, self._was_slack)
        half = self._step.dt / 2
        self._set_mid_drift(divided.pre_kick_velocity, divided.excess_energy)
        middle = divided.end_pose - half * divided.pre_kick_velocity
        self._end = Instant.at(self._step.t - half, middle, divided.pre_kick_velocity)
        return divided.pre_kick_velocity

    def _book_impacts(self, collided: DriftImpacts) -> Array:
        """Book the impacts within the last drift; return the velocities at its end."""
        impacts = collided.impacts
        self._set_mid_drift(collided.pre_kick_velocity, collided.reading_shift)
        bodies, belt = sum(i.kinematic_work for i in impacts), sum(i.belt_work for i in impacts)
        self._entries.add_works({"bodies": bodies, "belt": belt})
        self._entries.add_friction(sum(impact.friction_work for impact in impacts))
        if not self._attribution.elastic:
            for impact in impacts:
                self._attribution.begin()
                self._entries.add_loss("impacts", impact.normal_work)
        for law, work in collided.law_works:
            self._entries.add_extra_work(law, work)
        momenta = (impact.momentum for impact in impacts)
        self._entries.add_support(sum(momenta, collided.extra_momentum))
        return collided.pre_kick_velocity

    def _book_slip_ends(self, stop: SlipEntries) -> Array:
        """Book the ends of slipping in the last drift; return the velocities at its end."""
        before = self._end
        self._set_mid_drift(stop.pre_kick_velocity, stop.reading_shift)
        for law in self._laws:
            wrench = np.zeros_like(self._scene.inertia)
            law.add(before, wrench)
            self._entries.add_law_work(law, float(np.sum(wrench * stop.extra_displacement)))
        self._entries.add_works(stop.belt_works)
        self._entries.add_friction(stop.friction_work)
        self._entries.add_support(stop.momentum)
        return stop.pre_kick_velocity

    def _book_events(self, happened: EventEntries) -> None:
        """Book the events in the last drift, and what forces do differently because of them."""
        self._entries.add_works({"events": happened.switching_energy, **happened.belt_works})
        self._entries.add_friction(happened.friction_work)
        support_impulse = happened.momentum
        for law, work, impulse in zip(self._laws, happened.works, happened.momenta, strict=True):
            self._entries.add_extra_work(law, work)
            if law.effect.name in self._entries.impulses:
                self._entries.impulses[law.effect.name] += impulse
            support_impulse = support_impulse - impulse
        self._entries.add_support(support_impulse)
        for jolt in happened.jolts:
            self._attribution.book_jolt(jolt)

    def _leave_foreseen_path(self, divided: "DividedDrift") -> None:
        """Leave the path foreseen for the last drift, since joints changed at its start."""
        dt = self._step.dt
        self._end = before_landings(self._end, divided, self._step.t - dt, dt)
        joint_pulls = pulls_of(self._scene.joints, len(self._scene.inertia))
        last, self._joint_forces = self._joint_forces[0], (joint_pulls, self._joint_forces[0])
        self._was_slack = joint_pulls.among(last.numbered(self._was_slack))

    def _set_mid_drift(self, kick_velocity: Array, energy_shift: float) -> None:
        """Set the motion in the middle of the last drift as if the drift had not been cut.

        The difference in energy there is attributed to the start of the books.
        """
        self._end = self._motion_at(-0.5, kick_velocity)
        energy, momentum_then = self._start
        self._start = energy + energy_shift, momentum_then

    def _book_overlap_correction(self, drifted: Array) -> None:
        """Add the energy from the correction of overlaps, which moved bodies after their drift."""
        if not len(self._step.contacts.bodies):
            return
        now, moved, end = self._step.snapshot, self._step.dt / 2 * drifted, self._end
        position, angle = end.position + moved[:, :2], end.angle + moved[:, 2]
        largest_move = np.abs(now.position - position).max()
        if largest_move > SEEN * (1 + np.abs(now.position).max()):
            potential = self._mechanics.potential
            corrected = end._replace(position=now.position, angle=now.angle)
            ended = end._replace(position=position, angle=angle)
            self._overlaps += potential(corrected) - potential(ended)

    def _book_matter_flows(self, t: float, before: Array, after: Array) -> None:
        """Book the energy and momentum of matter that bodies gain or lose."""
        flows = self._scene.mass_fraction
        if not isinstance(flows, MassFlows):
            return
        times = (t + h * self._step.dt for h in (-0.5, 0, 0.5))
        earlier, now, later = map(self._mechanics.inertia, times)
        gained = (later - now) * after + (now - earlier) * before
        energy = np.sum((later - now) * after * after + (now - earlier) * before * before, axis=1)
        energy = (
            energy / 2
            + self._mechanics.potential_change_by_mass(self._end, t)
            - self._mechanics.potential_change_by_mass(self._motion_at(0.5, after), t)
        )
        for name, bodies in flows.carriers().items():
            carried = np.zeros_like(gained)
            carried[bodies] = gained[bodies]
            self._entries.add_impulse(name, carried, self._step.snapshot.position)
            self._entries.works[name] += float(energy[bodies].sum())

    def _kick_contacts(self) -> Contacts:
        """Return the contacts of the kick, without the impacts that cut the drift before it."""
        return self._step.contacts.without_first(self._step.impact_count)
