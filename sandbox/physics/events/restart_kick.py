"""The kick after which bodies go on from an event within a step.

The bodies are held where they are and kicked by pymunk's solver and the joints together, as before
the first step. In a kick that is short enough, a slipping contact keeps slipping. A contact whose
slip has ended is held by friction if friction is strong enough; otherwise it slips the other way.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.post_impact_velocity import NEGLIGIBLE, rates_apart, touching
from sandbox.physics.contacts.static_friction import Memory
from sandbox.physics.engine.batch import Contacts, Integers
from sandbox.physics.events.slip_phases import Slips
from sandbox.physics.geometry.distance import surfaces
from sandbox.physics.scene.scene import Scene

TRIES = 16
"""How often a kick is shortened, by `SHORTER`, until what slips before it also slips after it."""

SHORTER = 1 / 4

PLACES = 1e-14
"""The relative precision of positions, from which strings choose velocities."""

Held = Callable[[], AbstractContextManager[None]]
Kicker = Callable[[float, Array, float, float], Array]


class Found(NamedTuple):
    """The accelerations with which n bodies go on.

    Attributes
    ----------
    acceleration
        (n, 3), their accelerations [m/s², rad/s²].
    forces
        Their contacts, impulses standing for forces.
    slips, sense
        Of the contacts, and which way each slips.
    """

    acceleration: Array
    forces: Contacts
    slips: Slips
    sense: Array


class Onwards:
    """Finds the accelerations with which n bodies go on after an event.

    Parameters
    ----------
    scene
        What moves.
    kick
        Kicks bodies that are held, as if so many steps after the last: takes these, the velocities
        before it, how long it is and the drift that would follow; returns the velocities after it.
    held
        Holds all bodies where they are.
    dt
        The time step [s].

    Attributes
    ----------
    running
        (n, 2), how fast the bodies' surfaces run [m/s].
    adds
        (n, 3), about what gravity and force laws add to the velocities in a step [m/s, rad/s].
    """

    def __init__(self, scene: Scene, kick: Kicker, held: Held, dt: float) -> None:
        self._batch, self._sticking, self._dt = scene.batch, scene.sticking, dt
        self._kick, self._held = kick, held
        self.running = surfaces(scene.bodies.values())
        self.adds = np.zeros((len(scene.mass), 3))
        self._blur = PLACES / dt if scene.joints.strings else 0.0

    def sense(self, slips: Slips, contacts: Contacts, velocity: Array, adds: Array) -> Array:
        """Return the directions of slipping, given velocities and what a kick adds to them."""
        known = slips.sense(velocity, np.abs(adds) + self.adds, self._blur)
        return np.where(contacts.friction > 0, known, 0.0)

    def solve(
        self,
        place: Array,
        velocity: Array,
        ahead: float,
        longest: float,
        slips: Slips,
        sense: Array,
    ) -> Found | None:
        """Return how bodies go on; None if no kick is short enough, or if others touch there.

        Parameters
        ----------
        place, velocity
            (n, 3), from where [m, rad, m/s, rad/s].
        ahead
            When: so many steps after the last.
        longest
            How long the kick may be [s].
        slips, sense
            Of the contacts so far, and which way each slips.
        """
        self._batch.set_state(np.concatenate((place, velocity), axis=1))
        length = longest
        for _ in range(TRIES):
            with self._forced(slips.bodies[sense != 0], slips.bodies[sense == 0]):
                after = self.settled(ahead, velocity, length, 2 * length)
            contacts = self._batch.contacts()
            there, adds = Slips.of(contacts, place, self.running), after - velocity
            goes = _matched(slips, sense, there)
            if goes is None or self.meets(contacts, place, velocity, length):
                return None
            if (self.sense(there, contacts, after, adds) == goes)[goes != 0].all():
                return Found(adds / length, contacts.times(1 / length), there, goes)
            length *= SHORTER
        return None

    def meets(self, contacts: Contacts, place: Array, velocity: Array, length: float) -> bool:
        """Return whether what touches meets, so that a kick of a length [s] would have to stop it.

        Places and velocities are (n, 3) [m, rad, m/s, rad/s].
        """
        apart = rates_apart(contacts, touching(contacts, place), velocity)
        most = NEGLIGIBLE * np.hypot(*self.adds[:, :2].T).max() * length / self._dt
        return bool((apart < -most).any())

    def settled(self, ahead: float, start: Array, length: float, drift: float) -> Array:
        """Kick bodies that are held, where they are: see the class.

        While pymunk's impulses are those of a kick of another length, static friction misjudges.
        """
        with self._held():
            if self._sticking:
                memory = self.memory()
                self._kick(ahead, start, length, drift)
                self.recall(memory)
            return self._kick(ahead, start, length, drift)

    def memory(self) -> dict[frozenset[int], Memory]:
        """Return what static friction knows of its contacts, by the numbers of the bodies."""
        return {pair: sticks.memory() for pair, sticks in self._sticking.items()}

    def recall(self, memory: Mapping[frozenset[int], Memory]) -> None:
        """Let static friction know what it knew."""
        for pair, known in memory.items():
            self._sticking[pair].recall(known)

    @contextmanager
    def _forced(self, slipping: Integers, others: Integers) -> Iterator[None]:
        """Let pairs with static friction slip, or find out whether they do: (k, 2) each."""
        for pairs, slips in ((others, False), (slipping, True)):
            for pair in map(frozenset, pairs.tolist()):
                if pair in self._sticking:
                    self._sticking[pair].tell(slips=slips)
        yield
        for sticks in self._sticking.values():
            sticks.must_slip = False


def _matched(before: Slips, sense: Array, now: Slips) -> Array | None:
    """Return which way contacts slip, known from before, of the same pairs now: (k,).

    None if they are others. pymunk may turn round who comes first of a pair, which leaves the sense
    as it is.
    """
    old, new = np.sort(before.bodies, axis=1), np.sort(now.bodies, axis=1)
    rows, others = np.lexsort(old.T), np.lexsort(new.T)
    if not np.array_equal(old[rows], new[others]):
        return None
    matched = np.empty_like(sense)
    matched[others] = sense[rows]
    return matched
