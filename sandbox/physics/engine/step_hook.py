"""Python inside a step: force laws before the kick, strings after the solver.

pymunk drifts the positions, finds the contacts, kicks the velocities and runs its solver. Forces
belong between drift and kick, where they see the new positions: that makes the step leapfrog
instead of explicit Euler. A motor without strength is called at that moment. The sandbox's own
joints are solved at the end of the step, after pymunk's. A level that needs neither has no hook at
all.
"""

from collections.abc import Callable, Sequence
from contextvars import copy_context
from time import perf_counter

import numpy as np
import pymunk

from sandbox.physics.state.kick import Kick, Work


class Hook:
    """Calls work between drift and kick, and after the solver, and keeps what goes wrong.

    Set `kick`, take pymunk's step, and `finish`: so the work knows which kick it is in. pymunk
    prints an exception that leaves a callback and carries on; `error` holds it instead, to be
    raised once the step is over. `count` is the number of calls a step, `seconds` what they have
    taken since they are `timed` [s].
    """

    def __init__(
        self,
        space: pymunk.Space,
        body: pymunk.Body,
        before_kick: Sequence[Work],
        after_solve: Sequence[Work],
    ) -> None:
        self.kick: Kick
        self.error: Exception | None = None
        self.seconds = 0.0
        self.count = bool(before_kick) + bool(after_solve)
        self._before, self._after = _in_turn(before_kick), _in_turn(after_solve)
        with np.errstate(all="ignore"):  # what is not finite ends the run by name
            self._quiet = copy_context()  # to enter it takes a tenth of what `errstate` takes
        self._call: Callable[[Work, Kick], None] = self._quiet.run
        if before_kick:
            motor = pymunk.SimpleMotor(space.static_body, body, 0.0)
            motor.max_force = 0.0
            motor.pre_solve = self._begin
            space.add(motor)

    def _begin(self, _constraint: pymunk.Constraint, _space: pymunk.Space) -> None:
        """Do what belongs between drift and kick."""
        try:
            self._call(self._before, self.kick)
        except Exception as error:  # noqa: BLE001 (raised again in `finish`)
            self.error = error

    def finish(self) -> None:
        """Do what follows pymunk's step, and raise what went wrong in it."""
        if self.error:
            raise self.error
        self._call(self._after, self.kick)

    def timed(self) -> None:
        """Take the time of the calls from now on, which costs a little itself."""
        self._call = self._timing

    def _timing(self, work: Work, kick: Kick) -> None:
        start = perf_counter()
        self._quiet.run(work, kick)
        self.seconds += perf_counter() - start


def _in_turn(work: Sequence[Work]) -> Work:
    """Return a call of all."""
    if len(work) == 1:
        return work[0]

    def run(kick: Kick) -> None:
        for item in work:
            item(kick)

    return run
