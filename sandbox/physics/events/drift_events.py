"""Drifts with an event that changes what acts: a joint is cut, a force is switched.

Between two kicks leapfrog stands for a motion with the acceleration of the last kick: a parabola.
An event happens at its own time on that parabola. From there another parabola, with another
acceleration, leads to the end of the drift.
"""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from sandbox.model.acting_events import Crossing
from sandbox.model.expressions import Array
from sandbox.physics.forces.law import Law
from sandbox.physics.state.motion import Instant, momentum

if TYPE_CHECKING:
    from sandbox.physics.events.joint_impacts import Jolt

BISECTIONS = 60
"""A step halved this often is shorter than a float's rounding."""

NEAR = 1e-6
"""The share of a step before its end in which no event happens: it waits for the next drift."""


class Part(NamedTuple):
    """A part of a drift in which the accelerations of n bodies stay as they are.

    Attributes
    ----------
    t, lasts
        When it begins, and how long it is [s].
    place, velocity
        (n, 3), at its beginning [m, rad, m/s, rad/s].
    acceleration, smooth
        (n, 3), in it: all of it, and what gravity and force laws give [m/s², rad/s²].
    """

    t: float
    lasts: float
    place: Array
    velocity: Array
    acceleration: Array
    smooth: Array

    def at(self, time: float) -> Instant:
        """Return the motion some time after its beginning [s]."""
        return Instant.at(self.t + time, *self.state(time))

    def state(self, time: float) -> tuple[Array, Array]:
        """Return positions and velocities some time after its beginning [s]: (n, 3) each."""
        velocity = self.velocity + self.acceleration * time
        return self.place + (self.velocity + velocity) * (time / 2), velocity


class Acted(NamedTuple):
    """What the books must know of an event within a drift, for n bodies.

    They take the kick before the drift to go on for half of it, and that after it to begin there.

    Attributes
    ----------
    begun
        (n, 3), the velocities that the kick after the drift begins with [m/s, rad/s].
    switched
        The energy that is stored at once, or gone, as forces are switched [J].
    worked
        Of each law, the work beyond that of the halves of the two kicks [J].
    pushed
        Of each law, the momentum, and the angular momentum, beyond what the halves give: (3,) each
        [kg m/s, kg m²/s].
    given
        The same of all together: (3,).
    lifted
        How much more energy there is in the middle of the drift for nothing but another
        acceleration [J]: along a parabola there is a force's F a dt²/8 more than in the middle of
        the chord.
    jolts
        The impacts of joints in it.
    """

    begun: Array
    switched: float
    worked: Sequence[float]
    pushed: Sequence[Array]
    given: Array
    lifted: float
    jolts: "Sequence[Jolt]" = ()


def crosses(crossing: Crossing, before: float, now: float) -> bool:
    """Return whether a quantity has crossed a value; one that begins there has not.

    One that waits for a size is there at once if it begins beyond.
    """
    if crossing.direction == "beyond":
        return abs(now) >= crossing.value
    rises, falls = before < crossing.value <= now, before > crossing.value >= now
    return {"up": rises, "down": falls, "either": rises or falls}[crossing.direction]


def within(value: Callable[[float], float], crossing: Crossing, lasts: float) -> float:
    """Return how long it takes a quantity to cross a value, in less than `lasts` [s]."""

    def beyond(time: float) -> float:
        reading = value(time)
        return (abs(reading) if crossing.direction == "beyond" else reading) - crossing.value

    sign = np.sign(beyond(0.0))
    return since(lambda time: not sign * beyond(time) > 0, 0.0, lasts)


def since(holds: Callable[[float], bool], low: float, high: float) -> float:
    """Return from when on something holds that does not at one time, and does at another [s]."""
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        if holds(middle):
            high = middle
        else:
            low = middle
    return high


def acted(
    parts: Sequence[Part], laws: Sequence[Law], inertia: Array, switched: float, dt: float
) -> Acted:
    """Return what books must know of a drift of several parts.

    Parameters
    ----------
    parts
        One before the first of what happened, and one after each.
    laws
        The laws whose works and impulses are recorded.
    inertia
        (n, 3), masses, masses and moments [kg, kg m²].
    switched
        The energy that is stored at once, or gone [J].
    dt
        How long the drift is [s].
    """
    first, last, half = parts[0], parts[-1], dt / 2
    end, (place, velocity) = last.at(last.lasts), last.state(last.lasts)
    begun = velocity - last.acceleration * half
    before = last._replace(lasts=half, place=place - velocity * half, velocity=begun)
    every = (
        *(_Share(1.0, part, part.at(0.0), part.at(part.lasts / 2)) for part in parts),
        _Share(-1.0, first._replace(lasts=half), first.at(0.0), first.at(0.0)),
        _Share(-1.0, before, end, end),
    )
    worked = [sum(share.work(law, inertia) for share in every) for law in laws]
    pushed = [sum((share.push(law, inertia) for share in every), np.zeros(3)) for law in laws]
    given = sum((share.given(inertia) for share in every), np.zeros(3))
    pull = first.smooth * first.acceleration - last.smooth * last.acceleration
    lifted = float(np.sum(inertia * pull)) * half * half / 2
    return Acted(begun, switched, worked, pushed, given, lifted)


def acted_at_a_step(begun: Array, laws: Sequence[Law], switched: float) -> Acted:
    """Return the same where all of it happened at the step that a drift begins with.

    Parameters
    ----------
    begun
        (n, 3), the velocities after it [m/s, rad/s].
    laws
        None of them has worked by then.
    switched
        The energy that is stored at once, or gone [J].
    """
    nothing = np.zeros(3)
    return Acted(begun, switched, [0.0] * len(laws), [nothing] * len(laws), nothing, 0.0)


class _Share(NamedTuple):
    """A part of a drift, or half of a kick that books have counted already and that is taken off.

    The impulse is that of the force at its beginning, which makes the parabola, about the middle of
    the way; of what is taken off, the books have seen all where the kick was.
    """

    sign: float
    part: Part
    start: Instant
    middle: Instant

    def work(self, law: Law, inertia: Array) -> float:
        """Return the work of a law [J]."""
        part = self.part
        way = part.velocity * part.lasts + part.acceleration * (part.lasts**2 / 2)
        return self.sign * float(np.sum(_wrench(law, self.middle, inertia) * way))

    def push(self, law: Law, inertia: Array) -> Array:
        """Return the momentum, and the angular momentum, that a law gives: (3,)."""
        return self._about(_wrench(law, self.start, inertia))

    def given(self, inertia: Array) -> Array:
        """Return those that all together give: (3,)."""
        return self._about(inertia * self.part.acceleration)

    def _about(self, wrench: Array) -> Array:
        return self.sign * momentum(wrench * self.part.lasts, self.middle.position)


def _wrench(law: Law, motion: Instant, inertia: Array) -> Array:
    """Return the force and torque of a law on what they move: (n, 3) [N, N m]."""
    wrench = np.zeros_like(inertia)
    law.add(motion, wrench)
    return np.where(inertia > 0, wrench, 0.0)


def stored(laws: Sequence[Law], motion: Instant) -> float:
    """Return what laws store [J]."""
    stores = (law for law in laws if law.effect.book == "potential")
    return sum(float(law.potential_energy(motion).sum()) for law in stores)
