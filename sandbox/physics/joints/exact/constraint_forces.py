"""The forces of exact joints: of the last kicks, which tell what to expect of the next.

Joints come and go while a scene runs; their equations, and what is known of their forces, follow.
"""

from collections.abc import Sequence

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import Batch, Booleans
from sandbox.physics.joints.exact.constraints import Equation
from sandbox.physics.joints.exact.distances import Row
from sandbox.physics.joints.exact.joint_system import JointSystem


class ConstraintForces(JointSystem):
    """The forces of all exact joints, from kick to kick; n bodies, m equations.

    Attributes
    ----------
    tension
        (m,), the force along each row in the last kick [N]; positive where it pulls.
    parts
        How many kicks a step has: the same one of the steps before tells what to expect of each.
    added
        (m,), which equations have joined since the last kick.
    kick, drift
        How long the next kick lasts, and the drift that follows it [s].
    """

    def __init__(
        self,
        rows: Sequence[Row],
        others: Sequence[Equation],
        batch: Batch,
        inverse_mass: Array,
        inverse_moment: Array,
        origin: complex = 0j,
    ) -> None:
        super().__init__(rows, others, batch, inverse_mass, inverse_moment, origin)
        self._taut = ~self._pulls_only
        self.added = np.zeros_like(self._taut)
        self.tension = np.zeros_like(self.length)
        self.parts = 1
        self._past: list[Array] = []  # the tensions of the last kicks without impacts, newest first
        self._warm_start = self._cold  # impulses that have acted in this kick already
        self._struck = False
        self.kick = self.drift = 0.0

    def _lay_out(self, rows: Sequence[Row], others: Sequence[Equation]) -> None:
        """Make the tables of all equations."""
        super()._lay_out(rows, others)
        self._cold = np.zeros(len(self._joints))
        self._fresh = True  # whether they repeat each other has not been looked at yet

    def add(self, rows: Sequence[Row], others: Sequence[Equation]) -> None:
        """Take on more equations; what they stop at once is an impact, over with the next kick."""
        old = self.equations
        where = [len(old.rows)] * len(rows) + [len(self.length)] * len(others)
        lengths = [equation.length for equation in (*rows, *others)]
        self.length = np.insert(self.length, where, lengths)
        self._taut = np.insert(self._taut, where, values=True)
        self.tension = np.insert(self.tension, where, 0.0)
        self._past = [np.insert(tension, where, 0.0) for tension in self._past]
        self._warm_start = np.insert(self._warm_start, where, 0.0)
        self.added = np.insert(np.zeros_like(self.added), where, values=True)
        self._lay_out((*old.rows, *rows), (*old.others, *others))
        self._struck = True

    def keep(self, t: float) -> None:
        """Let what has joined since the last kick keep what there is at a time [s]."""
        self.length[self.added] += self._off(t)[self.added]

    def beyond(self, t: float) -> float:
        """Return by how much what has joined is too long for what it keeps at a time [m, rad]."""
        return float(self._off(t)[self.added].max(initial=0.0))

    def _off(self, t: float) -> Array:
        """Return by how much each equation misses what it keeps at a time: (m,) [m, rad]."""
        return np.asarray(self.look(self.place()).total - self.lengths(t))

    def calm(self) -> None:
        """Take what has joined for what has held all along: its impact is over."""
        self.added = np.zeros_like(self._taut)
        self._past, self._struck = [], False

    def drop(self, name: str) -> None:
        """Let go of what a joint holds."""
        stay = np.array([joint != name for joint in self._joints], dtype=bool)
        old = self.equations
        rows = [row for row in old.rows if row.joint != name]
        others = [equation for equation in old.others if equation.joint != name]
        self.length, self._taut = self.length[stay], self._taut[stay]
        self.tension, self.added = self.tension[stay], self.added[stay]
        self._past = []  # the others hold with other forces from now on
        self._lay_out(rows, others)
        self._warm_start = self._cold

    @property
    def past(self) -> list[Array]:
        """The forces of the last kicks without impacts, newest first: (m,) each [N]."""
        return self._past

    def expected(self) -> tuple[Array, Booleans]:
        """Return the forces that the next kick is likely to need, and what of it holds: (m,)."""
        last = self._past[0] if self._past else self._cold
        return np.where(self._taut, last, 0.0), self._taut

    def take(self, tension: Array, taut: Booleans, *, struck: bool) -> None:
        """Take up the forces of a kick that was solved elsewhere, and what held in it: (m,).

        After an impact they tell nothing of the next kick.
        """
        self.tension, self._taut = tension, taut
        last = self._past[: 3 * self.parts - 1]
        self._past = [] if struck else [tension, *last]
        self._struck, self._fresh = False, False
        self.added = np.zeros_like(taut)

    def force(self, name: str) -> float:
        """Return the force with which a joint pulled in the last kick [N]."""
        rows = self.equations.pulling.get(name, [])
        if not rows:
            return 0.0  # it keeps nothing but an angle
        if len(rows) == 1:
            return self.tension.item(rows[0])
        return float(np.hypot(*self.tension[rows]))

    def torque(self, name: str) -> float:
        """Return the torque of a joint on its second body in the last kick [N m].

        0 of one that keeps no angle, or is solved elsewhere.
        """
        rows, senses = self.equations.turning.get(name, ()), self.equations.senses
        return -float(sum(senses[row] * self.tension[row] for row in rows))

    def time(self, kick: float, drift: float) -> None:
        """Set how long the next kicks last, and the drift that follows each [s]."""
        self.kick, self.drift = kick, drift

    def refit(self, t: float) -> None:
        """Take the present lengths as those that hold from a time on [s]."""
        place, _ = self.coordinates()
        self.length = np.zeros_like(self.length)
        self.length = self.look(place).total - self.lengths(t)
        self.tension = np.zeros_like(self.length)
        self._past = []
        self._taut = ~self._pulls_only
        self._fresh = True

    def go_on(self, t: float) -> None:
        """Take what is driven to have turned at a time as far as it has [s]."""
        rows = len(self.equations.rows)
        driven = [i for i, _ in self.equations.changing if i >= rows]
        if driven:
            self.length[driven] += self._off(t)[driven]

    def warm_start(self, wrench: Array) -> None:
        """Add to the forces of a kick what the joints pulled in the last: (n, 3) [N, N m]."""
        steady = self._past[0] if self._past else self.tension
        self._warm_start = steady * self.kick
        wrench += self.wrenches(steady, self.place())
