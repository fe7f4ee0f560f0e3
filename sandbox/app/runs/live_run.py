"""A run that is played: its world, the user's actions on it, and the observations of it."""

import json
from collections.abc import Mapping, Sequence
from copy import copy
from time import thread_time
from typing import TYPE_CHECKING, Literal

from sandbox.app.observing import events_of_checks
from sandbox.app.observing.checks_of_unfinished_run import Reading, RunGrader, TimeShare
from sandbox.app.observing.earlier_runs import EarlierRun, RunObservations, with_one_more
from sandbox.app.observing.energy_history_and_balance import EnergyHistory
from sandbox.app.observing.events_of_checks import Milestone
from sandbox.app.observing.first_contacts import FirstContacts
from sandbox.app.observing.impacts import ImpactLog, ImpactMarks
from sandbox.app.observing.thinned_history import ThinnedHistory
from sandbox.app.observing.thinned_series import ThinnedSeries
from sandbox.app.runs.keyframes import Keyframe, Keyframes
from sandbox.app.runs.play_speed import PlaySpeed
from sandbox.app.runs.run_start import RunStart
from sandbox.app.runs.step_timer import StepTimer
from sandbox.app.runs.time_and_memory_limits import TimeAndMemoryLimits
from sandbox.app.runs.user_interventions import Action, perform
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.loading import choose
from sandbox.model.shapes import XY
from sandbox.physics.measuring.challenge_goals import Attempt, attempt
from sandbox.physics.measuring.recording import Recorder, Trace, count_steps, needed
from sandbox.physics.stepping.saved_state import still
from sandbox.physics.stepping.time_limit import TimeLimit
from sandbox.physics.stepping.world import World

if TYPE_CHECKING:
    from sandbox.physics.advising.remedy_trials import Advice


class LiveRun:
    """A run of a level, `original` as its file declares it, from the start to the step shown."""

    def __init__(
        self, original: Level, begun: RunStart, earlier: tuple[EarlierRun, ...] = ()
    ) -> None:
        self.world = world = begun.world
        """The world of the run; a new one after the run has branched."""
        self.companions = begun.companions
        """The companion runs, in lockstep."""
        self.setting = begun.setting
        """The setting that reaches the accuracy asked for; None if none is, or it is not known."""
        self.begun_with = world.values
        """The parameters at the start; the run may have branched since."""
        self.earlier = earlier
        """The last runs with other parameters, the newest last."""
        self.clock = StepTimer()
        self.end = count_steps(world)
        """The number of steps in the level's duration."""
        self.failure: SandboxError | None = None
        """The error that stopped the run, or prevented the next one; None if there is none."""
        self.trying = False
        self.advice: Advice | None = None
        """Whether remedies are being tried, and those found; None if not known yet."""
        self.trail = ThinnedSeries(world.snapshot.position)
        self.history = ThinnedHistory(world.snapshot)
        self.books = EnergyHistory(world, self.end)
        """The energies of the run, and their balance."""
        self.blows = ImpactLog(world)
        """The impacts, for flashes and tones."""
        self.contacts = FirstContacts(world)
        self.marks = ImpactMarks()
        """The impacts that are marked on the time bar, also those after the current step."""
        self.pace = PlaySpeed()
        self.actions: list[Action] = []
        """The user's actions up to the current step."""
        self.script: Sequence[Action] = ()
        """Actions at later steps, to be repeated there unless the user acts first."""
        self.ahead: RunObservations | None = None
        """The observations of the run before it was rewound; None if it was not."""
        self.keyframes = Keyframes(world)  # shared with the run as it was before
        self._whole: LiveRun | None = None  # the run as it was before, in the same world
        self._fork: World | None = None  # the world before the last branch
        graded = *needed(original), *needed(world.level), *events_of_checks.needed(world.level)
        self._quantities = tuple(dict.fromkeys(graded))
        self.limits = TimeAndMemoryLimits()
        self._patience = TimeLimit()
        self._record()

    @property
    def t(self) -> float:
        """The time that is shown [s]."""
        return float(self.world.snapshot.t)

    @property
    def farthest(self) -> RunObservations:
        """The observations of the run up to the latest step that it has reached."""
        here = RunObservations(self.trail, self.history, self.world)
        return max((run for run in (self.ahead, here) if run), key=RunObservations.steps)

    @property
    def all_actions(self) -> Sequence[Action]:
        """All actions of the user, also those at later steps that are to be repeated."""
        return [*self.actions, *self.script]

    def _record(self) -> None:
        """Start a new recording at the current step."""
        self._recorded, self._moved = self.world, False
        self._go_on_recording(Recorder(self.world, self._quantities))

    def _go_on_recording(self, recorder: Recorder) -> None:
        self._recorder = self.limits.recorder = recorder
        self._grading = RunGrader(recorder)
        self._attempts: TimeShare[Attempt | None] = TimeShare(self._attempt, None)

    def keep_as_earlier(self, values: Mapping[str, float]) -> None:
        """Add the run to the earlier ones, before parameters change to the given values."""
        here = RunObservations(self.trail, self.history, self.world)
        self.earlier = with_one_more(self.earlier, here, values)

    def advance(self) -> None:
        """Take a step with all companions, and record the observations."""
        begun = thread_time()
        self.catch_up()
        if self._moved and self.world is self._recorded:  # branches are not recorded
            self._record()
        if self.world.steps % 2:  # alternate, since the second finds warm caches
            self._follow(self.t + self.world.dt)
        try:
            snapshot = self.clock.take_step(self.world, self._patience)
        except SandboxError as error:
            self.failure = error
            return
        self.books.note()
        self.blows.note()
        self.marks.note(self.blows.since(self.world.steps - 1))
        self.contacts.note()
        self._follow(self.t)
        self.trail.add(snapshot.position)
        self.history.note(snapshot)
        recorded = self.world is self._recorded and self.world.steps <= self.end
        if recorded and not self._recorder.is_full:
            self._recorder.note()
        if not self.companions:
            ledger = self._recorder.ledger if self.world is self._recorded else None
            self.keyframes.note(len(self._recorder), ledger, thread_time() - begun)

    def keyframe_before(self, step: int) -> Keyframe | None:
        """Return the last keyframe up to a step from which this run can go on; None without one.

        A failed step has left no observations, and neither the balance nor companions go back.
        """
        if self.failure is not None or self.companions or self.books.kept:
            return None
        return self.keyframes.before(step)

    def at_keyframe(self, step: int) -> "LiveRun | None":
        """Return the run as it was at the last keyframe up to a step; None if there is none.

        It goes on in the world of this run, which keeps its observations and shows where it was.
        """
        found = self.keyframe_before(step)
        if found is None:
            return None
        whole, world = self._whole or self, self.world
        if whole.world.steps < world.steps:
            whole = self
        self.world, self._whole = still(world), None
        found.state.put_back()
        run = copy(whole)
        run.begin_at(found, world, whole)
        return run

    def begin_at(self, found: Keyframe, world: World, whole: "LiveRun") -> None:
        """Drop the observations after a keyframe, and go on in a world that is back at it.

        `whole` is the run with all observations, of which this one is a copy.
        """
        steps = whole.world.steps - found.step
        self.world, self._whole = world, whole
        self.advice, self.trying = None, False
        self.trail, self.history = copy(self.trail), copy(self.history)
        self.trail.drop_last(steps)
        self.history.drop_last(steps)
        self.books = copy(self.books)
        self.books.drop_last(steps)
        self.actions = [action for action in self.all_actions if action.step < found.step]
        recorder = copy(self._recorder)
        if self._recorded is world:
            recorder.keep_first(found.recorded)
        self._go_on_recording(recorder)

    def _follow(self, t: float) -> None:
        for companion in self.companions:
            companion.follow(t)

    def catch_up(self) -> None:
        """Repeat the recorded actions at this step."""
        while self.script and self.script[0].step == self.world.steps:
            action, *self.script = self.script
            self._do(action)

    def act(self, kind: Literal["grab", "drag", "release", "place"], body: str, point: XY) -> None:
        """Perform an action on a body at a point [m], and record it.

        The record of later steps becomes an earlier run, since the run takes another course now.
        """
        self._begin_new_future(self.world.values)
        self._do(Action(step=self.world.steps, kind=kind, body=body, point=point))

    def _begin_new_future(self, values: Mapping[str, float], *, branches: bool = False) -> None:
        """Keep the recorded later steps as an earlier run, since this run takes another course.

        A run that `branches` is kept even if nothing later was recorded.
        """
        left, overwritten = self.farthest, bool(self.script)
        overwritten |= left.steps() > self.world.steps
        self.script, self.ahead, self._whole = (), None, None
        self.keyframes.forget_after(self.world.steps)
        self.marks.forget_after(self.world.steps)
        if overwritten or branches:
            self.earlier = with_one_more(self.earlier, left, values, self.t)
        if overwritten:
            self.release_what_is_held()

    def _do(self, action: Action) -> None:
        """Perform an action on the run, and record it."""
        before = self.world
        try:
            world = perform(action, before)
        except SandboxError as error:
            self.failure = error
            return
        if world is not before:
            if action.kind == "branch" and self.ahead is None:
                self.earlier = with_one_more(self.earlier, self.farthest, world.values, self.t)
            self._go_on_in(world, before, action)
            return
        self.actions.append(action)
        if action.kind in ("place", "release"):
            self.books.hand_over()
            self._renew_keyframes()  # earlier observations end here
        if action.kind == "place":
            self._moved = True
            self.books.restart()
            self.trail.restart(self.world.snapshot.position)
            self.history.restart(self.world.snapshot)

    def branch(self, settings: Mapping[str, float]) -> None:
        """Continue with changed parameters; the run so far is kept as an earlier run.

        Raises `SandboxError` if that is not possible; then nothing is changed.
        """
        last = self.actions[-1] if self.actions else None
        again = last is not None and (last.kind, last.step) == ("branch", self.world.steps)
        before = self._fork if again and self._fork else self.world
        values = choose(self.world.level, {**self.world.values, **settings})
        changed = {name: v for name, v in values.items() if v != before.values[name]}
        action = Action(step=before.steps, kind="branch", parameters=changed)
        world = perform(action, before)
        if again:
            self.actions.pop()
        self._begin_new_future(values, branches=not again)
        self._go_on_in(world, before, action)

    def alter(self, text: str) -> None:
        """Continue as another level (JSON), that of the current state with other parts.

        Raises `SandboxError` if that is not possible; then nothing is changed.
        """
        action = Action(step=self.world.steps, kind="alter", level=json.loads(text))
        world = perform(action, self.world)
        self._begin_new_future(world.values)
        self._go_on_in(world, self.world, action)

    def _go_on_in(self, world: World, before: World, action: Action) -> None:
        """Continue in a world that has branched off, with new observations."""
        self._fork, self.world = before, world
        self.actions.append(action)
        self.end = max(self.end, count_steps(world))
        booked = self.books.kept
        self.books = EnergyHistory(world, self.end)
        self.books.keep(booked)
        self.blows = ImpactLog(world)
        self.contacts = FirstContacts(world)
        self.trail = ThinnedSeries(world.snapshot.position)
        self.history = ThinnedHistory(world.snapshot)
        self._renew_keyframes()

    def _renew_keyframes(self) -> None:
        self.keyframes, self._whole = Keyframes(self.world), None

    def release_what_is_held(self) -> None:
        """Release a body that the recorded actions have left grabbed."""
        held = (a.kind == "grab" for a in reversed(self.actions) if a.kind in ("grab", "release"))
        if next(held, False):
            self.act("release", "", (0.0, 0.0))

    def go_on(self) -> None:
        """Continue after a failure; the results are no longer reliable."""
        self.world.go_on()
        self.failure, self.advice, self.trying = None, None, False
        self.books.restart()
        self._renew_keyframes()

    @property
    def trace(self) -> Trace:
        """Everything recorded so far."""
        return self._recorder.trace

    def readings(self, *, hurried: bool) -> tuple[Reading, ...]:
        """Return the results of the checks; if `hurried`, perhaps slightly old ones."""
        return self._grading.readings(hurried=hurried)

    def milestones(self, *, hurried: bool) -> tuple[Milestone, ...]:
        """Return the events so far; none once the run is disturbed."""
        if self.world.disturbed:
            return ()
        self.readings(hurried=hurried)
        return self._grading.milestones

    def attempt(self, *, hurried: bool) -> Attempt | None:
        """Return the state of the challenge; None without one, or once the run is disturbed."""
        if self.world.level.challenge is None or self.world.disturbed:
            return None
        return self._attempts(len(self._recorder), hurried=hurried)

    def _attempt(self) -> Attempt | None:
        return attempt(self._recorder.trace)
