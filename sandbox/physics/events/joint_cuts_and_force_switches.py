"""Drifts with an event that changes the forces: a joint is cut, a force is switched.

Between two kicks, leapfrog represents a motion with the acceleration of the last kick: a parabola.
An event happens at its own time on that parabola. From there another parabola, with a different
acceleration, leads to the end of the drift.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from sandbox.model.events import Crossing
from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import NO_CONTACTS, Contacts
from sandbox.physics.events.slip_phases import Phase, friction_work_beyond
from sandbox.physics.forces.law import Law
from sandbox.physics.forces.spring import damps
from sandbox.physics.state.motion import Instant, momentum

if TYPE_CHECKING:
    from sandbox.physics.events.joint_impacts import Jolt

BISECTIONS = 60
"""A step halved this often is shorter than a float's rounding."""

NEAR = 1e-6
"""In this last share of a step no event happens: it waits for the next drift."""


NOTHING: Mapping[str, float] = MappingProxyType({})


class Part(NamedTuple):
    """A part of a drift in which the accelerations of n bodies are constant."""

    t: float
    """Its start time [s]."""
    duration: float
    """Its duration [s]."""
    pose: Array
    """(n, 3), the positions at its start [m, rad]."""
    velocity: Array
    """(n, 3), the velocities at its start [m/s, rad/s]."""
    acceleration: Array
    """(n, 3), the accelerations in it [m/s², rad/s²]."""
    force_delay: float = 0.0
    """The time after its start at which the forces that cause these act [s]."""
    forces: Contacts = NO_CONTACTS
    """The contacts, with forces in place of impulses."""

    @property
    def phase(self) -> Phase:
        """The same, for the work of friction."""
        return Phase(self.duration, self.pose, self.velocity, self.acceleration, self.forces)

    def at(self, time: float) -> Instant:
        """Return the motion at a time after its start [s]."""
        return Instant.at(self.t + time, *self.state(time))

    def state(self, time: float) -> tuple[Array, Array]:
        """Return positions and velocities at a time after its start [s]: (n, 3) each."""
        velocity = self.velocity + self.acceleration * time
        return self.pose + (self.velocity + velocity) * (time / 2), velocity


class EventEntries(NamedTuple):
    """The energy and momentum that an event within a drift adds to the books; n bodies.

    The books assume that the kick before the drift acts until its middle, and the kick after it
    from there on.
    """

    pre_kick_velocity: Array
    """(n, 3), the velocities at the beginning of the kick after the drift [m/s, rad/s]."""
    switching_energy: float
    """The jump of the stored energy when forces are switched [J]."""
    works: Sequence[float]
    """The work of each law beyond that of the halves of the two kicks; of a damped spring that of
    its damper alone [J]."""
    momenta: Sequence[Array]
    """The momentum and angular momentum from each law beyond those from the two halves: (3,) each
    [kg m/s, kg m²/s]."""
    momentum: Array
    """The same from all forces together: (3,)."""
    reading_shift: float
    """The change of the energy read in the middle of the drift that is only due to the change of
    acceleration [J]: on the parabola, the energy that a force F stores is higher by F a dt²/8 than
    in the middle of the chord."""
    jolts: "Sequence[Jolt]" = ()
    """The impacts of joints in the drift."""
    friction_work: float = 0.0
    """The work of friction beyond that in the halves of the two kicks [J]."""
    belt_works: Mapping[str, float] = NOTHING
    """The same of belts and kinematic bodies, by account [J]."""


def crosses(crossing: Crossing, before: float, now: float) -> bool:
    """Return whether a quantity has crossed a value; one that starts on the value has not.

    A crossing with direction "beyond" counts at once if the magnitude is already large enough.
    """
    if crossing.direction == "beyond":
        return abs(now) >= crossing.value
    rises, falls = before < crossing.value <= now, before > crossing.value >= now
    return {"up": rises, "down": falls, "either": rises or falls}[crossing.direction]


def within(value: Callable[[float], float], crossing: Crossing, duration: float) -> float:
    """Return the time until a quantity crosses a value, at most `duration` [s]."""

    def beyond(time: float) -> float:
        reading = value(time)
        return (abs(reading) if crossing.direction == "beyond" else reading) - crossing.value

    sign = np.sign(beyond(0.0))
    return first_time(lambda time: not sign * beyond(time) > 0, 0.0, duration)


def first_time(holds: Callable[[float], bool], low: float, high: float) -> float:
    """Return when a condition begins to hold, given a time before and a time after that [s]."""
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        if holds(middle):
            high = middle
        else:
            low = middle
    return high


def entries_of(
    parts: Sequence[Part],
    laws: Sequence[Law],
    inertia: Array,
    running: Array,
    switching_energy: float,
    dt: float,
) -> EventEntries:
    """Return the entries for the books from a drift of several parts, of length dt [s].

    One part lies before the first event, and one after each event. The works and impulses are those
    of `laws`; `inertia`, (n, 3), has masses, masses and moments [kg, kg m²], `running`, (n, 2), are
    the velocities of running surfaces [m/s], and `switching_energy` is the jump of the stored
    energy [J].
    """
    first, last, half = parts[0], parts[-1], dt / 2
    end, (pose, velocity) = last.at(last.duration), last.state(last.duration)
    pre_kick_velocity = velocity - last.acceleration * half
    before = last._replace(duration=half, pose=pose - velocity * half, velocity=pre_kick_velocity)
    full = (_Share(1.0, p, p.at(p.force_delay), p.at(p.duration / 2)) for p in parts)
    every = (
        *full,
        _Share(-1.0, first._replace(duration=half), first.at(0.0), first.at(0.0)),
        _Share(-1.0, before, last.at(last.force_delay), end),
    )

    def work(law: Law) -> float:
        return sum(share.work(law, inertia) for share in every)

    works = [work(law) - (work(replace(law, damping=0.0)) if damps(law) else 0.0) for law in laws]
    momenta = [sum((share.push(law, inertia) for share in every), np.zeros(3)) for law in laws]
    total = sum((share.total_momentum(inertia) for share in every), np.zeros(3))
    storing = [law for law in laws if law.effect.book == "potential"]

    def raised(part: Part) -> float:
        forces = (_wrench(law, part.at(part.force_delay), inertia) for law in storing)
        return float(np.sum(sum(forces, np.zeros_like(inertia)) * part.acceleration))

    shift = (raised(first) - raised(last)) * half * half / 2
    halves = first._replace(duration=half).phase, before.phase
    works_beyond = friction_work_beyond([part.phase for part in parts], halves, inertia, running)
    entries = EventEntries(pre_kick_velocity, switching_energy, works, momenta, total, shift)
    return entries._replace(friction_work=works_beyond[0], belt_works=works_beyond[1])


def entries_at_step(
    pre_kick_velocity: Array, laws: Sequence[Law], switching_energy: float
) -> EventEntries:
    """Return the entries for the books if all events happened at the step before a drift.

    `pre_kick_velocity`, (n, 3), are the velocities after the events [m/s, rad/s], and
    `switching_energy` is the jump of the stored energy [J]. No law has done any work yet.
    """
    nothing = np.zeros(3)
    works, momenta = [0.0] * len(laws), [nothing] * len(laws)
    return EventEntries(pre_kick_velocity, switching_energy, works, momenta, nothing, 0.0)


class _Share(NamedTuple):
    """A part of a drift (sign 1), or half of a kick that the books already contain (sign −1).

    The impulse is that of the force that causes the parabola, and so is the work, on all of the
    path; the impulse acts at the middle. For the half kick before the drift both are taken where
    the kick acted, as the books did.
    """

    sign: float
    part: Part
    force_motion: Instant
    middle: Instant

    def work(self, law: Law, inertia: Array) -> float:
        """Return the work of a law [J]."""
        part = self.part
        displacement = part.velocity * part.duration + part.acceleration * (part.duration**2 / 2)
        return self.sign * float(np.sum(_wrench(law, self.force_motion, inertia) * displacement))

    def push(self, law: Law, inertia: Array) -> Array:
        """Return the momentum and angular momentum from a law: (3,)."""
        return self._about(_wrench(law, self.force_motion, inertia))

    def total_momentum(self, inertia: Array) -> Array:
        """Return the momentum and angular momentum from all forces together: (3,)."""
        return self._about(inertia * self.part.acceleration)

    def _about(self, wrench: Array) -> Array:
        return self.sign * momentum(wrench * self.part.duration, self.middle.position)


def _wrench(law: Law, motion: Instant, inertia: Array) -> Array:
    """Return the forces and torques of a law on the movable bodies: (n, 3) [N, N m]."""
    wrench = np.zeros_like(inertia)
    law.add(motion, wrench)
    return np.where(inertia > 0, wrench, 0.0)


def stored_energy(laws: Sequence[Law], motion: Instant) -> float:
    """Return the potential energy that laws store [J]."""
    stores = (law for law in laws if law.effect.book == "potential")
    return sum(float(law.potential_energy(motion).sum()) for law in stores)
