"""The parts of a drift that is cut where bodies land, and what others see of them."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.constraint_rows import Active
from sandbox.physics.contacts.direct.drift_subdivision import Between, Divided
from sandbox.physics.contacts.direct.kick_parts import Stage
from sandbox.physics.contacts.direct.kick_system import Kick
from sandbox.physics.engine.batch import Booleans, Integers
from sandbox.physics.joints.exact.constraints import GROWS, Coordinates, inertia_of, order


class Part(NamedTuple):
    """A part of a drift, and the kick before it; r rows, N bodies with the plane.

    Attributes
    ----------
    kick
        Its rows.
    left, drift
        How long there is until the end of the whole drift, and how long the part is [s].
    begun
        (3 N,), the velocities after the impacts at its beginning [m/s, rad/s].
    lasts
        How long the kick goes on from there [s].
    forces
        (r,), in that [N].
    active
        Which rows hold.
    moved
        (3 N,), the velocities in it [m/s, rad/s].
    before
        What happened at its beginning before that.
    """

    kick: Kick
    left: float
    drift: float
    begun: Array
    lasts: float
    forces: Array
    active: Active
    moved: Array
    before: tuple[Stage, ...] = ()

    @property
    def pulls(self) -> Array:
        """(3 N,), what joints and contacts give [m/s², rad/s²]."""
        return np.asarray(self.forces @ self.kick.response)

    @property
    def end(self) -> Coordinates:
        """Where it ends."""
        return Coordinates(self.kick.place.values + self.drift * self.moved)

    def stages(self, places: Integers) -> tuple[Stage, ...]:
        """Return what happened at its beginning; the coordinates of each body are at (n, 3)."""
        rest = Stage.of(self.kick, self.lasts, self.moved[places], self.forces * self.lasts)
        return *self.before, rest


def concerned(kick: Kick, reached: Booleans) -> Booleans:
    """Return which rows of a kick have to do with some of the bodies, (n,): (r,)."""
    columns = order(len(reached))[reached].ravel()
    return np.asarray((kick.response[:, columns] != 0).any(axis=1))


class Landed(NamedTuple):
    """A drift in which bodies have landed; n bodies.

    Attributes
    ----------
    divided
        Its parts, as others see them.
    pushed
        (n,), the sizes of the impulses on each body, added up [N s].
    onwards
        (n, 3), the accelerations at its end [m/s², rad/s²].
    """

    divided: Divided
    pushed: Array
    onwards: Array

    @classmethod
    def of(
        cls,
        whole: Part,
        parts: Sequence[Part],
        laws: Array,
        reached: Booleans,
        pushed: Array,
        start: Array,
    ) -> "Landed":
        """Return it.

        The kicks before and after it are whole ones, the one as if nothing landed, the other with
        the forces of its last part. What they give too much is taken back at its two ends. What has
        nothing to do with the landings goes on as it did, and is given nothing between the two.

        Parameters
        ----------
        whole, parts
            The drift as if nothing landed, and its parts.
        laws
            (3 N,), the accelerations by gravity and force laws [m/s², rad/s²].
        reached
            (n,), which bodies have to do with the landings.
        pushed
            See above.
        start
            (n, 3), where bodies are at its start [m, rad].
        """
        places, first, last = order(len(start)), parts[0], parts[-1]
        origin, missing = whole.kick.place.values, (whole.drift - last.drift) / 2

        def seen(kick: Kick, stage: Stage) -> Between:
            jacobian = -kick.here.jacobian[kick.layout.joints][:, places]
            some = stage.among(reached, concerned(kick, reached)[kick.layout.joints])
            some = some._replace(velocity=moving(stage.velocity))
            return Between(start + (kick.place.values - origin)[places], jacobian, some)

        def moving(velocity: Array) -> Array:
            return np.where(reached[:, None], velocity, whole.moved[places])

        led = first if _catches(whole, first) else whole
        left = moving((led.begun + whole.lasts * (laws + led.pulls))[places])
        given = whole.lasts * led.forces
        less = first.forces * first.lasts - given
        lead = Stage.of(first.kick, first.lasts - whole.lasts, first.moved[places], less)
        stages = [(part.kick, stage) for part in parts[1:] for stage in part.stages(places)]
        ended = last.kick.moved(last.end)
        forces = _steady(last, laws, missing, reached)
        onwards = (laws + last.forces @ ended.response)[places]
        begun = last.moved - missing * (laws + forces @ ended.response)
        begun = moving(begun[places])
        back = Stage.of(ended, -missing, begun, -missing * forces)
        between = tuple(seen(*one) for one in ((first.kick, lead), *stages, (ended, back)))
        mass = np.where(reached[:, None], inertia_of(whole.kick.joints.inverse)[places], 0.0)
        bent = (led.pulls - last.pulls)[places]
        lifted = float(np.sum(mass * laws[places] * bent)) * whole.drift**2 / 8
        end = start + (last.end.values - origin)[places]
        before = *whole.before, Stage.of(led.kick, whole.lasts, left, given)
        divided = Divided(left, begun, reached, before, between, 1.0, end, lifted)
        return cls(divided, pushed, onwards)


def _catches(whole: Part, first: Part) -> bool:
    """Return whether a rope is caught in a drift, but not before the first landing in it."""
    joints = whole.kick.layout.joints
    taut, pulls = (part.forces[joints] > 0 for part in (whole, first))
    return bool((whole.kick.joints.pulls_only & taut & ~pulls).any())


def _steady(last: Part, laws: Array, missing: float, reached: Booleans) -> Array:
    """Return the forces of the last part that may stand for those of a whole kick after it: (r,).

    Those of what jams do not last, and would give energy so long before it [s].
    """
    kinetic, before = last.kick.joints.kinetic, last.moved - missing * (laws + last.pulls)
    if kinetic(before) <= GROWS * kinetic(last.moved):
        return last.forces
    return np.where(concerned(last.kick, reached), 0.0, last.forces)
