"""The forces of exact joints in the last kicks, from which those of the next are predicted.

Joints come and go while a scene runs; their equations and known forces are kept up to date.
"""

from collections.abc import Container, Mapping, Sequence

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Batch, Booleans
from sandbox.physics.joints.exact.constraint_interface import Equation
from sandbox.physics.joints.exact.distance_equations import Row
from sandbox.physics.joints.exact.joint_system import JointSystem


class ConstraintForces(JointSystem):
    """The forces of all exact joints, from kick to kick; n bodies, m equations.

    `tension`, (m,), is the force along each row in the last kick [N], positive where it pulls;
    `added`, (m,), are the equations added since then. `parts` is the number of kicks in a step: the
    forces of a kick are predicted from the same kick of earlier steps. `kick` and `drift` are the
    durations of the next kick, and of the drift after it [s]. `rebounds` are the coefficients of
    restitution of the stops among the joints that rebound, by name.
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
        self.rebounds: Mapping[str, float] = {}

    def _lay_out(self, rows: Sequence[Row], others: Sequence[Equation]) -> None:
        """Make the tables of all equations."""
        super()._lay_out(rows, others)
        self._cold = np.zeros(len(self._joints))
        self._fresh = True  # not checked for redundancy yet

    @property
    def restitution(self) -> Array:
        """The coefficient of restitution of each equation: (m,)."""
        return np.array([self.rebounds.get(name, 0.0) for name in self._joints])

    def add(self, rows: Sequence[Row], others: Sequence[Equation]) -> None:
        """Add equations; motion that they stop at once is an impact, which the next kick ends."""
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

    def keep(self, joints: Container[str], t: float) -> None:
        """Let the equations of some joints keep their present values, at a time [s]."""
        kept = [row for row, joint in enumerate(self._joints) if joint in joints]
        self.length[kept] += self._residuals(t)[kept]

    def largest_excess(self, joints: Container[str], t: float) -> tuple[str, float]:
        """Return the largest excess length among some joints at a time [s], and whose it is.

        The excess is in m or rad; it is 0, and the name empty, if there is none.
        """
        residuals = zip(self._residuals(t).tolist(), self._joints, strict=True)
        excess, joint = max((found for found in residuals if found[1] in joints), default=(0.0, ""))
        return joint, max(excess, 0.0)

    def _residuals(self, t: float) -> Array:
        """Return the residuals of the equations at a time [s]: (m,) [m, rad]."""
        return np.asarray(self.evaluate(self.pose()).total - self.lengths(t))

    def end_added_impact(self) -> None:
        """Treat the equations added like all others: their impact is over."""
        self.added = np.zeros_like(self._taut)
        self._past, self._struck = [], False

    def drop(self, name: str) -> None:
        """Remove the equations of a joint."""
        stay = np.array([joint != name for joint in self._joints], dtype=bool)
        old = self.equations
        rows = [row for row in old.rows if row.joint != name]
        others = [equation for equation in old.others if equation.joint != name]
        self.length, self._taut = self.length[stay], self._taut[stay]
        self.tension, self.added = self.tension[stay], self.added[stay]
        self._past = []  # the forces of the others change now
        self._lay_out(rows, others)
        self._warm_start = self._cold

    @property
    def past(self) -> list[Array]:
        """The forces of the last kicks without impacts, newest first: (m,) each [N]."""
        return self._past

    def expected(self) -> tuple[Array, Booleans]:
        """Return the expected forces of the next kick, and which equations are active: (m,)."""
        last = self._past[0] if self._past else self._cold
        return np.where(self._taut, last, 0.0), self._taut

    def store_forces(self, tension: Array, taut: Booleans, *, struck: bool) -> None:
        """Store the forces of a kick that was solved elsewhere, and its active equations: (m,).

        After an impact they do not predict the next kick.
        """
        self.tension, self._taut = tension, taut
        last = self._past[: 3 * self.parts - 1]
        self._past = [] if struck else [tension, *last]
        self._struck, self._fresh = False, False
        self.added = np.zeros(len(taut), dtype=bool)

    def force(self, name: str) -> float:
        """Return the force by which a joint pulled in the last kick [N]."""
        rows = self.equations.pulling.get(name, [])
        if not rows:
            return 0.0  # it keeps only an angle
        if len(rows) == 1:
            return self.tension.item(rows[0])
        return float(np.hypot(*self.tension[rows]))

    def torque(self, name: str) -> float:
        """Return the torque of a joint on its second body in the last kick [N m].

        0 if the joint keeps no angle, or is solved elsewhere.
        """
        rows, senses = self.equations.turning.get(name, ()), self.equations.senses
        return -float(sum(senses[row] * self.tension[row] for row in rows))

    def time(self, kick: float, drift: float) -> None:
        """Set the durations of the next kicks, and of the drift after each [s]."""
        self.kick, self.drift = kick, drift

    def refit(self, t: float) -> None:
        """Keep the present lengths from a time on [s]."""
        pose, _ = self.coordinates()
        self.length = np.zeros_like(self.length)
        self.length = self.evaluate(pose).total - self.lengths(t)
        self.tension = np.zeros_like(self.length)
        self._past = []
        self._taut = ~self._pulls_only
        self._fresh = True

    def go_on(self, t: float) -> None:
        """Let driven angles keep their present values at a time [s]."""
        rows = len(self.equations.rows)
        driven = [i for i, _ in self.equations.changing if i >= rows]
        if driven:
            self.length[driven] += self._residuals(t)[driven]

    def warm_start(self, wrench: Array) -> None:
        """Add the joint forces of the last kick to the forces of the next: (n, 3) [N, N m]."""
        steady = self._past[0] if self._past else self.tension
        self._warm_start = steady * self.kick
        wrench += self.wrenches(steady, self.pose())
