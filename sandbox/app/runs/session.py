"""The session: the level that is played, and the start of its runs. No window is needed."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from sandbox.app.observing.forces_on_selected_body import SelectedBody
from sandbox.app.runs.companion_runs import NONE, Changes, Variant
from sandbox.app.runs.live_run import LiveRun
from sandbox.app.runs.run_player import AT_ONCE, RunPlayer
from sandbox.app.runs.run_start import RunStart, at_rate, begin
from sandbox.app.runs.user_interventions import Action
from sandbox.model.errors import SandboxError, ValueRangeError
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.loading import choose
from sandbox.model.translatable_message import Message
from sandbox.physics.measuring.challenge_goals import Attempt
from sandbox.physics.state.simulation_errors import SimulationError

if TYPE_CHECKING:
    from sandbox.physics.accuracy.requested_accuracy import Setting
    from sandbox.physics.advising.remedy_trials import Advice

MOST_LEVELS = 4
"""The number of levels for which the parameters that fit are kept."""


class Session(RunPlayer):
    """A level that is played, with its own parameters and rate [Hz] unless others are given.

    If `patient`, it searches at once for a setting that reaches the accuracy the level asks for,
    and allows long steps; else the run waits until `settle` is called. Raises `SandboxError` if the
    level cannot be run with these values.
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
        """The level as its file declares it."""
        self._patient = patient
        self.begun_as = at_rate(level, rate)
        """The level as which runs start: the original, perhaps with other effects or stepping."""
        self.changes = NONE
        """The effects that were switched off and on."""
        self.branches = False
        """Whether a changed parameter acts from now on, instead of from the start."""
        self.looking = SelectedBody()
        """The body that the user has selected, and the forces on it."""
        self.repeats = False
        """Whether it repeats a run from a file, which earns no stars."""
        self._fitting: dict[int, tuple[Level, Values, Values, Values]] = {}  # see `values_for`
        begun = self._built(self.begun_as, (), level.defaults if values is None else values)
        super().__init__(LiveRun(level, begun), watched=not patient)
        self._opened = self.level, self.values

    def _built(self, level: Level, beside: Sequence[Variant], values: Values) -> RunStart:
        return begin(level, values, beside, patient=self._patient)

    def _run_with(self, values: Values) -> LiveRun:
        """Return a run with these parameters, and with the same companions."""
        variants = [companion.variant for companion in self.companions]
        begun = self._built(self.begun_as, variants, values)
        return LiveRun(self.original, begun, self.run.earlier)

    def _run_anew(self) -> LiveRun:
        return self._run_with(self.begun_with)

    @property
    def touched(self) -> bool:
        """Whether the user has changed anything since the level was opened."""
        changed = self.companions or self.earlier or self.all_actions
        return bool(changed) or (self.level, self.values) != self._opened

    def values_for(self, level: Level) -> Values:
        """Return parameters for a level: the current ones, as far as the run has them.

        If the level does not allow the current values, those at the start are taken, or else the
        level's defaults. The answer is kept, as it is asked for in every frame, and finding it
        evaluates all that a level must fulfil.
        """
        found = self._fitting.get(id(level))
        if found is None or found[0] is not level or found[1:3] != (self.begun_with, self.values):
            if len(self._fitting) > MOST_LEVELS:
                self._fitting.clear()
            found = level, {**self.begun_with}, {**self.values}, self._values_that_fit(level)
            self._fitting[id(level)] = found
        return found[3]

    def _values_that_fit(self, level: Level) -> Values:
        for known in ({**self.begun_with, **self.values}, self.begun_with):
            with suppress(ValueRangeError):
                return choose(level, {n: known[n] for n in level.parameters if n in known})
        return level.defaults

    @property
    def chosen(self) -> Values:
        """The current parameters of the original; see `values_for`."""
        return self.values_for(self.original)

    def restart(self, settings: Mapping[str, float] | None = None) -> None:
        """Restart with some parameters changed.

        Raises `ValueRangeError` if a parameter cannot have that value.
        """
        values = choose(self.begun_as, {**self.values_for(self.begun_as), **(settings or {})})
        if values != self.values and self.world.steps:
            self.run.keep_as_earlier(values)
        try:
            self._take_up(self._run_with(values))
        except SandboxError as error:
            self._stop(error)

    @property
    def branched(self) -> bool:
        """Whether the run has branched, or will where it did before; then no check is graded."""
        return any(action.kind in ("branch", "alter") for action in self.all_actions)

    def rewind(self) -> None:
        """Go back to the start; the user's actions are repeated.

        A run that has branched or failed restarts instead, with the current parameters.
        """
        if self.branched or self.failure:
            self.restart()
        else:
            self.go_to(0)

    def go_to_impact(self, direction: int) -> None:
        """Pause, and go to the next marked impact, or to the one before if `direction` is -1.

        Beyond the last, go as far as the run has been; before the first, to its start.
        """
        self.pause()
        here = self.world.steps if self.sought is None else self.sought
        ends = 0, self.run.farthest.steps()
        steps = [*ends, *(blow.steps for blow in self.run.marks.shown)]
        ahead = [step for step in steps if direction * (step - here) > 0]
        if ahead:
            self.go_to(min(ahead, key=lambda step: abs(step - here)))

    def forget_earlier(self) -> None:
        """Remove all earlier runs."""
        self.run.earlier = ()

    def change(self, settings: Mapping[str, float], *, otherwise: bool = False) -> None:
        """Change some parameters: from the start, or from now on if the session `branches`.

        `otherwise` does the opposite of `branches`, this once. Raises `SandboxError` if a parameter
        cannot have that value, or cannot be changed from now on.
        """
        if self.branches != otherwise:
            self.branch(settings)
        else:
            self.restart(settings)

    def branch(self, settings: Mapping[str, float]) -> None:
        """Continue with changed parameters; the run so far is kept as an earlier run.

        Raises `SandboxError` if that is not possible; then nothing is changed.
        """
        if not self.world.steps and not self.recalled:
            self.restart(settings)
            return
        self._require_one_that_goes_on(Message("with other parameters"))
        self.release()
        self.run.branch(settings)

    def alter(self, text: str) -> None:
        """Continue as another level (JSON), that of the current state with other parts.

        Raises `SandboxError` if that is not possible; then nothing is changed.
        """
        self._require_one_that_goes_on(Message("with other parts"))
        if self.changes:
            raise SandboxError("effects are switched off or on here; switch them back first (X)")
        self.release()
        self.run.alter(text)

    def _require_one_that_goes_on(self, how: Message) -> None:
        if self.companions or self.failure is not None or self.recalled:
            why = Message("it had to stop")
            if self.companions:
                why = Message("other runs are played beside it")
            if self.recalled:
                why = Message("it is still on its way")
            raise SandboxError("this run cannot continue {how}: {why}", how=how, why=why)

    def resume(self, actions: Sequence[Action], steps: int, values: Values | None = None) -> None:
        """Repeat a run with its actions up to some step, and pause there.

        This may take some frames. By default it starts with the parameters of the current run.
        Raises `SandboxError` if the run cannot be built.
        """
        self._take_up(self._run_with(self.begun_with if values is None else values))
        self.playing = False
        self.do_again(actions, steps, AT_ONCE)

    def add_advice(self, advice: "Advice") -> None:
        """Add the remedies that were found to the failure of the run."""
        self.run.trying, self.run.advice = False, advice
        if isinstance(self.failure, SimulationError):
            self.run.failure = self.failure.advised(advice.text, advice.rate)

    def rerun(self, rate: float) -> None:
        """Restart at another rate [Hz]."""
        self.begun_as = at_rate(self.begun_as, rate)
        self.restart()
        self.playing = self.failure is None

    def edit(self, level: Level) -> None:
        """Replace the level by an edited one, at its start.

        Raises `SandboxError` if it cannot be run; then nothing is changed.
        """
        begun = self._built(level, (), level.defaults)
        self.original = self.begun_as = level
        self.changes, self.playing = NONE, False
        self._take_up(LiveRun(self.original, begun))

    def play_as(
        self,
        level: Level,
        beside: Sequence[Variant] = (),
        changes: Changes = NONE,
        values: Values | None = None,
    ) -> None:
        """Restart with another variant of the level, with other companion runs.

        `changes` are the effects in which it differs from the original. By default it has the
        current parameters. Raises `SandboxError` if one of them cannot be run; then nothing is
        changed.
        """
        begun = self._built(level, beside, self.values_for(level) if values is None else values)
        self.begun_as, self.changes = level, changes
        self._take_up(LiveRun(self.original, begun))

    def settle(self, setting: "Setting") -> None:
        """Restart with the setting that reaches the level's accuracy, now that it is known."""
        from sandbox.physics.accuracy.calibration_cache import keep

        keep(self.begun_as, self.values, setting)
        self.restart()

    def give_up(self, why: Message) -> None:
        """Stop because no setting that reaches the level's accuracy was found."""
        self._stop(SandboxError(why))

    def attempt(self) -> Attempt | None:
        """Return the state of the level's challenge.

        None without a challenge, once the run is disturbed, or if effects are changed.
        """
        return None if self.changes else self.run.attempt(hurried=self.playing)
