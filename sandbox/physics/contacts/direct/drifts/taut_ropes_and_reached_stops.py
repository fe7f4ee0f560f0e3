"""One-sided joints that catch within a drift: ropes that become taut, stops that are reached.

Until then such a joint does not act. When it catches, one impact with all other joints and contacts
stops what would go on beyond its bound; from there on it may pull. If it acted only in the kick
before the drift, where directions are different, its impulse would be wrong.

What meets a stop with a restitution rebounds in that impact by Newton's law, J v' = −e J v, unless
it would be back within a step: then it rests. Where stops that rebound are solved by themselves,
see `events/elastic_stops.py`.
"""

from dataclasses import replace
from functools import partial
from math import inf

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.translatable_message import Message
from sandbox.physics.contacts.direct.drifts.first_contact_or_edge import SOON
from sandbox.physics.contacts.direct.drifts.landing_time_refinement import REFINED, Shortened
from sandbox.physics.contacts.direct.drifts.subdrift_records import Subdrift
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.geometry.root_finding import SecantMethod, root
from sandbox.physics.joints.exact.constraint_interface import Coordinates
from sandbox.physics.joints.exact.shake import ExactJoints
from sandbox.physics.state.simulation_errors import JointFailure

EXACT = 1e-13
"""The time of a catch, and the one for which the kick is solved, must agree within this share of a
drift."""

CLOSE = 1e-15
"""m or rad: a joint catches at this distance from its bound. The rest of the drift, which may be
short, makes up for it, so it is no more than rounding."""


OFTEN = Message(
    "stops are met too often in a step to be followed, such as '{name}'; reduce their"
    " 'restitution', or give what they hold more room",
)


class Pulls:
    """Remembers which one-sided joints pull; `begins` tells whether one began to in this kick."""

    def __init__(self) -> None:
        self._known: Booleans = np.zeros(0, dtype=bool)
        self.begins = False

    def note(self, joints: ExactJoints) -> None:
        """Note the forces of the joints in a kick."""
        pulls, last_pulls = joints.pulls_only & (joints.tension > 0), self._known
        new = pulls & ~last_pulls if len(last_pulls) == len(pulls) else pulls
        if joints.rebounds:  # a stop may be met again in the next drift
            new = pulls
        self.begins, self._known = bool(np.count_nonzero(new)), pulls


def caught(part: Subdrift, laws: Array) -> Booleans:
    """Return which one-sided joints catch within a part of a drift: (m,); see `catch_time`."""
    return np.asarray(not_reached(part, laws) & part.active.on[part.kick.layout.joints])


def not_reached(part: Subdrift, laws: Array) -> Booleans:
    """Return which one-sided joints do not act at the start of a part: (m,); see `catch_time`.

    They are slack, or are stops that are touched there, but have not been met: they close faster
    than forces within the part could cause.
    """
    kick, slack = part.kick, part.kick.slack
    if not kick.joints.rebounds:
        return slack
    speed, pressed = _approach(part, part.start_velocity, laws)
    least = np.abs(pressed) * part.kick_duration + kick.velocity_rounding
    return np.asarray(slack | ((kick.joints.restitution > 0) & (speed > least)))


def restitution(
    part: Subdrift, approach: Array, catching: Booleans, laws: Array, step: float
) -> Array | None:
    """Return the coefficients of restitution in an impact, (m,); None if no joint rebounds.

    It is 0 of joints that are not `catching`, (m,), and where a body would return within a
    `step` [s]. `approach`, (3 N,), are the velocities before the impact [m/s, rad/s]; for `laws`
    see `catch_time`.
    """
    joints = part.kick.joints
    if not joints.rebounds:
        return None
    e = joints.restitution
    speed, pressed = _approach(part, approach, laws + part.constraint_acceleration)
    return np.where(catching & (2 * e * speed > pressed * step), e, 0.0)


def _approach(part: Subdrift, velocity: Array, acceleration: Array) -> tuple[Array, Array]:
    """Return the rates and accelerations at which joints approach their bounds: (m,) each.

    They follow from velocities and accelerations, (3 N,), at the start of a part.
    """
    kick, at, ahead = part.kick, part.kick.layout.joints, part.time_left
    jacobian = kick.rows_at_start.jacobian[at]
    turned = kick.rows(ahead * velocity).jacobian[at] - jacobian
    pressed = -jacobian @ acceleration - turned @ velocity / ahead
    return -jacobian @ velocity, pressed


def refuse_more(part: Subdrift, catches: Booleans) -> None:
    """Raise a `JointFailure` if a stop that rebounds is among those that catch: (m,)."""
    joints = part.kick.joints
    met = np.flatnonzero(catches & (joints.restitution > 0))
    if len(met):
        name = joints.names[met[0]]
        raise JointFailure(name, OFTEN.filled(name=name))


def loose(part: Subdrift, laws: Array) -> Subdrift:
    """Return a part without the one-sided joints that do not act at its start."""
    kick, layout, active = part.kick, part.kick.layout, part.active
    acts = np.ones(len(part.forces), dtype=bool)
    acts[layout.joints] = ~not_reached(part, laws)
    problem = layout.problem._replace(pushes=layout.problem.pushes & acts)
    return part._replace(
        kick=replace(kick, layout=layout.asking(problem)),
        forces=np.where(acts, part.forces, 0.0),
        active=active._replace(on=active.on & acts),
    )


def catch_time(part: Subdrift, laws: Array, until: float, longest: float) -> float:
    """Return when the first slack joint catches on the parabolas of a part [s]; inf if none does.

    `laws`, (3 N,), are the accelerations by gravity and force laws [m/s², rad/s²]. The whole drift
    ends at the time `until`; of this one, a time `longest` is searched [s].
    """
    joints, pose, start = part.kick.joints, part.kick.pose.values, until - part.time_left
    total = laws + part.constraint_acceleration
    velocity = part.velocity - total * (part.drift / 2)

    def gaps(t: float) -> Array:
        rows = joints.equations.evaluate_without_memory(
            Coordinates(pose + t * (velocity + total * (t / 2)))
        )
        return np.asarray(joints.lengths(start + t) - rows.total)

    def gap(row: int, t: float) -> float:
        return float(gaps(t)[row])

    rows = np.flatnonzero(not_reached(part, laws) & (gaps(longest) < 0))
    times = (root(partial(gap, row), longest, CLOSE) for row in rows.tolist())
    first = min(times, default=inf)
    return first if first <= longest * (1 - SOON) else inf


def until_caught(
    part: Subdrift, time: float, laws: Array, until: float, shortened: Shortened
) -> Subdrift:
    """Return a part up to where its first joint catches, at about a time [s].

    `part` is loose; for the other parameters see `catch_time`. The time depends on the length for
    which the part is solved, as in `landing_time_refinement`.
    """
    shorter, times = part, SecantMethod(part.drift, (part.drift, time))
    for _ in range(REFINED):
        shorter = shortened(part, time, shorter)
        again = catch_time(shorter, laws, until, part.drift)
        if again == inf or abs(again - time) <= EXACT * part.drift:
            break
        time = times.following(time, again)
    return shorter
