"""The session: the level that is played, and how its runs begin. No window is needed."""

from collections.abc import Mapping, Sequence
from contextlib import suppress

from sandbox.app.observing.selected_body import Looking
from sandbox.app.runs.actions import Action
from sandbox.app.runs.beginning import Beginning, at_rate, begin
from sandbox.app.runs.companions import NONE, Changes, Variant
from sandbox.app.runs.live_run import LiveRun
from sandbox.app.runs.playback import Playback
from sandbox.model.errors import SandboxError, ValueRangeError
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.loading import choose
from sandbox.model.message import Message
from sandbox.physics.accuracy.cache import keep
from sandbox.physics.accuracy.calibration import Setting
from sandbox.physics.advising.remedies import Advice
from sandbox.physics.measuring.goals import Attempt
from sandbox.physics.state.errors import SimulationError


class Session(Playback):
    """A level that is played.

    Attributes
    ----------
    original
        The level as its file declares it.
    begun_as
        What its runs begin as: the original, or with other effects, or with another stepping.
    changes
        Which effects were switched off and on.
    branches
        Whether a parameter that is changed acts from now on, instead of from the start.
    looking
        The body that a person looks at, and the forces on it.

    Parameters
    ----------
    level, values, rate
        What is played, and how; as the level says what is left out.
    patient
        Whether an accuracy that the level asks for is waited for, and steps that take long; else
        somebody has to `settle` it, and no time passes before.

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
        self.begun_as = at_rate(level, rate)
        self.changes = NONE
        self.branches = False
        self.looking = Looking()
        begun = self._built(self.begun_as, (), level.defaults if values is None else values)
        super().__init__(LiveRun(level, begun), watched=not patient)
        self._opened = self.level, self.values

    def _built(self, level: Level, beside: Sequence[Variant], values: Values) -> Beginning:
        return begin(level, values, beside, patient=self._patient)

    def _run_with(self, values: Values) -> LiveRun:
        """Return a run with these parameters, and with the same runs beside it."""
        variants = [companion.variant for companion in self.companions]
        begun = self._built(self.begun_as, variants, values)
        return LiveRun(self.original, begun, self.run.earlier)

    def _run_anew(self) -> LiveRun:
        return self._run_with(self.begun_with)

    @property
    def touched(self) -> bool:
        """Whether a person has changed anything since the level was opened."""
        changed = self.companions or self.earlier or self.all_actions
        return bool(changed) or (self.level, self.values) != self._opened

    def values_for(self, level: Level) -> Values:
        """Return the parameters of a level: the present ones, as far as the run has them.

        One that was changed on the way may have others than it began with, or such as the level
        does not allow: then they are those that it began with, or the level's own.
        """
        for known in ({**self.begun_with, **self.values}, self.begun_with):
            with suppress(ValueRangeError):
                return choose(level, {n: known[n] for n in level.parameters if n in known})
        return level.defaults

    @property
    def chosen(self) -> Values:
        """The present parameters of the original; see `values_for`."""
        return self.values_for(self.original)

    def restart(self, settings: Mapping[str, float] | None = None) -> None:
        """Restart with some parameters changed.

        Raises
        ------
        ValueRangeError
            If a parameter cannot have that value.
        """
        values = choose(self.begun_as, {**self.values_for(self.begun_as), **(settings or {})})
        if values != self.values and self.world.steps:
            self.run.keep_as_earlier(values)
        try:
            self._take_up(self._run_with(values))
        except SandboxError as error:
            self._stop(error)

    def rewind(self) -> None:
        """Go back to the start, with what a hand did there and later.

        A run that went on with other parameters or parts starts anew with the present ones.
        """
        if any(action.kind in ("branch", "alter") for action in self.all_actions) or self.failure:
            self.restart()
        else:
            self.go_to(0)

    def forget_earlier(self) -> None:
        """Let nothing stay of the runs with other parameters."""
        self.run.earlier = ()

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
        """Go on from here with changed parameters; the run so far is kept as an earlier run.

        Raises
        ------
        SandboxError
            If that cannot be; then all stays as it was.
        """
        if not self.world.steps and not self.recalled:
            self.restart(settings)
            return
        self._require_one_that_goes_on(Message("with other parameters"))
        self.release()
        self.run.branch(settings)

    def alter(self, text: str) -> None:
        """Go on from here as another level says: that of the present state, with other parts.

        Raises
        ------
        SandboxError
            If that cannot be; then all stays as it was.
        """
        self._require_one_that_goes_on(Message("with other parts"))
        if self.changes:
            message = Message("effects are switched off or on here; switch them back first (X)")
            raise SandboxError(message)
        self.release()
        self.run.alter(text)

    def _require_one_that_goes_on(self, how: Message) -> None:
        if self.companions or self.failure is not None or self.recalled:
            why = Message("it had to stop")
            if self.companions:
                why = Message("other runs go beside it")
            if self.recalled:
                why = Message("it is still on its way")
            raise SandboxError(Message("this run cannot continue {how}: {why}", how=how, why=why))

    def resume(self, actions: Sequence[Action], steps: int, values: Values | None = None) -> None:
        """Take a run again from its start, and stand there; a long way takes some frames.

        Parameters
        ----------
        actions
            The actions on it.
        steps
            How far.
        values
            With which it began; those with which the present one did if left out.

        Raises
        ------
        SandboxError
            If it cannot be built again.
        """
        self._take_up(self._run_with(self.begun_with if values is None else values))
        self.playing = False
        self._take_again(actions, steps)

    def take(self, advice: Advice) -> None:
        """Take in the remedies that were found for a run that had to stop."""
        self.run.trying, self.run.advice = False, advice
        if isinstance(self.failure, SimulationError):
            self.run.failure = self.failure.advised(advice.text, advice.rate)

    def rerun(self, rate: float) -> None:
        """Restart at another rate [Hz]."""
        self.begun_as = at_rate(self.begun_as, rate)
        self.restart()
        self.playing = self.failure is None

    def edit(self, level: Level) -> None:
        """Play an edited level from its start, in place of the present one.

        Raises
        ------
        SandboxError
            If it cannot be run; then all stays as it was.
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
        """Restart with another variant of the level, with other runs beside it.

        Parameters
        ----------
        level
            The original, with other effects or another stepping.
        beside
            What runs beside it.
        changes
            The effects in which it differs from the original.
        values
            The parameters; the present ones if left out.

        Raises
        ------
        SandboxError
            If one of them cannot be run; then all stays as it was.
        """
        begun = self._built(level, beside, self.values_for(level) if values is None else values)
        self.begun_as, self.changes = level, changes
        self._take_up(LiveRun(self.original, begun))

    def settle(self, setting: Setting) -> None:
        """Begin with the setting that its level asks for, now that it is known."""
        keep(self.begun_as, self.values, setting)
        self.restart()

    def give_up(self, why: Message) -> None:
        """Note that the setting that the level asks for could not be found."""
        self._stop(SandboxError(why))

    def attempt(self) -> Attempt | None:
        """Return how the level's challenge stands; None without one, or if the run earns nothing.

        That is so once a hand has touched it, or effects are changed.
        """
        return None if self.changes else self.run.attempt(hurried=self.playing)
