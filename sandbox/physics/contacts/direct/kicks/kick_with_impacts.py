"""A whole kick: up to its step, the impacts there, and the rest of it."""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.kicks import coupled_impacts
from sandbox.physics.contacts.direct.kicks.kick_records import KickResult, Stage
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.solving.end_of_drift_impulses import hold
from sandbox.physics.contacts.direct.solving.warm_start import WarmStart
from sandbox.physics.joints.exact.constraint_interface import coordinate_indices


class KickStart(NamedTuple):
    """The state and the forces at the beginning of a kick; N bodies with the plane.

    `velocity`, (3 N,), are the velocities before it, and `change`, (3 N,), is their change in the
    step before it [m/s, rad/s]; `acceleration`, (3 N,), is that by gravity and force
    laws [m/s², rad/s²]. `lead` is the time from its beginning to its step, and `step` the time
    step [s]. `driven` tells whether running surfaces or kinematic bodies may add energy.
    """

    velocity: Array
    acceleration: Array
    change: Array
    lead: float
    step: float
    driven: bool


def solve_kick(
    kick: Kick, start: KickStart, warm_start: WarmStart, *, placed: bool = False
) -> KickResult:
    """Take a kick, whose length its joints know, and return the result.

    `warm_start` has the forces of the last kick. For `placed` see `hold`. Raises
    `JointFailure` or `NoForces` if no impulses are found.
    """
    velocity, acceleration, lead = start.velocity, start.acceleration, start.lead
    at_step, acts = velocity + acceleration * lead, acceleration * start.step

    def pushed() -> Array:
        return warm_start.guess(kick, at_step, start.step)[0]

    strikes = coupled_impacts.striking(kick, at_step, acts, start.change, pushed)
    if not (np.count_nonzero(strikes) or np.count_nonzero(kick.joints.added)):
        return _without_impacts(kick, start, velocity, kick.joints.kick, warm_start, placed=placed)
    indices = coordinate_indices(len(velocity) // 3 - 1)
    approach, before = coupled_impacts.approach_velocity(kick, at_step, strikes)
    left, pushes, _ = coupled_impacts.solve_impacts(kick, approach, strikes)
    rest = _without_impacts(kick, start, left, kick.joints.kick - lead, warm_start, placed=placed)
    stages = (
        Stage.of(kick, lead, approach[indices], before),
        Stage.of(kick, 0, left[indices], pushes),
        Stage.of(kick, rest.duration, rest.velocity[indices], rest.impulse),
    )
    record, total = coupled_impacts.outcome(kick, left, pushes), before + pushes + rest.impulse
    return rest._replace(impulse=total, impacts=record, stages=stages)


def _without_impacts(
    kick: Kick,
    start: KickStart,
    velocity: Array,
    duration: float,
    warm_start: WarmStart,
    *,
    placed: bool,
) -> KickResult:
    """Return a kick without impacts, or the rest of a kick after them, of length `duration` [s]."""
    motion = velocity + start.acceleration * duration
    guess = warm_start.guess(kick, motion, duration)
    solution = hold(kick, motion, guess, driven=start.driven, placed=placed)
    impulse, velocity_after, active, flat = solution
    slides = bool(np.count_nonzero(active.slip) or np.count_nonzero(guess[1].slip))
    forces, whole = impulse / duration, (impulse, None, ())
    return KickResult(
        kick, velocity_after, forces, active, *whole, velocity, duration, slides=slides, flat=flat
    )
