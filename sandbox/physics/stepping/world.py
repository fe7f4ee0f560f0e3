"""The world: a level that runs, step by step.

A step is a drift and a kick (`kicks.py`). What only some levels call for takes part in it as a
stage: `stage.py` says how, and `stages/register.py` lists them.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, NoReturn

import numpy as np

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.physics.engine.batch import Contacts
from sandbox.physics.guarding.watch_choice import make_watch
from sandbox.physics.scene.scene import make_scene
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.initial_state import start
from sandbox.physics.stepping.observer import Observer
from sandbox.physics.stepping.stage import Begin, Stages, set_up
from sandbox.physics.stepping.stages.register import declared

if TYPE_CHECKING:
    from sandbox.physics.energy.step_record import StepRecord

Pair = frozenset[str]


class World:
    """The bodies of a level in motion; made by `make_world`.

    Attributes
    ----------
    level, values, stepping
        What it was built from.
    scene
        The masses and laws of what moves.
    kicks
        Takes the drifts and kicks of a step, counts steps, and times what is called in them.
    disturbed
        Whether the run was touched on its way, so that no formula for it holds any more.
    """

    def __init__(self, level: Level, values: Values, stepping: Stepping, begin: Begin) -> None:
        self.level, self.values, self.stepping = level, values, stepping
        self.scene, self.disturbed = make_scene(level, values, stepping), False
        self._setup = set_up(level, values, stepping, self.scene, begin)
        self.kicks = self._setup.kicks
        self._stages = Stages(list(declared(self._setup)), self.kicks)
        self._observer = Observer(self._setup, self._stages)
        self._ended: Exception | None = None
        self._start()

    @property
    def dt(self) -> float:
        """The time step [s]."""
        return self.kicks.clock.dt

    @property
    def steps(self) -> int:
        """How many steps were taken; the time is `steps * dt`."""
        return self.kicks.clock.steps

    @property
    def t(self) -> float:
        """The time [s]."""
        return self.kicks.clock.after(0)

    @property
    def snapshot(self) -> Snapshot:
        """The state when it was last observed."""
        return self._seen.snapshot

    @property
    def contacts(self) -> Contacts:
        """Who touched whom when it was last observed."""
        return self._seen.contacts

    @property
    def last(self) -> "StepRecord":
        """What books must know of the last step that was observed."""
        return self._observer.record(self._seen)

    def keep_trail(self) -> None:
        """Keep the states between the parts of a step from now on, for books."""
        self.kicks.keep_trail()

    @property
    def impacts(self) -> list[tuple[Pair, float]]:
        """Who hit whom between the last two steps, and when [s], where that is located."""
        located = self._stages.impacts() if self._stages.impacts else []
        names, t = list(self.scene.bodies), self.kicks.clock.after(-1)
        return [(frozenset(names[b] for b in i.bodies), t + i.time) for i in located]

    @property
    def hooks(self) -> int:
        """How often a step calls Python, if each pair that needs it has one contact."""
        return self.kicks.calls + self._stages.calls + self.scene.pair_callbacks

    def step(self) -> None:
        """Take one step without looking at it: nothing but pymunk's own step is paid for.

        Raises
        ------
        SimulationError
            If a joint cannot be kept.
        """
        kicks, stages = self.kicks, self._stages
        try:
            for act in stages.before_drift:
                act()
            kicks.clock.steps += 1
            kicks.take()
            for act in stages.after_step:
                act()
        except Exception as error:  # noqa: BLE001 (whatever it is, whoever steps gets an answer)
            self._stop(error)

    def advance(self, steps: int = 1) -> Snapshot:
        """Take one or more steps, observe the last, and return the state there.

        Raises
        ------
        SimulationError
            If a joint cannot be kept, or a body is nowhere any more. The last good state stays in
            `snapshot`.
        ValueError
            If there are no steps to take.
        """
        if self._ended:
            raise self._ended
        if steps < 1:
            raise ValueError(f"steps is {steps}, but must be at least 1")
        try:
            with np.errstate(all="ignore"):  # what is not finite is told by name
                for _ in range(steps - 1):
                    self.step()
                before = self._observer.velocity(self._seen)
                self.step()
                self._observe(before)
        except Exception as error:  # noqa: BLE001 (as above)
            self._stop(error)
        return self._seen.snapshot

    @property
    def doubted(self) -> bool:
        """Whether the run has stopped and could go on: it is not lost, but not to be trusted."""
        return self._ended is not None and self._watch.doubts

    def go_on(self) -> None:
        """Go on with a run that is `doubted`, whatever it shows, as pymunk would."""
        assert self.doubted
        self._watch.doubts, self._watch.trusts = False, True
        self._ended, self.disturbed = None, True

    def _start(self) -> None:
        """Observe the state from which the run goes on, and take the first half kick."""
        self._seen = seen = start(self._setup, self._stages, self._observer)
        self._watch = make_watch(self, seen.snapshot, seen.contacts, seen.begun)

    def _observe(self, begun: Array) -> None:
        """Take up the state, and let the watchdog look at it."""
        stages = self._stages
        try:
            self._seen = seen = self._observer.observe(stages.begun() if stages.begun else begun)
            cut, disturbed = bool(stages.impacts and stages.impacts()), self.disturbed
            self._watch.look(seen.snapshot, seen.contacts, seen.begun, disturbed=disturbed, cut=cut)
        except Exception:
            self._seen = self._seen._replace(snapshot=self._watch.good)
            raise

    def _stop(self, error: Exception) -> NoReturn:
        """Raise the error with its explanation; the world has then ended."""
        from sandbox.physics.stepping.failures import explained

        self._ended = explained(error, list(self.scene.bodies), self.t, self.stepping.rate)
        cause = error.__cause__ if self._ended is error else error
        raise self._ended from cause

    def recall(self, snapshot: Snapshot) -> None:
        """Show a state that was observed before; a world that does takes no step any more."""
        self._seen = self._seen._replace(snapshot=snapshot)

    def grab(self, body: str, point: tuple[float, float]) -> None:
        """Take hold of a dynamic body at a point of the plane [m], as with a stiff spring.

        Raises
        ------
        SimulationError
            If the scene cannot go on with leapfrog, which a hand needs.
        """
        from sandbox.physics.stepping import hand

        if self.kicks.composed:
            hand.require_leapfrog(self._setup, self.snapshot)
            self.place({})
        hand.grab(self._setup, body, point)
        self.disturbed = True

    def drag(self, point: tuple[float, float]) -> None:
        """Pull the body that is held towards a point of the plane [m]."""
        if hand := self._setup.forces.hand:
            hand.drag(point)

    def release(self) -> None:
        """Let go of the body that is held."""
        if hand := self._setup.forces.hand:
            hand.release()

    def place(self, positions: Mapping[str, tuple[float, float]]) -> Snapshot:
        """Put bodies elsewhere [m] with the velocities they have; strings are cut to fit.

        Returns the new state, from which the run goes on as if it had started there.

        Raises
        ------
        SimulationError
            If it cannot go on from there.
        """
        from sandbox.physics.stepping import hand

        hand.place(self._setup, self._stages, positions, self.snapshot)
        self.disturbed = True
        try:
            self._start()
        except Exception as error:  # noqa: BLE001 (as above)
            self._stop(error)
        return self._seen.snapshot
