"""Python inside a step: force laws before the kick, strings after the solver.

pymunk drifts the positions, finds the contacts, kicks the velocities and runs its solver. Forces
are computed between drift and kick, from the new positions, which makes the step leapfrog instead
of explicit Euler. For that, a motor without strength has its callback there. The sandbox's own
joints are solved at the end of the step, after pymunk's. A level that needs neither has no hook.
"""

from collections.abc import Callable, Sequence
from contextvars import copy_context
from time import perf_counter

import numpy as np
import pymunk

from sandbox.physics.engine.blas_threads import in_one_thread
from sandbox.physics.engine.private_handles import call_before_kick
from sandbox.physics.state.kick_context import Kick, Work


class Hook:
    """Calls work between drift and kick and after the solver, and stores exceptions.

    Set `kick`, which is passed to the work, take pymunk's step, and call `finish`; or call what
    `around` returns. pymunk prints an exception from a callback and carries on, so `error` stores
    it until then. `count` is the number of calls in a step, and `seconds` their total time since
    `start_timing` was called [s].
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
        self._acts_before, self._acts_after = bool(before_kick), bool(after_solve)
        self._before, self._after = _in_turn(before_kick), _in_turn(after_solve)
        with np.errstate(all="ignore"):  # values that are not finite end the run elsewhere
            quiet = copy_context()  # entering it takes a tenth of the time of `errstate`
        self._call = self._run = in_one_thread(quiet.run, len(space.bodies))
        if before_kick:
            motor = pymunk.SimpleMotor(space.static_body, body, 0.0)
            motor.max_force = 0.0
            call_before_kick(motor, self._begin)
            space.add(motor)

    def _begin(self, _constraint: object, _space: object) -> None:
        """Call the work between drift and kick."""
        try:
            self._call(self._before, self.kick)
        except Exception as error:  # noqa: BLE001 (raised again in `finish`)
            self.error = error

    def finish(self) -> None:
        """Raise the exception of the step, if any, or else call the work after the solver."""
        if self.error:
            raise self.error
        if self._acts_after:
            self._call(self._after, self.kick)

    def around(self, drift_and_kick: Callable[[], None], kick: Kick) -> Callable[[], None]:
        """Return a function that takes a drift and a kick of pymunk's, with the calls in it.

        It raises errors from these calls. It must be made anew when timing starts.
        """
        call, after = self._call, self._after
        if not self._acts_before:

            def take_then_act() -> None:
                drift_and_kick()
                call(after, kick)

            return take_then_act

        def take() -> None:
            self.kick = kick
            drift_and_kick()
            self.finish()

        return take

    def start_timing(self) -> None:
        """Measure the time of the calls from now on, at a small cost."""
        self._call = self._timed_call

    def _timed_call(self, work: Work, kick: Kick) -> None:
        start = perf_counter()
        self._run(work, kick)
        self.seconds += perf_counter() - start


def _in_turn(work: Sequence[Work]) -> Work:
    """Return a function that calls all work in turn."""
    if len(work) == 1:
        return work[0]

    def run(kick: Kick) -> None:
        for item in work:
            item(kick)

    return run
