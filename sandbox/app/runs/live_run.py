"""A run that is played: its world, the user's actions on it, and all that was observed."""

import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Literal

from sandbox.app.observing import milestones
from sandbox.app.observing.earlier_runs import Earlier, Observed, kept
from sandbox.app.observing.energy_books import Books
from sandbox.app.observing.first_contacts import FirstContacts
from sandbox.app.observing.grading import Grading, Ration, Reading
from sandbox.app.observing.impact_marks import ImpactMarks
from sandbox.app.observing.impacts import ImpactLog
from sandbox.app.observing.milestones import Milestone
from sandbox.app.observing.state_history import History
from sandbox.app.observing.thinned_series import Trail
from sandbox.app.runs.actions import Action, perform
from sandbox.app.runs.beginning import Beginning
from sandbox.app.runs.limits import Limits
from sandbox.app.runs.pace import Pace
from sandbox.app.runs.step_clock import Clock
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level
from sandbox.model.loading import choose
from sandbox.model.shapes import XY
from sandbox.physics.measuring.goals import Attempt, attempt
from sandbox.physics.measuring.recording import Recorder, Trace, count_steps, needed
from sandbox.physics.stepping.time_limit import Patience
from sandbox.physics.stepping.world import World

if TYPE_CHECKING:
    from sandbox.physics.advising.remedies import Advice


class LiveRun:
    """A run, from its start to the step that is shown.

    Attributes
    ----------
    world
        The world of the run; a new one after the run has branched.
    companions
        Other runs beside it, in lockstep.
    setting
        What is known to reach the accuracy that its level asks for; None if it asks for none, or
        nobody knows yet.
    begun_with
        The parameters with which it began; it may have branched since.
    clock
        What the steps take.
    end
        How many steps reach the level's duration.
    failure
        Why it had to stop, or the next one could not be built; None if all is well.
    trying, advice
        Whether somebody is finding out what helps, and what was found; None if nobody knows yet.
    limits
        Whether it takes more time or memory than it should.
    trail
        Where the bodies have been.
    history
        Everything that was observed of it.
    books
        What energies there were, and where they came from.
    blows
        Its impacts, for flashes and tones.
    marks
        The impacts that are marked on the bar of the time, also those that are still to come again.
    contacts
        Which bodies have touched, and when they first did.
    pace
        Whether the machine keeps up.
    earlier
        The last runs with other parameters, the newest last.
    actions
        What a person has done to it so far.
    script
        What is to be done to it at steps to come, because it was done when it was taken before; it
        is dropped when something else is done first.
    ahead
        How far it had been before a way back; None if it never came farther.

    Parameters
    ----------
    original
        The level as its file declares it.
    begun
        The world at the start.
    earlier
        The runs that were there before.
    """

    def __init__(
        self, original: Level, begun: Beginning, earlier: tuple[Earlier, ...] = ()
    ) -> None:
        world, self.companions, self.setting = begun
        self.world, self.begun_with = world, world.values
        self.earlier = earlier
        self.clock = Clock()
        self.end = count_steps(world)
        self.failure: SandboxError | None = None
        self.trying = False
        self.advice: Advice | None = None
        self.trail = Trail(world.snapshot.position)
        self.history = History(world.snapshot)
        self.books = Books(world, self.end)
        self.blows, self.contacts = ImpactLog(world), FirstContacts(world)
        self.marks = ImpactMarks()
        self.pace = Pace()
        self.actions: list[Action] = []
        self.script: Sequence[Action] = ()
        self.ahead: Observed | None = None
        self._fork: World | None = None  # from which it branched off last
        graded = *needed(original), *needed(world.level), *milestones.needed(world.level)
        self._quantities = tuple(dict.fromkeys(graded))
        self.limits, self._patience = Limits(), Patience()
        self._record()
        self._attempts: Ration[Attempt | None] = Ration(self._attempt, None)

    @property
    def t(self) -> float:
        """The time that is shown [s]."""
        return float(self.world.snapshot.t)

    @property
    def farthest(self) -> Observed:
        """What was observed of it when it had come farthest."""
        here = Observed(self.trail, self.history, self.world)
        return max((run for run in (self.ahead, here) if run), key=Observed.steps)

    @property
    def all_actions(self) -> Sequence[Action]:
        """What a person has done to it at any step, also at those that are still to come again."""
        return [*self.actions, *self.script]

    def _record(self) -> None:
        """Record it from now on, and forget everything before."""
        self._recorder = Recorder(self.world, self._quantities)
        self._recorded, self._moved = self.world, False
        self._grading = Grading(self._recorder)
        self.limits.recorder = self._recorder

    def keep_as_earlier(self, values: Mapping[str, float]) -> None:
        """Keep its present record among the earlier runs, before parameters change."""
        here = Observed(self.trail, self.history, self.world)
        self.earlier = kept(self.earlier, here, values)

    def advance(self) -> None:
        """Take a step, its companions too, and note what is observed."""
        self.catch_up()
        if self._moved and self.world is self._recorded:  # one that branched is not recorded
            self._record()
        if self.world.steps % 2:  # whoever comes second finds the caches warm: take turns
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
        if recorded and not self._recorder.full:
            self._recorder.note()

    def _follow(self, t: float) -> None:
        for companion in self.companions:
            companion.follow(t)

    def catch_up(self) -> None:
        """Repeat the actions that were recorded at this step."""
        while self.script and self.script[0].step == self.world.steps:
            action, *self.script = self.script
            self._do(action)

    def act(self, kind: Literal["grab", "drag", "release", "place"], body: str, point: XY) -> None:
        """Do to a body what a hand does, at a point [m], and note it.

        The record of later steps becomes an earlier run, since the run takes another course now.
        """
        self._begin_new_future(self.world.values)
        self._do(Action(step=self.world.steps, kind=kind, body=body, point=point))

    def _begin_new_future(self, values: Mapping[str, float], *, branches: bool = False) -> None:
        """Keep the recorded later steps as an earlier run, since this run takes another course.

        A run that `branches` is kept also where nothing later was recorded of it.
        """
        left, overwritten = self.farthest, bool(self.script)
        overwritten |= left.steps() > self.world.steps
        self.script, self.ahead = (), None
        self.marks.forget_after(self.world.steps)
        if overwritten or branches:
            self.earlier = kept(self.earlier, left, values, self.t)
        if overwritten:
            self.release_what_is_held()

    def _do(self, action: Action) -> None:
        """Do something to the run, and note it."""
        before = self.world
        try:
            world = perform(action, before)
        except SandboxError as error:
            self.failure = error
            return
        if world is not before:
            if action.kind == "branch" and self.ahead is None:
                self.earlier = kept(self.earlier, self.farthest, world.values, self.t)
            self._go_on_in(world, before, action)
            return
        self.actions.append(action)
        if action.kind in ("place", "release"):
            self.books.hand_over()
        if action.kind == "place":
            self._moved = True
            self.books.restart()
            self.trail.restart(self.world.snapshot.position)
            self.history.restart(self.world.snapshot)

    def branch(self, settings: Mapping[str, float]) -> None:
        """Go on from here with changed parameters; the run so far is kept as an earlier run.

        Raises
        ------
        SandboxError
            If that cannot be; then all stays as it was.
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
        """Go on from here as a level says: that of the present state, with other parts.

        Raises
        ------
        SandboxError
            If that cannot be; then all stays as it was.
        """
        action = Action(step=self.world.steps, kind="alter", level=json.loads(text))
        world = perform(action, self.world)
        self._begin_new_future(world.values)
        self._go_on_in(world, self.world, action)

    def _go_on_in(self, world: World, before: World, action: Action) -> None:
        """Go on in a world that has branched off, and keep some observations."""
        self._fork, self.world = before, world
        self.actions.append(action)
        self.end = max(self.end, count_steps(world))
        booked = self.books.kept
        self.books = Books(world, self.end)
        self.books.keep(booked)
        self.blows, self.contacts = ImpactLog(world), FirstContacts(world)
        self.trail = Trail(world.snapshot.position)
        self.history = History(world.snapshot)

    def release_what_is_held(self) -> None:
        """Let go of a body that a hand held when the run was taken before: no hand is there now."""
        held = (a.kind == "grab" for a in reversed(self.actions) if a.kind in ("grab", "release"))
        if next(held, False):
            self.act("release", "", (0.0, 0.0))

    def go_on(self) -> None:
        """Go on after it had to stop, though it is no longer to be trusted."""
        self.world.go_on()
        self.failure, self.advice, self.trying = None, None, False
        self.books.restart()

    @property
    def trace(self) -> Trace:
        """Everything recorded so far."""
        return self._recorder.trace

    def readings(self, *, hurried: bool) -> tuple[Reading, ...]:
        """Return how the checks stand; if there is a hurry, perhaps how they stood just before."""
        return self._grading.readings(hurried=hurried)

    def milestones(self, *, hurried: bool) -> tuple[Milestone, ...]:
        """Return the events so far; those after a hand touched the run do not count."""
        if self.world.disturbed:
            return ()
        self.readings(hurried=hurried)
        return self._grading.milestones

    def attempt(self, *, hurried: bool) -> Attempt | None:
        """Return how the challenge stands; None if there is none, or a hand has touched the run."""
        if self.world.level.challenge is None or self.world.disturbed:
            return None
        return self._attempts(len(self._recorder), hurried=hurried)

    def _attempt(self) -> Attempt | None:
        return attempt(self._recorder.trace)
