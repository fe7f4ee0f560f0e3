"""SHAKE: exact joints, solved together at the level of positions.

Each joint has equations C(q) = 0 in the bodies' coordinates q = (x, y, θ). The impulses λ along the
rows of their Jacobian at the step are such that the equations hold *after the next drift*,

    C(q + h (v − M⁻¹ J(q)ᵀ λ)) = 0,

which is the constrained form of leapfrog (SHAKE; Ryckaert, Ciccotti and Berendsen 1977): of second
order, time reversible, with joints that hold to rounding at every step. Newton's method solves the
equations together, so a chain with a heavy load at its end is as stiff as one without.
"""

from collections.abc import Sequence
from typing import TypeVar

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Booleans
from sandbox.physics.joints.exact.banded_systems import Banded
from sandbox.physics.joints.exact.constraint_conditioning import solved
from sandbox.physics.joints.exact.constraint_forces import ConstraintForces
from sandbox.physics.joints.exact.constraint_interface import (
    GROWS,
    MAX_ITERATIONS,
    QUADRATIC,
    Coordinates,
    Equation,
    Rows,
)
from sandbox.physics.joints.exact.distance_equations import Row
from sandbox.physics.joints.exact.joint_failures import check_independent, failure, overlapping
from sandbox.physics.joints.exact.rattle import motion
from sandbox.physics.joints.exact.separate_joints import alone
from sandbox.physics.state.cancellation_points import cancellation_point
from sandbox.physics.state.simulation_errors import JointFailure

TAUT = 1e-12
"""m, the largest excess length of a slack rope: the rounding error of its length."""


Number = TypeVar("Number", float, Array)


class ExactJoints(ConstraintForces):
    """The solver of all exact joints of a scene; n bodies, m equations."""

    def _lay_out(self, rows: Sequence[Row], others: Sequence[Equation]) -> None:
        """Make the tables of all equations, and choose how they are solved."""
        super()._lay_out(rows, others)
        inverse = self.inverse[: 2 * len(self._inverse_moment) : 2]
        self._alone = alone(self.equations.all, self.batch, inverse, self.origin)
        self._independence = 1.0  # ratio of smallest to largest singular value, at the start

    @property
    def plain(self) -> bool:
        """Whether all equations are constant, two-sided sums of lengths, and solved together."""
        return not (
            self.equations.others or self.equations.changing or self._unilateral or self._alone
        )

    def check(self) -> None:
        """Raise a `JointFailure` if equations are redundant, unless that was already checked."""
        if self._fresh and self._joints:
            here = self.equations.evaluate_without_memory(self.pose())
            self._check_independent(here, here.jacobian * self.inverse, self.length)

    def motion(self, mean: Array, law_acceleration: Array) -> tuple[Array, Array]:
        """Return velocities and accelerations at the present positions, and store the forces there.

        Not for joints that change with time. `mean` are the mean velocities, (n, 3) [m/s, rad/s],
        and `law_acceleration` the accelerations without the joints, (n, 3) [m/s², rad/s²]; see
        `rattle`.
        """
        velocity, acceleration, self.tension = motion(self, mean, law_acceleration, self.drift)
        return velocity, acceleration

    def solve(self, until: float) -> None:
        """Find the impulses that keep the joints through the next drift, and apply them.

        `until` is the time at the end of that drift [s]. Raises `JointFailure` if there are none:
        the joints are contradictory or redundant, or the step is too long for their load.
        """
        if not self._joints:
            return
        apart = self._alone and not self._fresh
        self.tension = self._solve_separately(until) if apart else self._solve_together(until)
        if self._struck:
            self._past, self._struck = self._past[:1], False
            self.added = np.zeros_like(self._taut)
        else:
            self._past = [self.tension, *self._past]
            del self._past[3 * self.parts :]
        self._warm_start = self._cold

    def _solve_separately(self, until: float) -> Array:
        """Solve the equations one by one, in floats; return the forces along them: (m,) [N]."""
        past, kick, drift = self._past[self.parts - 1 :: self.parts], self.kick, self.drift
        length, found = self.lengths(until), []
        warm_start = None if self._warm_start is self._cold else self._warm_start
        for i, one in enumerate(self._alone):
            expected = expected_number(past, i) * kick
            begun = 0.0 if warm_start is None else warm_start.item(i)
            try:
                impulse = one.solve(length.item(i), expected - begun, drift)
            except ZeroDivisionError:
                raise self.failure(i) from None
            found.append((begun + impulse) / kick)
        return np.array(found)

    def _solve_together(self, until: float) -> Array:
        """Solve all equations at once; return the forces along them: (m,) [N]."""
        if self.band and not self._fresh:
            return self._solve_band(self.band, until)
        pose, motion = self.coordinates()
        here = self.evaluate(pose)
        response = here.jacobian * self.inverse
        length = self.lengths(until)
        if self._fresh:
            self._check_independent(here, response, length)
        impulse, velocity = self._settle(pose, motion, response, length)
        free = motion.values + self._warm_start @ response
        work = -(self._warm_start + impulse) * (here.jacobian @ (free + velocity))
        self.refuse_gain(free, velocity, work)
        self.batch.set_velocity(velocity[self.coordinate_indices])
        # exactly 0 for a slack rope: the books tell by the sign when it is caught
        return np.where(self._taut, (self._warm_start + impulse) / self.kick, 0.0)

    def _solve_band(self, band: Banded, until: float) -> Array:
        """Solve all equations as a band; return the forces along them: (m,) [N]."""
        pose, motion = self.coordinates()
        here, length = band.linearize(pose), self.lengths(until)
        try:
            impulse, velocity, wrong = band.hold(
                pose, motion, here, length, self._guess(), self.drift
            )
        except np.linalg.LinAlgError:
            raise self.failure(0) from None
        if not wrong.dot(wrong) <= QUADRATIC**2:
            raise self.failure(int(np.argmax(np.abs(wrong))))
        free = motion.values + band.response(here, self._warm_start)
        work = -(self._warm_start + impulse) * band.rates(here, free + velocity)
        self.refuse_gain(free, velocity, work)
        self.batch.set_velocity(velocity[self.coordinate_indices])
        return (self._warm_start + impulse) / self.kick

    def _guess(self) -> Array:
        """Return the impulses expected in this kick beyond the warm start: (m,) [N s]."""
        past = self._past[self.parts - 1 :: self.parts]
        return (parabola(past) if past else self._cold) * self.kick - self._warm_start

    def refuse_gain(self, free: Array, velocity: Array, work: Array) -> None:
        """Refuse a kick in which joints add energy, unless lengths change or kinematic bodies move.

        The velocities are those without the joints' impulses, and with them, (3 N,) [m/s, rad/s];
        `work` is that of each row, (m,), up to a common factor [J]. The `JointFailure` names the
        joint with the most work.
        """
        rounding = self._mass * (QUADRATIC / self.drift) ** 2 / 2
        gains = self.kinetic_energy(velocity) > GROWS * self.kinetic_energy(free) + rounding
        if gains and not self.is_driven(free):
            raise self.failure(int(np.argmax(work)))

    def _settle(
        self, pose: Coordinates, motion: Coordinates, response: Array, length: Array
    ) -> tuple[Array, Array]:
        """Solve with an active set: release ropes that would push, tighten those too long."""
        guess = self._guess()
        for _ in range(MAX_ITERATIONS):
            slack = ~self._taut if self._unilateral else None
            start = guess if slack is None else np.where(slack, -self._warm_start, guess)
            impulse, velocity, violation = self._newton(
                pose, motion, response, length, start, slack
            )
            if not self._unilateral:
                return impulse, velocity
            pushes = self._pulls_only & self._taut & (self._warm_start + impulse < 0)
            stretched = ~self._taut & (violation > TAUT)
            if not (pushes.any() or stretched.any()):
                return impulse, velocity
            self._taut = (self._taut & ~pushes) | stretched
        raise self.failure(int(np.argmax(self._pulls_only)))

    def _newton(
        self,
        pose: Coordinates,
        motion: Coordinates,
        response: Array,
        length: Array,
        impulse: Array,
        slack: Booleans | None,
    ) -> tuple[Array, Array, Array]:
        """Return the impulses, the velocities after them, and the residuals of all rows.

        `impulse` is the initial guess; slack rows keep it. (`dot` of few numbers takes half the
        time of `@`.)
        """
        h = self.drift
        for _ in range(MAX_ITERATIONS):
            cancellation_point()
            velocity = motion.values - impulse.dot(response)
            there = self.evaluate(Coordinates(pose.values + h * velocity))
            violation = there.total - length
            wrong, delassus = violation, there.jacobian.dot(response.T)
            if slack is not None and slack.any():
                wrong = np.where(slack, 0.0, violation)
                delassus[slack] = 0.0
                delassus[slack, slack] = 1.0
            try:
                step = solved(delassus, wrong) / h
            except np.linalg.LinAlgError:
                worst = int(np.argmin(np.abs(delassus).sum(axis=1)))
                raise overlapping(self._joints, worst) from None
            impulse = impulse + step
            if wrong.dot(wrong) <= QUADRATIC**2:
                if slack is not None:  # the last step moves slack ropes, too
                    violation = violation - h * there.jacobian.dot(step.dot(response))
                return impulse, motion.values - impulse.dot(response), violation
        raise self.failure(int(np.argmax(np.abs(wrong))))

    def _check_independent(self, here: Rows, response: Array, length: Array) -> None:
        """Refuse taut rows that are redundant at the start."""
        self._fresh = False
        self._independence = check_independent(self, here, response, length)

    def failure(self, row: int) -> JointFailure:
        """Return why there is no solution: joints work against each other, or the step is long."""
        tension = np.zeros(len(self.length))  # that of new equations is not known yet
        tension[: len(self.tension)] = self.tension
        taut = np.flatnonzero(self._taut)
        return failure(self, row, taut, self._independence, tension, self.drift)


def expected_number(past: list[Array], i: int) -> float:
    """Extrapolate the number of an index by one step; 0 without a past.

    It is what `parabola` finds, in two thirds of the time: 5 % of a step with a single string.
    """
    if len(past) == 3:
        last, before, first = past
        return 3 * (last.item(i) - before.item(i)) + first.item(i)
    return parabola([tension.item(i) for tension in past]) if past else 0.0


def parabola(past: list[Number]) -> Number:
    """Extrapolate by one step the parabola through the last three values, newest first.

    With two values it is a line, with one a constant.
    """
    match past:
        case [last, before, first]:
            return 3 * (last - before) + first
        case [last, before]:
            return 2 * last - before
    return past[0]
