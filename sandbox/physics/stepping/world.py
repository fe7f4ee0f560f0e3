"""The world: a running level, step by step.

A step is a drift and a kick (`drifts_and_kicks.py`). Parts that only some levels need are plugins:
for their contract see `step_plugin.py`, for a list `plugins/register.py`.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, NoReturn

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.guarding.watchdog_selection import make_watch
from sandbox.physics.scene.make_scene import make_scene
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.initial_state import start
from sandbox.physics.stepping.plugins.register import declared
from sandbox.physics.stepping.step_observer import Observer
from sandbox.physics.stepping.step_plugin import Begin, Plugins, set_up

if TYPE_CHECKING:
    from sandbox.physics.energy.step_record import StepRecord

Pair = frozenset[str]


class World:
    """The bodies of a level in motion; made by `make_world`.

    Attributes
    ----------
    level, values, stepping
        The level, its parameters, and the stepping.
    scene
        The bodies, masses, laws and joints.
    kicks
        Takes the drifts and kicks of a step, counts steps, and times the calls in them.
    disturbed
        Whether the run was disturbed by hand, so that no closed form holds for it any more.
    """

    def __init__(self, level: Level, values: Values, stepping: Stepping, begin: Begin) -> None:
        self.level, self.values, self.stepping = level, values, stepping
        self.scene, self.disturbed = make_scene(level, values, stepping), False
        self._setup = set_up(level, values, stepping, self.scene, begin)
        self.kicks = self._setup.kicks
        self._plugins = Plugins(list(declared(self._setup)), self.kicks)
        self._observer = Observer(self._setup, self._plugins)
        self._ended: Exception | None = None
        self._start()

    @property
    def dt(self) -> float:
        """The time step [s]."""
        return self.kicks.clock.dt

    @property
    def steps(self) -> int:
        """The number of steps taken; the time is `steps * dt`."""
        return self.kicks.clock.steps

    @property
    def t(self) -> float:
        """The time [s]."""
        return self.kicks.clock.after(0)

    @property
    def snapshot(self) -> Snapshot:
        """The last observed state."""
        return self._observation.snapshot

    @property
    def contacts(self) -> Contacts:
        """The contacts at the last observation."""
        return self._observation.contacts

    @property
    def last(self) -> "StepRecord":
        """The record of the last observed step, for books."""
        return self._observer.record(self._observation)

    def keep_trail(self) -> None:
        """Keep the states between the parts of all further steps, for books."""
        self.kicks.keep_trail()

    @property
    def impacts(self) -> list[tuple[Pair, float]]:
        """The located impacts between the last two steps: the pair, and the time [s]."""
        direct, located, names = self.scene.direct, self._plugins.impacts, list(self.scene.bodies)
        struck = direct.drifts.impacts if direct else [i[:2] for i in located()] if located else ()
        t = self.kicks.clock.after(-1)
        return [(frozenset(names[b] for b in pair), t + time) for pair, time in struck]

    @property
    def hooks(self) -> int:
        """The number of Python calls in a step, if each pair that needs calls has one contact."""
        return self.kicks.calls + self._plugins.calls + self.scene.pair_callbacks

    def step(self) -> None:
        """Take one step without observing it, at the cost of pymunk's own step alone.

        Raises `SimulationError` if a joint cannot be satisfied.
        """
        kicks, plugins = self.kicks, self._plugins
        try:
            for act in plugins.before_drift:
                act()
            kicks.clock.steps += 1
            kicks.take()
            for act in plugins.after_step:
                act()
        except Exception as error:  # noqa: BLE001 (any error is explained)
            self._stop(error)

    def advance(self, steps: int = 1) -> Snapshot:
        """Take one or more steps, observe the last one, and return its state.

        Raises `SimulationError` if a joint cannot be satisfied, or the watchdog stops the run; the
        last good state stays in `snapshot`. Raises `ValueError` if there are no steps to take.
        """
        if self._ended:
            raise self._ended
        if steps < 1:
            raise ValueError(f"steps is {steps}, but must be at least 1")
        try:
            with np.errstate(all="ignore"):  # the watchdog reports non-finite values by name
                for _ in range(steps - 1):
                    self.step()
                velocity = self._observer.velocity(self._observation)
                self.step()
                self._observe(velocity)
        except Exception as error:  # noqa: BLE001 (as above)
            self._stop(error)
        return self._observation.snapshot

    @property
    def doubted(self) -> bool:
        """Whether the run has stopped but could continue, with results that cannot be trusted."""
        return self._ended is not None and self._watch.is_doubtful

    def go_on(self) -> None:
        """Continue a run that is `doubted`, as pymunk would."""
        assert self.doubted
        self._watch.is_doubtful, self._watch.ignores_doubts = False, True
        self._ended, self.disturbed = None, True

    def _start(self) -> None:
        """Observe the initial state, and take the first half kick."""
        self._observation = now = start(self._setup, self._plugins, self._observer)
        self._watch = make_watch(self, now.snapshot, now.contacts, now.pre_kick_velocity)

    def _observe(self, velocity: Array) -> None:
        """Observe the state, and let the watchdog check it."""
        plugins = self._plugins
        try:
            self._observation = now = self._observer.observe(
                plugins.pre_kick_velocity() if plugins.pre_kick_velocity else velocity
            )
            cut, disturbed = bool(plugins.impacts and plugins.impacts()), self.disturbed
            self._watch.check(
                now.snapshot, now.contacts, now.pre_kick_velocity, disturbed=disturbed, cut=cut
            )
        except Exception:
            self._observation = self._observation._replace(snapshot=self._watch.last_good)
            raise

    def _stop(self, error: Exception) -> NoReturn:
        """End the world, and raise the error with its explanation."""
        from sandbox.physics.stepping.failure_messages import explained

        self._ended = explained(error, list(self.scene.bodies), self.t, self.stepping.rate)
        raise self._ended from error.__cause__ if self._ended is error else error

    def recall(self, snapshot: Snapshot) -> None:
        """Show an earlier observed state; the world must take no step after that."""
        self._observation = self._observation._replace(snapshot=snapshot)

    def grab(self, body: str, point: tuple[float, float]) -> None:
        """Grab a dynamic body at a point of the plane [m], as with a stiff spring.

        Raises `SimulationError` if the scene cannot continue with leapfrog, which a hand needs.
        """
        from sandbox.physics.stepping import grabbing_and_placing

        if self.kicks.composed:
            grabbing_and_placing.require_leapfrog(self._setup, self.snapshot)
            self.place({})
        grabbing_and_placing.grab(self._setup, body, point)
        self.disturbed = True

    def drag(self, point: tuple[float, float]) -> None:
        """Pull the grabbed body towards a point of the plane [m]."""
        if hand := self._setup.forces.hand:
            hand.drag(point)

    def release(self) -> None:
        """Let go of the grabbed body."""
        if hand := self._setup.forces.hand:
            hand.release()

    def place(self, positions: Mapping[str, tuple[float, float]]) -> Snapshot:
        """Move bodies to positions [m] with their present velocities; strings adapt their lengths.

        Return the new state, from which the run continues as if it had started there. Raises
        `SimulationError` if it cannot continue from there; a position out of reach changes nothing.
        """
        from sandbox.physics.stepping import grabbing_and_placing

        grabbing_and_placing.require_reach(self._setup, positions)
        self.disturbed = True
        try:
            with np.errstate(all="ignore"):
                grabbing_and_placing.place(self._setup, self._plugins, positions, self.snapshot)
                self._start()
        except Exception as error:  # noqa: BLE001 (as above)
            self._stop(error)
        return self._observation.snapshot
