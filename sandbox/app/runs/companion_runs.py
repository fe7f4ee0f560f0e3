"""Companion runs: the same scene with changes, each in its own world, in lockstep with the run.

They differ from the run by the effects of the level, or by the stepping. The worlds share nothing
but the time that they have reached.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from sandbox.app.drawing import theme
from sandbox.app.drawing.theme import Color
from sandbox.app.observing.checks_of_unfinished_run import Reading, RunGrader
from sandbox.app.observing.thinned_series import ThinnedSeries
from sandbox.app.runs.step_timer import StepTimer
from sandbox.app.words import formatting
from sandbox.app.words.language import say
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Scheme
from sandbox.model.levels_with_changed_effects import Variation
from sandbox.physics.measuring.recording import Recorder, Trace, count_steps, needed
from sandbox.physics.run import build
from sandbox.physics.stepping.time_limit import TimeLimit


@dataclass(frozen=True, slots=True)
class Changes:
    """The effects that are switched off and on in a level."""

    off: tuple[str, ...] = ()
    on: tuple[str, ...] = ()
    effects: tuple[Variation, ...] = ()
    """the changes of each effect"""
    strength: Mapping[str, float] = field(default_factory=dict)
    """the strengths of effects that are switched on, relative to the default"""
    replaced_scheme: Scheme | None = None
    """the level's scheme, if it does not suit the changed level and leapfrog replaces it"""

    def __bool__(self) -> bool:
        return bool(self.effects)

    @property
    def label(self) -> str:
        """The changes in words."""
        label = formatting.variations(self.effects)
        return say("{changes}, both by leapfrog", changes=label) if self.replaced_scheme else label


NONE = Changes()


@dataclass(frozen=True, slots=True)
class Variant:
    """A variant of the level, for a companion run."""

    label: str
    """a short description"""
    level: Level
    """the same bodies, with other effects or another stepping"""
    lane: int
    """the index of its colour in `theme.LANES`"""

    @property
    def color(self) -> Color:
        """The colour of outlines and trails."""
        return theme.LANES[self.lane]


class Companion:
    """A companion run.

    Raises `SandboxError` if the variant cannot be run with these values.
    """

    def __init__(self, variant: Variant, values: Values) -> None:
        self.variant = variant
        self.world = build(variant.level, values)
        self.trail = ThinnedSeries(self.world.snapshot.position)
        """The paths of its bodies."""
        self.clock = StepTimer()
        """The computing time of its steps."""
        self._patience = TimeLimit()
        self.failure: SandboxError | None = None
        """The error that stopped the run, or None."""
        self._end = count_steps(self.world)
        self._recorder = Recorder(self.world, needed(variant.level))
        self._grading = RunGrader(self._recorder)

    def follow(self, t: float) -> None:
        """Take the steps up to a time [s]."""
        while self.failure is None and (self.world.steps + 1) * self.world.dt <= t * (1 + 1e-12):
            self._advance()

    def _advance(self) -> None:
        try:
            snapshot = self.clock.take_step(self.world, self._patience)
        except SandboxError as error:
            self.failure = error
            return
        self.trail.add(snapshot.position)
        if self.world.steps <= self._end:
            self._recorder.note()

    def readings(self, *, hurried: bool) -> tuple[Reading, ...]:
        """Return the results of the checks; if `hurried`, perhaps slightly old ones."""
        return self._grading.readings(hurried)

    @property
    def worst(self) -> float | None:
        """The largest error of the checks so far, or None."""
        return worst(self.readings(hurried=True))

    @property
    def trace(self) -> Trace:
        """Everything recorded so far."""
        return self._recorder.trace


def worst(readings: Iterable[Reading]) -> float | None:
    """Return the largest error of some checks, or None."""
    errors = (reading.result.error for reading in readings)
    return max((error for error in errors if error is not None), default=None)
