"""One-sided joints that catch within a drift: ropes that become taut, stops that are reached.

Until then such a joint does not act. When it catches, one impact with all other joints and contacts
stops what would go on beyond its bound; from there on it may pull. If it acted only in the kick
before the drift, where directions are different, its impulse would be wrong.
"""

from dataclasses import replace
from functools import partial
from math import inf

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.drifts.first_meeting import SOON
from sandbox.physics.contacts.direct.drifts.landing_time_refinement import REFINED, Shortened
from sandbox.physics.contacts.direct.drifts.subdrifts import Subdrift
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.geometry.root_finding import SecantMethod, root
from sandbox.physics.joints.exact.constraint_interface import Coordinates
from sandbox.physics.joints.exact.shake import ExactJoints

EXACT = 1e-13
"""The time of a catch, and the one for which the kick is solved, must agree within this share of a
drift."""

CLOSE = 1e-15
"""m or rad: a joint catches at this distance from its bound. The rest of the drift, which may be
short, makes up for it, so it is no more than rounding."""


class Pulls:
    """Remembers which one-sided joints pull; `begins` tells whether one began to in this kick."""

    def __init__(self) -> None:
        self._known: Booleans = np.zeros(0, dtype=bool)
        self.begins = False

    def note(self, joints: ExactJoints) -> None:
        """Note the forces of the joints in a kick."""
        pulls, last_pulls = joints.pulls_only & (joints.tension > 0), self._known
        new = pulls & ~last_pulls if len(last_pulls) == len(pulls) else pulls
        self.begins, self._known = bool(np.count_nonzero(new)), pulls


def caught(part: Subdrift) -> Booleans:
    """Return which one-sided joints catch within a part of a drift: (m,)."""
    return np.asarray(part.kick.slack & part.active.on[part.kick.layout.joints])


def loose(part: Subdrift) -> Subdrift:
    """Return a part in which one-sided joints that are slack at its start do not act."""
    kick, layout, active = part.kick, part.kick.layout, part.active
    acts = np.ones(len(part.forces), dtype=bool)
    acts[layout.joints] = ~kick.slack
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

    rows = np.flatnonzero(part.kick.slack & (gaps(longest) < 0))
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
