"""Python inside a step: force laws before the kick, strings after the solver.

pymunk drifts the positions, finds the contacts, kicks the velocities and lets the solver have its
way. Forces belong between drift and kick, where they see the new positions: that makes the step
leapfrog instead of explicit Euler. Joints of our own also need the end of the step. A motor without
strength offers both moments; a level that needs neither has no hook at all.
"""

from collections.abc import Callable, Sequence
from time import perf_counter

import pymunk

Work = Callable[[], None]
Call = Callable[[pymunk.Constraint, pymunk.Space], None]


class Hook:
    """Calls work between drift and kick, and after the solver, and keeps what goes wrong.

    pymunk prints an exception that leaves a callback and carries on; `error` holds it instead, for
    the world to raise once the step is over. `count` is the number of calls a step, `seconds`
    what they have taken since they are `timed` [s].
    """

    def __init__(
        self,
        space: pymunk.Space,
        body: pymunk.Body,
        before_kick: Sequence[Work],
        after_solve: Sequence[Work],
    ) -> None:
        self.error: Exception | None = None
        self.seconds = 0.0
        self.count = bool(before_kick) + bool(after_solve)
        self._motor = motor = pymunk.SimpleMotor(space.static_body, body, 0.0)
        motor.max_force = 0.0
        if before_kick:
            motor.pre_solve = self._guarded(before_kick)
        if after_solve:
            motor.post_solve = self._guarded(after_solve)
        space.add(motor)

    def timed(self) -> None:
        """Take the time of the calls from now on, which costs a little itself."""
        motor = self._motor
        if motor.pre_solve:
            motor.pre_solve = self._timing(motor.pre_solve)
        if motor.post_solve:
            motor.post_solve = self._timing(motor.post_solve)

    def _timing(self, call: Call) -> Call:
        def run(constraint: pymunk.Constraint, space: pymunk.Space) -> None:
            start = perf_counter()
            call(constraint, space)
            self.seconds += perf_counter() - start

        return run

    def _guarded(self, work: Sequence[Work]) -> Call:
        def run(_constraint: pymunk.Constraint, _space: pymunk.Space) -> None:
            try:
                for item in work:
                    item()
            except Exception as error:  # noqa: BLE001 (raised again by the world)
                self.error = error

        return run
