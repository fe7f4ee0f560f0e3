"""A level being played: the world, its record, and how fast it runs. No window is needed.

The time step belongs to the level. A frame only decides how many whole steps are due; what cannot
be paid for within its budget is dropped and shown as a lower pace, never stretched.
"""

import json
from collections.abc import Mapping, Sequence
from math import inf
from time import perf_counter
from typing import Literal

from sandbox.app import milestones
from sandbox.app.actions import Action, perform
from sandbox.app.books import Books
from sandbox.app.clock import Clock
from sandbox.app.companions import NONE, Changes, Companion, Variant
from sandbox.app.earlier import Earlier, Observed, kept
from sandbox.app.grading import Grading, Ration, Reading
from sandbox.app.history import History
from sandbox.app.looking import Looking
from sandbox.app.milestones import Milestone
from sandbox.app.pace import Pace, faster, slower
from sandbox.app.trail import Trail
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Stepping
from sandbox.model.loading import choose
from sandbox.model.shapes import XY
from sandbox.physics.accuracy.cache import calibrated, keep, recalled
from sandbox.physics.accuracy.calibration import Setting
from sandbox.physics.advising.remedies import Advice
from sandbox.physics.measuring.goals import Attempt, attempt
from sandbox.physics.measuring.recording import Recorder, Trace, count_steps, needed
from sandbox.physics.run import build
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.stepping.world import World

BUDGET = 0.009  # s, of a frame for steps
AT_ONCE = 0.15  # s, for a way back or ahead before a frame is drawn
ON_THE_WAY = 0.05  # s, of a frame for the rest of such a way


class Session:
    """A level that is played.

    Attributes
    ----------
    original
        The level as its file declares it.
    changes
        Which effects were switched off and on.
    companions
        Other runs beside it, in lockstep.
    clock
        What the steps take.
    world
        Its present run.
    end
        How many steps reach the level's duration.
    playing, speed
        Whether time passes by itself, and how fast.
    failure
        Why the run had to stop, or could not be built; None if all is well.
    trying, advice
        Whether somebody is finding out what helps, and what was found; None if nobody knows yet.
    trail
        Where the bodies have been.
    history
        Everything that was observed of it.
    books
        What energies there were, and where they came from.
    setting
        What is known to reach the accuracy that its level asks for; None if it asks for none, or
        nobody knows yet.
    pace
        Whether the machine keeps up.
    earlier
        The last runs with other parameters, the newest last.
    actions
        What a person has done to the run so far.
    branches
        Whether a parameter that is changed acts from now on, instead of from the start.
    sought
        The step to which the run is on its way, back or ahead; None if it is not.
    looking
        The body that a person looks at, and the forces on it.
    locked
        Whether no time passes: somebody is to say first what will come of the run.

    Parameters
    ----------
    level, values, rate
        What is played, and how; as the level says what is left out.
    patient
        Whether an accuracy that the level asks for is waited for; else somebody has to `settle` it,
        and no time passes before.

    Raises
    ------
    SandboxError
        If the level cannot be run with these values.
    """

    def __init__(
        self,
        level: Level,
        values: Values | None = None,
        rate: float | None = None,
        *,
        patient: bool = True,
    ) -> None:
        self.original = level
        self._patient = patient
        self._begun_as = _at(level, rate)
        self.changes = NONE
        self.playing = False
        self.speed = 1.0
        self.locked = self.branches = False
        self.looking = Looking(level)
        self.earlier: tuple[Earlier, ...] = ()
        values = level.defaults if values is None else values
        self._begin(*self._built(self._begun_as, (), values))
        self._opened = self.level, self.values

    def _begin(
        self, world: World, companions: Sequence[Companion], setting: Setting | None
    ) -> None:
        self.world, self.setting = world, setting
        self._begun_with = world.values
        self._fork: World | None = None  # from which the run branched off last
        self._ahead: Observed | None = None  # how far the run has been, before a way back
        self.companions = tuple(companions)
        self.clock = Clock()
        self.failure: SandboxError | None = None
        self.trying = False
        self.advice: Advice | None = None
        self.end = count_steps(world)
        self.trail = Trail(world.snapshot.position)
        self.history = History(world.snapshot)
        self.pace = Pace()
        self.books = Books(world, self.end)
        self._recorder = Recorder(world, [*needed(self.original), *milestones.needed(self.level)])
        self._grading = Grading(self._recorder)
        self._attempts: Ration[Attempt | None] = Ration(self._attempt, None)
        self._owed = 0.0  # steps
        self._held: tuple[str, XY] | None = None
        self._pulling = False
        self.actions: list[Action] = []
        self._script: Sequence[Action] = ()  # what is to be done again
        self.sought: int | None = None

    def _begin_with(self, values: Values) -> None:
        """Start anew with these parameters, and with the same runs beside it."""
        variants = [companion.variant for companion in self.companions]
        self._begin(*self._built(self._begun_as, variants, values))

    @property
    def level(self) -> Level:
        """What is played: the original, with other effects or stepping, or altered on the way."""
        return self.world.level

    @property
    def begun_as(self) -> Level:
        """The level with which the run began; it may have been altered since."""
        return self._begun_as

    @property
    def values(self) -> Values:
        """The parameters of the present run."""
        return self.world.values

    @property
    def t(self) -> float:
        """The time of what is shown [s]."""
        return float(self.world.snapshot.t)

    @property
    def duration(self) -> float:
        """The time at which the run pauses by itself [s]."""
        return self.end * self.world.dt

    @property
    def remaining(self) -> float | None:
        """How long the rest of the run takes as slowly as it goes; None if it keeps up [s]."""
        pace = self.pace.reduced if self.playing else None
        return max(self.duration - self.t, 0.0) / pace if pace else None

    @property
    def at_end(self) -> bool:
        """Whether the run stands where its level says that it is complete."""
        return self.world.steps == self.end

    @property
    def touched(self) -> bool:
        """Whether a person has changed anything since the level was opened."""
        changed = self.companions or self.earlier or self.actions
        return bool(changed) or (self.level, self.values) != self._opened

    def restart(self, settings: Mapping[str, float] | None = None) -> None:
        """Start anew, with some parameters changed.

        Raises
        ------
        ValueRangeError
            If a parameter cannot have that value.
        """
        level = self._begun_as
        now = {name: value for name, value in self.values.items() if name in level.parameters}
        values = choose(level, {**self._begun_with, **now, **(settings or {})})
        if values != self.values and self.world.steps:
            self.earlier = kept(self.earlier, self._observed, values)
        try:
            self._begin_with(values)
        except SandboxError as error:
            self._stop(error)

    @property
    def begun_with(self) -> Values:
        """The parameters with which the run began; it may have branched since."""
        return self._begun_with

    @property
    def _observed(self) -> Observed:
        return Observed(self.trail, self.history, self.world)

    def change(self, settings: Mapping[str, float], *, otherwise: bool = False) -> None:
        """Change some parameters: from the start, or from now on if the session `branches`.

        Parameters
        ----------
        settings
            Their values.
        otherwise
            The other way round, this once.

        Raises
        ------
        SandboxError
            If a parameter cannot have that value, or cannot be changed from now on.
        """
        if self.branches != otherwise:
            self.branch(settings)
        else:
            self.restart(settings)

    def branch(self, settings: Mapping[str, float]) -> None:
        """Go on from here with some parameters changed; what was so far stays as an earlier run.

        Raises
        ------
        SandboxError
            If that cannot be; then all stays as it was.
        """
        if not self.world.steps:
            self.restart(settings)
            return
        self._require_one_that_goes_on("with other parameters")
        self.release()
        last = self.actions[-1] if self.actions else None
        again = last is not None and (last.kind, last.step) == ("branch", self.world.steps)
        before = self._fork if again and self._fork else self.world
        values = choose(self.level, {**self.values, **settings})
        changed = {name: v for name, v in values.items() if v != before.values[name]}
        action = Action(step=before.steps, kind="branch", parameters=changed)
        world = perform(action, before)
        if again:
            self.actions.pop()
        self._go_on_in(world, before, action)

    def alter(self, text: str) -> None:
        """Go on from here as another level says: that of the present state, with other parts.

        Raises
        ------
        SandboxError
            If that cannot be; then all stays as it was.
        """
        self._require_one_that_goes_on("with other parts")
        self.release()
        action = Action(step=self.world.steps, kind="alter", level=json.loads(text))
        self._go_on_in(perform(action, self.world), self.world, action)

    def _require_one_that_goes_on(self, how: str) -> None:
        if self.companions or self.changes or self.failure is not None:
            why = "it had to stop" if self.failure else "effects are compared"
            raise SandboxError(f"this run cannot go on {how}: {why}")

    def resume(
        self, actions: Sequence[Action], steps: int, values: Values | None = None
    ) -> None:
        """Take a run again from its start, and stand there; a long way takes some frames.

        Parameters
        ----------
        actions
            What was done to it.
        steps
            How far.
        values
            With which it began; those with which the present one did if left out.

        Raises
        ------
        SandboxError
            If it cannot be built again.
        """
        self._begin_with(self._begun_with if values is None else values)
        self._script, self.sought, self.playing = actions, steps, False
        self._seek(AT_ONCE)

    def _go_on_in(self, world: World, before: World, action: Action) -> None:
        """Go on in a world that has branched off from another one, of which something stays."""
        if before is self.world and action.kind == "branch":
            longest = max((o for o in (self._ahead, self._observed) if o), key=Observed.steps)
            self.earlier = kept(self.earlier, longest, world.values, self.t)
        self._fork, self.world, self._ahead = before, world, None
        self.actions.append(action)
        self.end = max(self.end, count_steps(world))
        self.books = Books(world, self.end)
        self.trail = Trail(world.snapshot.position)
        self.history = History(world.snapshot)
        if self.looking.body not in world.level.bodies:
            self.looking = Looking(world.level)

    @property
    def advised(self) -> float | None:
        """The rate at which a run that had to stop holds; None if none is known [Hz]."""
        if self.trying or not isinstance(self.failure, SimulationError):
            return None
        return self.failure.rate

    @property
    def doubted(self) -> bool:
        """Whether a run had to stop that could go on, though it is no longer to be trusted."""
        return self.failure is not None and self.world.doubted

    def take(self, advice: Advice) -> None:
        """Take in what was found to help a run that had to stop."""
        self.trying, self.advice = False, advice
        if isinstance(self.failure, SimulationError):
            self.failure = self.failure.advised(advice.text, advice.rate)

    def rerun(self, rate: float) -> None:
        """Play anew at another rate, from now on [Hz]."""
        self._begun_as = _at(self._begun_as, rate)
        self.restart()
        self.playing = self.failure is None

    def edit(self, level: Level) -> None:
        """Play another level from its start: the one that is played, as somebody has changed it.

        Raises
        ------
        SandboxError
            If it cannot be run; then all stays as it was.
        """
        begun = self._built(level, (), level.defaults)
        self.original = self._begun_as = level
        self.changes, self.earlier, self.playing = NONE, (), False
        self._begin(*begun)

    def play_as(
        self, level: Level, beside: Sequence[Variant] = (), changes: Changes = NONE
    ) -> None:
        """Start anew with another form of the level, and with other runs beside it.

        Parameters
        ----------
        level
            The original, with other effects or another stepping.
        beside
            What runs beside it.
        changes
            The effects in which it differs from the original.

        Raises
        ------
        SandboxError
            If one of them cannot be run; then all stays as it was.
        """
        begun = self._built(level, beside, self.values)
        self.earlier = ()
        self._begun_as, self.changes = level, changes
        self._begin(*begun)

    def _built(
        self, level: Level, beside: Sequence[Variant], values: Values
    ) -> tuple[World, list[Companion], Setting | None]:
        setting = self._known(level, values)
        if setting is not None:
            offer = setting.chosen if self._patient else setting.playable
            world = build(level, values, offer.stepping)
        elif level.stepping.accuracy is None:
            world = build(level, values)
        else:
            world = _for_now(level, values)
        return world, [Companion(variant, values) for variant in beside], setting

    def _known(self, level: Level, values: Values) -> Setting | None:
        target = level.stepping.accuracy
        find = calibrated if self._patient else recalled
        return None if target is None else find(level, values, target)

    @property
    def waiting(self) -> bool:
        """Whether no time passes before it is known which setting the level asks for."""
        return self.setting is None and self.world.level.stepping.accuracy is not None

    @property
    def _stands(self) -> bool:
        """Whether no time may pass, for whatever reason."""
        return self.waiting or self.locked

    def settle(self, setting: Setting) -> None:
        """Begin with the setting that its level asks for, now that it is known."""
        keep(self._begun_as, self.values, setting)
        self.restart()

    def give_up(self, why: str) -> None:
        """Take note that nobody knows the setting that its level asks for."""
        self._stop(SandboxError(why))

    def toggle(self) -> None:
        """Play, or pause; go on with a run that had to stop, if it can."""
        if self.doubted:
            self.world.go_on()
            self.failure, self.advice, self.trying = None, None, False
            self.books.restart()
        self.playing = not self.playing and self.failure is None

    def pause(self) -> None:
        """Let no more time pass by itself."""
        self.playing = False

    def step(self) -> None:
        """Pause, and take a single step."""
        self.playing = False
        self._advance()

    def go_to(self, step: int) -> None:
        """Go to another step of the run, back or ahead; to the level's end at the most.

        A way back begins at the start: the run is taken again, with all that a hand did to it, and
        so is the same to the last bit. What was done later is forgotten. A long way takes some
        frames, see `sought`.

        Raises
        ------
        SandboxError
            If the run cannot be built again.
        """
        if self._stands or (self.failure is not None and step >= self.world.steps):
            return
        self.release()
        self.sought = min(max(step, 0), self.end)
        if self.sought < self.world.steps:
            self._begin_again(self.sought)
        self._seek(AT_ONCE)

    def do_again(self, actions: Sequence[Action], steps: int) -> None:
        """Take a run from its start to a step, with what a hand did to it then."""
        self._script, self.sought = actions, steps
        self._seek(inf)

    def _begin_again(self, sought: int) -> None:
        """Start anew with the same parameters, to do again what was done before a step."""
        script = [action for action in self.actions if action.step < sought]
        playing, end = self.playing, self.end
        ahead = max((o for o in (self._ahead, self._observed) if o), key=Observed.steps)
        self._begin_with(self._begun_with)
        self._script, self.sought, self.playing = script, sought, playing
        self._ahead, self.end = ahead, max(self.end, end)

    def _seek(self, budget: float) -> None:
        """Take steps towards the one that is sought, as far as the budget goes [s]."""
        deadline, playing = perf_counter() + budget, self.playing
        while self.sought is not None and self.failure is None:
            if self.world.steps >= self.sought:
                self._do_again()
                self.sought = None
                self._let_go_of_what_was_held()
                self.playing = playing and not self.at_end
            elif perf_counter() > deadline:
                return
            else:
                self._advance()

    def _let_go_of_what_was_held(self) -> None:
        """Let go of a body that was held at this step: the hand that held it is not there now."""
        held = (a.kind == "grab" for a in reversed(self.actions) if a.kind in ("grab", "release"))
        if next(held, False):
            self._act("release", "", (0.0, 0.0))

    def step_back(self) -> None:
        """Pause, and go a single step back."""
        self.playing = False
        if self.world.steps:
            self.go_to(self.world.steps - 1)

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
            return
        self._owed += seconds * self.speed * self.world.stepping.rate
        due = int(self._owed)
        self._owed -= due
        taken = self._take(due, budget)
        dropped = due - taken if self.playing else 0
        self.pace.note(seconds, taken * self.world.dt, dropped)

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
        self._do_again()
        if self.world.steps % 2:  # whoever comes second finds the caches warm: take turns
            self._follow(self.t + self.world.dt)
        try:
            with self.clock.running():
                snapshot = self.world.advance()
        except SandboxError as error:
            self._stop(error)
            return
        self.books.note()
        self._follow(self.t)
        self.trail.add(snapshot.position)
        self.history.note(snapshot)
        if self.world.steps <= self.end and not self.world.disturbed:
            self._recorder.note()
        if self.at_end:
            self.playing = False

    def _do_again(self) -> None:
        """Do what was done at this step when the run was taken before."""
        while self._script and self._script[0].step == self.world.steps:
            action, *self._script = self._script
            self._do(action)

    def _do(self, action: Action) -> None:
        """Do something to the run, and note it."""
        before = self.world
        try:
            world = perform(action, before)
        except SandboxError as error:
            self._stop(error)
            return
        if world is not before:
            self._go_on_in(world, before, action)
            return
        self.actions.append(action)
        if action.kind == "place":
            self.books.restart()
            self.trail.restart(self.world.snapshot.position)
            self.history.restart(self.world.snapshot)

    def _act(self, kind: Literal["grab", "drag", "release", "place"], body: str, point: XY) -> None:
        self._do(Action(step=self.world.steps, kind=kind, body=body, point=point))

    def _follow(self, t: float) -> None:
        for companion in self.companions:
            companion.follow(t)

    def _stop(self, error: SandboxError) -> None:
        self.failure = error
        self.playing = False

    def readings(self) -> tuple[Reading, ...]:
        """Return how the checks stand."""
        return self._grading.readings(hurried=self.playing)

    def attempt(self) -> Attempt | None:
        """Return how the level's challenge stands; None without one, or if the run earns nothing.

        That is so once a hand has touched it, or effects are changed.
        """
        if self.level.challenge is None or self.changes or self.world.disturbed:
            return None
        return self._attempts(len(self._recorder), hurried=self.playing)

    def _attempt(self) -> Attempt | None:
        return attempt(self._recorder.trace)

    def milestones(self) -> tuple[Milestone, ...]:
        """Return what has happened; nothing that counts once a hand has touched the run."""
        if self.world.disturbed:
            return ()
        self.readings()
        return self._grading.milestones

    @property
    def trace(self) -> Trace:
        """What was recorded of the run so far."""
        return self._recorder.trace

    def grab(self, body: str, point: XY) -> None:
        """Take hold of a body at a point [m]; nothing happens to it before `drag`."""
        x, y = self._position(body)
        self._held = body, (point[0] - x, point[1] - y)

    def drag(self, point: XY) -> None:
        """Pull what is held to a point [m]: while time runs with a force, else put it there."""
        if self._held is None or self.failure is not None:
            return
        body, (dx, dy) = self._held
        if not self.playing:
            self._let_loose()
            self._act("place", body, (point[0] - dx, point[1] - dy))
            return
        if not self._pulling:
            x, y = self._position(body)
            self._act("grab", body, (x + dx, y + dy))
            self._pulling = self.failure is None
        if self._pulling:
            self._act("drag", "", point)

    def release(self) -> None:
        """Let go."""
        self._let_loose()
        self._held = None

    def _let_loose(self) -> None:
        if self._pulling:
            self._act("release", "", (0.0, 0.0))
            self._pulling = False

    def _position(self, body: str) -> XY:
        row = list(self.level.bodies).index(body)
        x, y = self.world.snapshot.position[row]
        return float(x), float(y)


def _for_now(level: Level, values: Values) -> World:
    """Build a level that asks for an accuracy with a setting of which nothing is known."""
    try:
        return build(level, values, Stepping())
    except SimulationError as error:
        if error.rate is None:
            raise
        return build(level, values, Stepping(rate=error.rate))


def _at(level: Level, rate: float | None) -> Level:
    """Return a level, at another rate if one is given [Hz]."""
    if rate is None:
        return level
    return level.model_copy(update={"stepping": level.stepping.at(float(rate))})
