"""The kick with which bodies continue after an event within a step.

The bodies are held in place and kicked by pymunk's solver and the joints together, as before the
first step. In a short enough kick, a slipping contact keeps slipping. A contact whose slip has
ended is held by friction if friction is strong enough; otherwise it slips the other way.
"""

from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.coefficients.static_friction import Memory
from sandbox.physics.contacts.impacts.impact_step_velocity import NEGLIGIBLE, rates_apart, touching
from sandbox.physics.engine.space_arrays import Contacts, Integers
from sandbox.physics.events.slip_phases import Slips
from sandbox.physics.geometry.outline_distance import surfaces
from sandbox.physics.scene.make_scene import Scene

TRIES = 16
"""The most times that a kick is shortened by `SHORTER` for slipping contacts to keep slipping."""

SHORTER = 1 / 4

STRING_ROUNDING = 1e-14
"""The relative precision of positions, from which strings derive velocities."""

Held = Callable[[], AbstractContextManager[None]]
Kicker = Callable[[float, Array, float, float], Array]


class ContactAccelerations(NamedTuple):
    """The accelerations with which n bodies continue."""

    acceleration: Array
    """(n, 3), their accelerations [m/s², rad/s²]."""
    forces: Contacts
    """Their contacts, with forces in place of impulses."""
    slips: Slips
    """The slips of the contacts."""
    sense: Array
    """(k,), the directions of the slips: 1, −1, or 0 if there is none."""


class ContinuationSolver:
    """Finds the accelerations with which n bodies continue after an event.

    `held` holds all bodies where they are, and `kick` kicks them there: it takes the time since the
    last step, in steps, the velocities before the kick, its length and that of the drift that would
    follow [s], and returns the velocities after the kick. `dt` is the time step [s].

    `running`, (n, 2), are the velocities of the bodies' running surfaces [m/s]; `adds`, (n, 3), is
    the approximate change of velocity per step by gravity and force laws [m/s, rad/s].
    """

    def __init__(self, scene: Scene, kick: Kicker, held: Held, dt: float) -> None:
        self._batch, self._sticking, self._dt = scene.batch, scene.sticking, dt
        self._kick, self._held = kick, held
        self.running = surfaces(scene.bodies.values())
        self.adds = np.zeros((len(scene.mass), 3))
        self._blur = STRING_ROUNDING / dt if scene.joints.strings else 0.0

    def sense(self, slips: Slips, contacts: Contacts, velocity: Array, adds: Array) -> Array:
        """Return the directions of slip, given velocities and their change in a kick."""
        senses = slips.sense(velocity, np.abs(adds) + self.adds, self._blur)
        return np.where(contacts.friction > 0, senses, 0.0)

    def solve(
        self,
        pose: Array,
        velocity: Array,
        ahead: float,
        longest: float,
        slips: Slips,
        sense: Array,
    ) -> ContactAccelerations | None:
        """Return how bodies continue; None if no kick is short enough or the contacts have changed.

        They continue from `pose` and `velocity`, (n, 3) [m, rad, m/s, rad/s], at a time since the
        last step, `ahead`, in steps. `longest` is the greatest length of the kick [s]; `slips` are
        those of the contacts so far, and `sense` their directions.
        """
        self._batch.set_state(np.concatenate((pose, velocity), axis=1))
        length = longest
        for _ in range(TRIES):
            with self._forced(slips.bodies[sense != 0], slips.bodies[sense == 0]):
                after = self.settled(ahead, velocity, length, 2 * length)
            contacts = self._batch.contacts()
            new_slips, adds = Slips.of(contacts, pose, self.running), after - velocity
            matched_senses = _matched(slips, sense, new_slips)
            if matched_senses is None or self.is_approaching(contacts, pose, velocity, length):
                return None
            if (self.sense(new_slips, contacts, after, adds) == matched_senses)[
                matched_senses != 0
            ].all():
                return ContactAccelerations(
                    adds / length, contacts.scaled(1 / length), new_slips, matched_senses
                )
            length *= SHORTER
        return None

    def is_approaching(
        self, contacts: Contacts, pose: Array, velocity: Array, length: float
    ) -> bool:
        """Return whether touching bodies approach, so that a kick of a length [s] would stop them.

        Positions and velocities are (n, 3) [m, rad, m/s, rad/s].
        """
        apart = rates_apart(contacts, touching(contacts, pose), velocity)
        most = NEGLIGIBLE * np.hypot(*self.adds[:, :2].T).max() * length / self._dt
        return bool((apart < -most).any())

    def settled(self, ahead: float, start: Array, length: float, drift: float) -> Array:
        """Kick bodies that are held in place; for the parameters see the class.

        With static friction the kick is taken twice: it misjudges as long as pymunk's impulses stem
        from a kick of another length.
        """
        with self._held():
            if self._sticking:
                memory = self.memory()
                self._kick(ahead, start, length, drift)
                self.restore(memory)
            return self._kick(ahead, start, length, drift)

    def memory(self) -> dict[frozenset[int], Memory]:
        """Return the memory of static friction, by pairs of body indices."""
        return {pair: sticks.memory() for pair, sticks in self._sticking.items()}

    def restore(self, memory: Mapping[frozenset[int], Memory]) -> None:
        """Restore the memory of static friction."""
        for pair, impulses in memory.items():
            self._sticking[pair].restore(impulses)

    @contextmanager
    def _forced(self, slipping: Integers, others: Integers) -> Iterator[None]:
        """Let some pairs with static friction slip, and others find out whether they do: (k, 2)."""
        for pairs, slips in ((others, False), (slipping, True)):
            for pair in map(frozenset, pairs.tolist()):
                if pair in self._sticking:
                    self._sticking[pair].set_slipping(slips=slips)
        yield
        for sticks in self._sticking.values():
            sticks.must_slip = False


def _matched(before: Slips, sense: Array, now: Slips) -> Array | None:
    """Return earlier directions of slip in the order of the present contacts: (k,).

    None if the pairs have changed. pymunk may swap the bodies of a pair, which does not change the
    sign of the slip.
    """
    old, new = np.sort(before.bodies, axis=1), np.sort(now.bodies, axis=1)
    rows, others = np.lexsort(old.T), np.lexsort(new.T)
    if not np.array_equal(old[rows], new[others]):
        return None
    matched = np.empty_like(sense)
    matched[others] = sense[rows]
    return matched
