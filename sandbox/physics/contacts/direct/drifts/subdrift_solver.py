"""Solves a subdrift, a part of a drift, for a chosen length, and its motion up to its end."""

from dataclasses import replace

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import Active
from sandbox.physics.contacts.direct.drifts.first_contact_or_edge import SOON
from sandbox.physics.contacts.direct.drifts.subdrift_records import Subdrift, others_of
from sandbox.physics.contacts.direct.kicks import coupled_impacts
from sandbox.physics.contacts.direct.kicks.kick_records import Stage
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.solving.end_of_drift_impulses import hold
from sandbox.physics.contacts.direct.solving.warm_start import recalled
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.joints.exact.constraint_interface import coordinate_indices
from sandbox.physics.state.simulation_errors import JointFailure, NoForces

BRIEF = 1e-3
"""If no forces are found for less than this share of a part, those of the whole part are used: over
so short a time, rounding of gaps may require velocities that contradict each other."""

SHORT = 0.1
"""If the last part is shorter than this share of the drift, the forces that continue in the next
step are solved again, as for a whole drift. In a short part they follow from small differences of
positions, which rounding spoils."""


class SubdriftSolver:
    """Solves parts of a drift; N bodies with the plane.

    `laws`, (3 N,), are the accelerations by gravity and force laws [m/s², rad/s²]; the drift ends
    at the time `until` [s]. `driven` tells whether running surfaces or kinematic bodies may add
    energy. `reached`, (n,), tells which bodies take part in landings, and so are solved in parts.
    All others keep their motion and forces.
    """

    def __init__(self, laws: Array, until: float, *, driven: bool) -> None:
        self._laws, self._until, self._driven = laws, until, driven
        count = len(laws) // 3 - 1
        self._indices = coordinate_indices(count)
        self.reached: Booleans = np.zeros(count, dtype=bool)

    def _solved(self, part: Subdrift, drift: float, duration: float) -> Subdrift:
        """Return a part solved for given lengths of its drift and of its kick [s]."""
        joints, start = part.kick.joints, self._until - part.time_left
        joints.time(drift, drift)
        kick = part.kick.before_drift(joints.kept_lengths(start, start + drift))
        mine, _, drive = others_of(part, self._laws, self.reached)
        motion = part.start_velocity + duration * drive
        part = part._replace(kick=kick, drift=drift, kick_duration=duration, velocity=motion)
        if not mine.any():
            return part
        slips = mine[kick.layout.slips]
        some = replace(kick, layout=kick.layout.around(mine))
        guess = Active(part.active.on & mine, np.where(slips, part.active.slip, 0))
        impulse, velocity, active, flat = hold(
            some, motion, (np.where(mine, part.forces * duration, 0.0), guess), driven=self._driven
        )
        leaning = some.with_tilt_friction(velocity, impulse)
        if leaning is not None:
            found = impulse, active
            impulse, velocity, active, flat = hold(leaning, motion, found, driven=self._driven)
            kick = replace(leaning, layout=kick.layout)
        return part._replace(
            kick=kick,
            forces=np.where(mine, impulse / duration, part.forces),
            active=Active(
                np.where(mine, active.on, part.active.on),
                np.where(slips, active.slip, part.active.slip),
            ),
            velocity=velocity,
            flat=flat,
        )

    def _again(self, part: Subdrift, kick: Kick) -> Subdrift:
        """Return a part, solved with more rows."""
        forces, active = recalled(part.kick, part.forces, part.active, kick)
        more = part._replace(kick=kick, forces=forces, active=active)
        return self._solved(more, part.drift, part.kick_duration)

    def _lasting(self, last: Subdrift, drift: float) -> Subdrift:
        """Return the last part with forces that last for a whole drift [s].

        If other rows would be active then, it keeps its own forces.
        """
        if last.drift >= SHORT * drift:
            return last
        try:
            longer = self._solved(last, drift, drift / 2)
        except (JointFailure, NoForces):
            return last
        return (
            last._replace(continuing_forces=longer.forces)
            if longer.active.equals(last.active)
            else last
        )

    def _shortened(self, part: Subdrift, drift: float, near: Subdrift) -> Subdrift:
        """Return a part with a shorter drift [s]; Newton's method begins with a similar part."""
        duration = part.kick_duration - (part.drift - drift) / 2
        if drift >= SOON * part.drift:
            similar = part._replace(forces=near.forces, active=near.active)
            try:
                return self._solved(similar, drift, duration)
            except NoForces:
                if drift > BRIEF * part.drift:
                    raise
        velocity = part.start_velocity + duration * (self._laws + part.constraint_acceleration)
        return part._replace(drift=drift, kick_duration=duration, velocity=velocity)

    def _arrived(
        self, part: Subdrift, struck: Booleans, catching: Booleans | None = None
    ) -> tuple[Kick, Array, tuple[Stage, ...]]:
        """Return the end of a part, before any impact.

        These are the rows of the bodies that are `reached`, the velocities, and the stage up to
        there; see `DriftCutter._struck`.
        """
        mine, others, drive = others_of(part, self._laws, self.reached)
        some = replace(part.kick, layout=part.kick.layout.around(mine))
        half = part.drift / 2
        motion = part.velocity + half * drive
        approach, to_it = coupled_impacts.approach_velocity(
            some, motion, struck, part.active, catching
        )
        return (
            some,
            approach,
            (Stage.of(part.kick, half, approach[self._indices], to_it + half * others),),
        )
