"""Plays a run: the speed of time, seeking a step, and the user's hand on bodies.

The time step is that of the level; a frame only determines how many whole steps are due. Steps that
exceed its time budget are postponed by up to two frames. Further ones are dropped and shown as a
lower pace; steps are never stretched.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from math import inf
from time import perf_counter

from sandbox.app.observing.checks_of_unfinished_run import Reading
from sandbox.app.observing.earlier_runs import RunObservations
from sandbox.app.observing.events_of_checks import Milestone
from sandbox.app.observing.impacts import Flash
from sandbox.app.runs.abandoned_run_records import Records
from sandbox.app.runs.grabbed_body import Grip
from sandbox.app.runs.live_run import LiveRun
from sandbox.app.runs.play_speed import faster, slower
from sandbox.app.runs.read_only_run import ReadOnlyRun
from sandbox.app.runs.user_interventions import Action
from sandbox.model.errors import SandboxError
from sandbox.model.shapes import XY
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World

BUDGET = 0.009  # s, the time for steps in a frame
LATE = 2 / 60  # s, the longest delay of steps
AT_ONCE = 0.1  # s, the time for seeking a step before a frame is drawn
FADING = 0.25  # s, the time in which a flash at an impact fades
ON_THE_WAY = 0.05  # s, the time for seeking in later frames


class RunPlayer(ReadOnlyRun, ABC):
    """A run that is played.

    If `watched`, it pauses with a message when a step takes long or memory is full.
    """

    def __init__(self, run: LiveRun, *, watched: bool) -> None:
        self._watched = watched
        self.playing = False
        self.speed = 1.0
        """The simulated seconds per second."""
        self.locked = False
        """Whether time is stopped until the user has predicted the outcome of the run."""
        self.booked = False
        """Whether the balance of energy and momentum is recorded; see `Books`."""
        self._take_up(run)

    def _take_up(self, run: LiveRun) -> None:
        """Play a run from its start."""
        super().__init__(run)
        run.books.keep(self.booked)
        self._grip = Grip(run)
        self._owed = 0.0  # steps
        self.sought: int | None = None
        """The step that the run is seeking, backwards or forwards; None if it is not."""
        self._records = Records()  # of the run as it was before rewinding
        self._recalled: RunObservations | None = None  # the record of the sought step, if any

    @abstractmethod
    def _run_anew(self) -> LiveRun:
        """Return the current run at its start; raise a `SandboxError` if it cannot be built."""

    def book(self, wanted: bool) -> None:
        """Start or stop recording the balance, in this run from now on and in later ones."""
        self.booked = wanted
        self.run.books.keep(wanted)

    def _stop(self, error: SandboxError) -> None:
        self.run.failure = error
        self.playing = False

    @property
    def _stands(self) -> bool:
        """Whether time is stopped for any reason."""
        return self.waiting or self.locked

    @property
    def remaining(self) -> float | None:
        """The real time for the rest of the run at a reduced pace [s]; None if it keeps up."""
        pace = self.run.pace.reduced if self.playing else None
        return max(self.duration - self.t, 0.0) / pace if pace else None

    @property
    def recalled(self) -> RunObservations | None:
        """The recorded observations of the run at the sought step; None if there are none.

        They are shown at once, while the run itself takes some time to reach the step again.
        """
        return self._recalled if self.sought is not None else None

    @property
    def shown(self) -> World:
        """The world that is shown: the current one, or a recorded one."""
        return self.recalled.world if self.recalled else self.world

    def _recall(self) -> None:
        """Show the recorded state of the sought step, if there is one."""
        if self.sought is not None:
            self._recalled = self._records.show(self.sought, self.run.all_actions)

    def toggle(self) -> None:
        """Play or pause; continue a run that has failed, if that is possible."""
        if self.doubted:
            self.run.go_on()
        self.run.limits.continue_run()
        self.playing = not self.playing and self.failure is None

    def pause(self) -> None:
        """Pause the run."""
        self.playing = False

    def step(self) -> None:
        """Pause, and take a single step; while seeking, seek a step further."""
        self.playing = False
        if self.sought is None:
            self._advance()
        else:
            self.go_to(self.sought + 1)

    def go_to(self, step: int, *, undone: bool = False) -> None:
        """Seek another step of the run, backwards or forwards, within its `span`.

        To go back, the run is repeated from its last keyframe before, or from its start, with the
        user's actions, which gives the same states to the last bit. Later actions are repeated at
        their steps, unless the user acts before. Seeking may take some frames, see `sought`; a
        recorded state is shown meanwhile, see `recalled`. `undone` drops the actions at that step
        and later. Raises `SandboxError` if the run cannot be built again.
        """
        sought = min(max(step, 0), self.span)
        back = undone or sought < self.world.steps
        if self._stands or (self.failure is not None and not back):
            return
        self.release()
        self.run.limits.continue_run()
        self.sought = sought
        found = self.run.keyframe_before(sought)
        if back or (found and found.step > self.world.steps):
            self._begin_again(sought, undone=undone)
        self._recall()
        self._seek(AT_ONCE)

    def do_again(self, actions: Sequence[Action], steps: int, budget: float = inf) -> None:
        """Compute a run from its start to a step, with the given actions.

        What takes longer than the time budget [s] is done in later frames.
        """
        self.run.script, self.sought = actions, steps
        self._seek(budget)

    def _begin_again(self, sought: int, *, undone: bool = False) -> None:
        """Go on from a keyframe, or else from the start, and repeat the recorded actions."""
        before, actions = self.run, self.run.all_actions
        run = before.at_keyframe(sought) or self._run_anew()
        here = RunObservations(before.trail, before.history, before.world)
        records = self._records.with_run(here, before.actions)
        self._take_up(run)
        self._records = records
        later = actions[len(run.actions) :]
        self.run.script = [a for a in later if a.step < sought or not undone]
        self.run.ahead = before.farthest
        self.run.marks = before.marks
        if undone:
            self.run.marks.forget_after(sought)
            self.run.keyframes.forget_after(sought)
        self.run.end = max(self.run.end, before.end)
        self.sought = sought

    def _seek(self, budget: float) -> None:
        """Take steps towards the sought one, within a time budget [s]."""
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
        """Stop seeking at the current step, and return whether the run was seeking."""
        under_way, self.sought = self.sought is not None, None
        if under_way:
            self.playing = False
        return under_way

    def step_back(self) -> None:
        """Pause, and go back a single step."""
        self.playing = False
        here = self.world.steps if self.sought is None else self.sought
        if here:
            self.go_to(here - 1)

    def faster(self) -> None:
        """Set the next higher speed."""
        self.speed = faster(self.speed)

    def slower(self) -> None:
        """Set the next lower speed."""
        self.speed = slower(self.speed)

    def update(self, seconds: float, budget: float = BUDGET) -> None:
        """Take the steps that are due after some real time [s], within a time budget [s]."""
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
        """Grab a body at a point [m]; it is not affected before `drag`.

        A state that is only `recalled` cannot be changed.
        """
        if self.recalled is None:
            self._grip.grab(body, point)

    def drag(self, point: XY) -> None:
        """Pull the held body towards a point [m] while the run plays, else move it there.

        Raises `SandboxError` if the body cannot be moved there. Then the run is restored, and the
        body released.
        """
        well = self.failure is None
        self._grip.drag(point, playing=self.playing)
        if well and self.failure is not None and not self.playing:
            self._put_back(self.failure)
        self._pause_if_stopped()

    def _put_back(self, failure: SandboxError) -> None:
        """Repeat the run up to the current step, without the action that failed."""
        self._begin_again(self.world.steps)
        self._recall()
        self._seek(AT_ONCE)
        reason = failure.reason if isinstance(failure, SimulationError) else failure.message
        raise SandboxError(
            "it cannot be put there: {reason}; play the run, and pull it instead", reason=reason
        )

    def release(self) -> None:
        """Release the body."""
        self._grip.release()
        self._pause_if_stopped()

    def _pause_if_stopped(self) -> None:
        if self.failure is not None:
            self.playing = False

    @property
    def flashes(self) -> Sequence[Flash]:
        """The flashes of the last impacts, which depend only on the step and the speed."""
        if self.recalled:
            return ()
        return self.run.blows.flashes(FADING * self.speed)

    def readings(self) -> tuple[Reading, ...]:
        """Return the results of the checks; while playing, perhaps slightly old ones."""
        return self.run.readings(hurried=self.playing)

    def milestones(self) -> tuple[Milestone, ...]:
        """Return the events so far; none once the run is disturbed."""
        return self.run.milestones(hurried=self.playing)
