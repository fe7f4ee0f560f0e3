"""Playing a run: how fast time passes, up to which step, and what a hand does on the way.

The time step belongs to the level. A frame only decides how many whole steps are due. What cannot
be paid for within its budget is left to the next two; what is too much for these is dropped and
shown as a lower pace, never stretched.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from math import inf
from time import perf_counter

from sandbox.app.observing.earlier_runs import Observed
from sandbox.app.observing.grading import Reading
from sandbox.app.observing.impacts import Flash
from sandbox.app.observing.milestones import Milestone
from sandbox.app.runs.actions import Action
from sandbox.app.runs.grabbed_body import Grip
from sandbox.app.runs.left_runs import Records
from sandbox.app.runs.live_run import LiveRun
from sandbox.app.runs.pace import faster, slower
from sandbox.app.runs.run_view import RunView
from sandbox.model.errors import SandboxError
from sandbox.model.message import Message
from sandbox.model.shapes import XY
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.stepping.world import World

BUDGET = 0.009  # s, of a frame for steps
LATE = 2 / 60  # s, that steps may be late
AT_ONCE = 0.15  # s, for a way back or ahead before a frame is drawn
FADING = 0.25  # s, that a flash at an impact takes to fade
ON_THE_WAY = 0.05  # s, of a frame for the rest of such a way


class Playback(RunView, ABC):
    """A run that is played.

    Attributes
    ----------
    playing, speed
        Whether time passes by itself, and how fast.
    locked
        Whether no time passes: somebody is to say first what will come of the run.
    booked
        Whether it is booked where energy and momentum come from and go; see `Books`.
    sought
        The step to which the run is on its way, back or ahead; None if it is not.

    Parameters
    ----------
    run
        The run that is played.
    watched
        Whether a person waits for each step, and is asked where one takes long.
    """

    def __init__(self, run: LiveRun, *, watched: bool) -> None:
        self._watched = watched
        self.playing = False
        self.speed = 1.0
        self.locked = False
        self.booked = False
        self._take_up(run)

    def _take_up(self, run: LiveRun) -> None:
        """Play a run from its start."""
        super().__init__(run)
        run.books.keep(self.booked)
        self._grip = Grip(run)
        self._owed = 0.0  # steps
        self.sought: int | None = None
        self._records = Records()  # of what is taken again
        self._recalled: Observed | None = None  # what is sought, if it is in one of them

    @abstractmethod
    def _run_anew(self) -> LiveRun:
        """Return the present run at its start; raise a `SandboxError` if it cannot be built."""

    def book(self, wanted: bool) -> None:
        """Book energy and momentum from now on, in later runs from their start; or no more."""
        self.booked = wanted
        self.run.books.keep(wanted)

    def _stop(self, error: SandboxError) -> None:
        self.run.failure = error
        self.playing = False

    @property
    def _stands(self) -> bool:
        """Whether no time may pass, for whatever reason."""
        return self.waiting or self.locked

    @property
    def remaining(self) -> float | None:
        """How long the rest of the run takes as slowly as it goes; None if it keeps up [s]."""
        pace = self.run.pace.reduced if self.playing else None
        return max(self.duration - self.t, 0.0) / pace if pace else None

    @property
    def recalled(self) -> Observed | None:
        """What was recorded of the run, as it was at the step that is sought; None if unknown.

        It is there at once: the run itself takes its time until it stands there again.
        """
        return self._recalled if self.sought is not None else None

    @property
    def shown(self) -> World:
        """The world that is shown: the present one, or a recorded one."""
        return self.recalled.world if self.recalled else self.world

    def _recall(self) -> None:
        """Show the recorded state of the step that is sought, if there is one."""
        if self.sought is not None:
            self._recalled = self._records.show(self.sought, self.run.all_actions)

    def toggle(self) -> None:
        """Play or pause; continue a run that had to stop, if that is possible."""
        if self.doubted:
            self.run.go_on()
        self.run.limits.bear()
        self.playing = not self.playing and self.failure is None

    def pause(self) -> None:
        """Stop the time."""
        self.playing = False

    def step(self) -> None:
        """Pause, and take a single step; on a way, go a step farther."""
        self.playing = False
        if self.sought is None:
            self._advance()
        else:
            self.go_to(self.sought + 1)

    def go_to(self, step: int, *, undone: bool = False) -> None:
        """Go to another step of the run, backwards or forwards, as far as its `span` reaches.

        A way back begins at the start: the run is taken again, with all that a hand did to it, and
        so is the same to the last bit. What was done later is done again when its step comes,
        unless something else is done before. A long way takes some frames, see `sought`; what was
        recorded is there before, see `recalled`.

        Parameters
        ----------
        step
            Which.
        undone
            Whether what was done at that step and later is forgotten.

        Raises
        ------
        SandboxError
            If the run cannot be built again.
        """
        sought = min(max(step, 0), self.span)
        back = undone or sought < self.world.steps
        if self._stands or (self.failure is not None and not back):
            return
        self.release()
        self.run.limits.bear()
        self.sought = sought
        if back:
            self._begin_again(sought, undone=undone)
        self._recall()
        self._seek(AT_ONCE)

    def do_again(self, actions: Sequence[Action], steps: int) -> None:
        """Take a run from its start to a step, with what a hand did to it then."""
        self._take_again(actions, steps, inf)

    def _take_again(self, actions: Sequence[Action], steps: int, budget: float = AT_ONCE) -> None:
        """Compute a run from its start for some time [s]; later frames do the rest."""
        self.run.script, self.sought = actions, steps
        self._seek(budget)

    def _begin_again(self, sought: int, *, undone: bool = False) -> None:
        """Restart with the same parameters, to repeat the recorded actions."""
        before, actions = self.run, self.run.all_actions
        here = Observed(before.trail, before.history, before.world)
        records = self._records.having(here, before.actions)
        self._take_up(self._run_anew())
        self._records = records
        self.run.script = [a for a in actions if a.step < sought or not undone]
        self.run.ahead = before.farthest
        self.run.marks = before.marks
        if undone:
            self.run.marks.forget_after(sought)
        self.run.end = max(self.run.end, before.end)
        self.sought = sought

    def _seek(self, budget: float) -> None:
        """Take steps towards the one that is sought, as far as the budget goes [s]."""
        deadline, playing = perf_counter() + budget, self.playing
        while self.sought is not None and self.failure is None:
            if self.halted:
                self.sought = None
            elif self.world.steps >= self.sought:
                self.run.catch_up()
                self.sought = None
                if not self.run.script:
                    self.run.release_what_is_held()
                self.playing = playing and not self.at_end
            elif perf_counter() > deadline:
                return
            else:
                self._advance()

    def stay(self) -> bool:
        """Stay where a way back or ahead has come to, and return whether there was one."""
        under_way, self.sought = self.sought is not None, None
        if under_way:
            self.playing = False
        return under_way

    def step_back(self) -> None:
        """Pause, and go a single step back."""
        self.playing = False
        here = self.world.steps if self.sought is None else self.sought
        if here:
            self.go_to(here - 1)

    def faster(self) -> None:
        """Take the next higher speed."""
        self.speed = faster(self.speed)

    def slower(self) -> None:
        """Take the next lower speed."""
        self.speed = slower(self.speed)

    def update(self, seconds: float, budget: float = BUDGET) -> None:
        """Take the steps that are due after some real time, as far as the budget goes [s]."""
        if self.sought is not None:
            self._seek(ON_THE_WAY)
            return
        if not self.playing or self._stands:
            self._owed %= 1
            return
        rate = self.speed * self.world.stepping.rate
        self._owed += seconds * rate
        taken = self._take(int(self._owed), budget)
        left = int(self._owed) - taken
        dropped = max(left - int(LATE * rate), 0) if self.playing else left
        self._owed -= taken + dropped
        self.pace.note(seconds, taken * self.world.dt, dropped if self.playing else 0)

    def _take(self, due: int, budget: float) -> int:
        deadline = perf_counter() + budget
        for taken in range(due):
            if not self.playing or (taken and perf_counter() > deadline):
                return taken
            self._advance()
        return due

    def _advance(self) -> None:
        if self.failure is not None or self._stands:
            return
        begun = perf_counter()
        self.run.advance()
        if self._watched:
            self.run.limits.stepped(perf_counter() - begun)
        if self.failure is not None or self.at_end or self.halted:
            self.playing = False

    def grab(self, body: str, point: XY) -> None:
        """Take hold of a body at a point [m]; nothing happens to it before `drag`.

        What is only `recalled` cannot be touched.
        """
        if self.recalled is None:
            self._grip.grab(body, point)

    def drag(self, point: XY) -> None:
        """Pull what is held to a point [m]: while time runs with a force, else put it there.

        Raises
        ------
        SandboxError
            If it cannot be put there. Then the run stands where it stood, and nothing is held.
        """
        well = self.failure is None
        self._grip.drag(point, playing=self.playing)
        if well and self.failure is not None and not self.playing:
            self._put_back(self.failure)
        self._pause_if_stopped()

    def _put_back(self, failure: SandboxError) -> None:
        """Take the run again up to here, without what it could not stand."""
        self._begin_again(self.world.steps)
        self._recall()
        self._seek(AT_ONCE)
        reason = failure.reason if isinstance(failure, SimulationError) else failure.message
        raise SandboxError(
            Message("it cannot be put there: {reason}; play, and pull it", reason=reason)
        )

    def release(self) -> None:
        """Let go."""
        self._grip.release()
        self._pause_if_stopped()

    def _pause_if_stopped(self) -> None:
        if self.failure is not None:
            self.playing = False

    @property
    def flashes(self) -> Sequence[Flash]:
        """What is to be seen of the last impacts: the same at a step whenever it is shown."""
        if self.recalled:
            return ()
        return self.run.blows.flashes(FADING * self.speed)

    def readings(self) -> tuple[Reading, ...]:
        """Return how the checks stand."""
        return self.run.readings(hurried=self.playing)

    def milestones(self) -> tuple[Milestone, ...]:
        """Return the events so far; those after a hand touched the run do not count."""
        return self.run.milestones(hurried=self.playing)
