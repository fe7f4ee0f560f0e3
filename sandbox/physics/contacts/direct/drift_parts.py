"""The parts of a drift that is cut where bodies land, and what others see of them."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.constraint_rows import Active
from sandbox.physics.contacts.direct.drift_subdivision import Between, Divided
from sandbox.physics.contacts.direct.kick_parts import Stage, Taken
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

    @classmethod
    def after(cls, taken: Taken, drift: float, moved: Array) -> "Part":
        """Return the whole drift after a kick, so long [s], with velocities (3 N,)."""
        begun, lasts, forces, active = taken.begun, taken.lasts, taken.forces, taken.active
        before = taken.stages[:-1]
        return cls(taken.kick, drift, drift, begun, lasts, forces, active, moved, before)

    @property
    def pulls(self) -> Array:
        """(3 N,), what joints and contacts give [m/s², rad/s²]."""
        return np.asarray(self.forces @ self.kick.response)

    @property
    def end(self) -> Coordinates:
        """Where it ends."""
        return Coordinates(self.kick.place.values + self.drift * self.moved)


def concerned(kick: Kick, reached: Booleans) -> Booleans:
    """Return which rows of a kick have to do with some of the bodies, (n,): (r,)."""
    columns = order(len(reached))[reached].ravel()
    return np.asarray((kick.response[:, columns] != 0).any(axis=1))


@dataclass(frozen=True)
class Landed:
    """A drift that was cut where bodies landed, as others see it; n bodies.

    The kicks before and after it are whole ones, the one as if nothing landed, the other with the
    forces of its last part. What they give too much is taken back at its two ends. What has nothing
    to do with the landings goes on as it did, and is given nothing between the two.

    Parameters
    ----------
    whole, parts
        The drift as if nothing landed, and its parts.
    laws
        (3 N,), the accelerations by gravity and force laws [m/s², rad/s²].
    reached
        (n,), which bodies have to do with the landings.
    start
        (n, 3), where bodies are at its start [m, rad].
    """

    whole: Part
    parts: Sequence[Part]
    laws: Array
    reached: Booleans
    start: Array

    @cached_property
    def divided(self) -> Divided:
        """Its parts, as others see them."""
        whole, led, lasts = self.whole, self._led, self.whole.lasts
        left = self._moving((led.begun + lasts * (self.laws + led.pulls))[self._places])
        lead = Stage.of(led.kick, lasts, left, lasts * led.forces)
        kept, back = self._taken_back()
        stages = [(part.kick, stage) for part in self.parts[1:] for stage in self._stages(part)]
        between = (self.parts[0].kick, self._given_less()), *stages, (kept, back)
        return Divided(
            left,
            back.velocity,
            self.reached,
            (*whole.before, lead),
            tuple(self._seen(kick, stage) for kick, stage in between),
            1.0,
            self._place(self.parts[-1].end),
            self._lifted,
        )

    @property
    def onwards(self) -> Array:
        """(n, 3), the accelerations at its end [m/s², rad/s²]."""
        last = self.parts[-1]
        return np.asarray((self.laws + last.forces @ self._ended.response)[self._places])

    @cached_property
    def _places(self) -> Integers:
        return order(len(self.start))

    @cached_property
    def _ended(self) -> Kick:
        """The rows of the last part at its end."""
        last = self.parts[-1]
        return last.kick.moved(last.end)

    @property
    def _led(self) -> Part:
        """What leads into it: the whole drift, or the first part with what it does not catch."""
        first = self.parts[0]
        return first if _catches(self.whole, first) else self.whole

    @property
    def _lifted(self) -> float:
        """How much more energy is read in the middle of it, see `Divided` [J]."""
        inertia = inertia_of(self.whole.kick.joints.inverse)[self._places]
        mass = np.where(self.reached[:, None], inertia, 0.0)
        bent = (self._led.pulls - self.parts[-1].pulls)[self._places]
        return float(np.sum(mass * self.laws[self._places] * bent)) * self.whole.drift**2 / 8

    def _given_less(self) -> Stage:
        """Return by how much the kick before it differs from a whole one."""
        first, lasts = self.parts[0], self.whole.lasts
        less = first.forces * first.lasts - lasts * self._led.forces
        return Stage.of(first.kick, first.lasts - lasts, first.moved[self._places], less)

    def _taken_back(self) -> tuple[Kick, Stage]:
        """Return what the whole kick after it gives too much, and the rows of that."""
        last, kick = self.parts[-1], self._ended
        missing = (self.whole.drift - last.drift) / 2
        forces = _steady(last, self.laws, missing, self.reached)
        begun = last.moved - missing * (self.laws + forces @ kick.response)
        return kick, Stage.of(kick, -missing, self._moving(begun[self._places]), -missing * forces)

    def _stages(self, part: Part) -> tuple[Stage, ...]:
        """Return what happened at the beginning of a part."""
        rest = part.forces * part.lasts
        return *part.before, Stage.of(part.kick, part.lasts, part.moved[self._places], rest)

    def _seen(self, kick: Kick, stage: Stage) -> Between:
        """Return a stage as others see it."""
        joints = kick.layout.joints
        some = stage.among(self.reached, concerned(kick, self.reached)[joints])
        jacobian = -kick.here.jacobian[joints][:, self._places]
        moving = some._replace(velocity=self._moving(stage.velocity))
        return Between(self._place(kick.place), jacobian, moving)

    def _moving(self, velocity: Array) -> Array:
        """Return velocities, (n, 3), but those of the whole drift for what lands nowhere."""
        return np.where(self.reached[:, None], velocity, self.whole.moved[self._places])

    def _place(self, there: Coordinates) -> Array:
        """Return where bodies are: (n, 3) [m, rad]."""
        way = there.values - self.whole.kick.place.values
        return self.start + way[self._places]


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
