"""The data of a run that pages, panels, the banner and the stage read."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from sandbox.app.observing.earlier_runs import EarlierRun, RunObservations, have_same_bodies
from sandbox.app.observing.energy_history_and_balance import EnergyHistory
from sandbox.app.observing.thinned_history import ThinnedHistory
from sandbox.app.observing.thinned_series import ThinnedSeries
from sandbox.app.runs.companion_runs import Companion
from sandbox.app.runs.live_run import LiveRun
from sandbox.app.runs.play_speed import PlaySpeed
from sandbox.app.runs.step_timer import StepTimer
from sandbox.app.runs.user_interventions import Action
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.stepping.world import World

if TYPE_CHECKING:
    from sandbox.physics.accuracy.requested_accuracy import Setting


class ReadOnlyRun:
    """Read access to the current run."""

    def __init__(self, run: LiveRun) -> None:
        self.run = run
        """The run; replaced whenever it starts again."""

    @property
    def world(self) -> World:
        """The world of the current run."""
        return self.run.world

    @property
    def level(self) -> Level:
        """The level that is played, with the alterations of the run so far."""
        return self.world.level

    @property
    def resolved(self) -> Level:
        """The level with the stepping of the run, which an accuracy leaves open."""
        return self.level.model_copy(update={"stepping": self.world.stepping})

    @property
    def companions(self) -> tuple[Companion, ...]:
        """The companion runs, in lockstep."""
        return self.run.companions

    @property
    def earlier(self) -> tuple[EarlierRun, ...]:
        """The last runs with other parameters and the same bodies, the newest last."""
        return tuple(run for run in self.run.earlier if have_same_bodies(run.world, self.world))

    @property
    def later(self) -> RunObservations | None:
        """The run before it was rewound, if it had more steps and the same bodies; else None."""
        ahead = self.run.ahead
        farther = ahead is not None and ahead.steps() > self.world.steps
        return ahead if ahead and farther and have_same_bodies(ahead.world, self.world) else None

    @property
    def trail(self) -> ThinnedSeries:
        """The paths of the bodies."""
        return self.run.trail

    @property
    def history(self) -> ThinnedHistory:
        """The states of the current run."""
        return self.run.history

    @property
    def books(self) -> EnergyHistory:
        """The energies of the run, and their balance."""
        return self.run.books

    @property
    def failure(self) -> SandboxError | None:
        """The error that stopped the run, or prevented it from being built, or None."""
        return self.run.failure

    @property
    def values(self) -> Values:
        """The parameters of the current run."""
        return self.world.values

    @property
    def begun_with(self) -> Values:
        """The parameters at the start of the run; it may have branched since."""
        return self.run.begun_with

    @property
    def setting(self) -> "Setting | None":
        """The setting that reaches the accuracy of the level; None while it is unknown."""
        return self.run.setting

    @property
    def actions(self) -> Sequence[Action]:
        """The user's actions on the run so far."""
        return self.run.actions

    @property
    def all_actions(self) -> Sequence[Action]:
        """All actions of the user, also those at later steps that are to be repeated."""
        return self.run.all_actions

    @property
    def clock(self) -> StepTimer:
        """The computing time of the steps."""
        return self.run.clock

    @property
    def pace(self) -> PlaySpeed:
        """The pace at which the machine simulates the run."""
        return self.run.pace

    @property
    def t(self) -> float:
        """The time that is shown [s]."""
        return self.run.t

    @property
    def end(self) -> int:
        """The number of steps in the level's duration."""
        return self.run.end

    @property
    def duration(self) -> float:
        """The time at which the run pauses by itself [s]."""
        return self.end * self.world.dt

    @property
    def span(self) -> int:
        """The number of steps on the time bar: the level's, or more if the run had more."""
        return max(self.end, self.run.farthest.steps())

    @property
    def at_end(self) -> bool:
        """Whether the run is at the end of the level's duration."""
        return self.world.steps == self.end

    @property
    def waiting(self) -> bool:
        """Whether the run waits for the setting that reaches the level's accuracy."""
        return self.run.setting is None and self.world.level.stepping.accuracy is not None

    @property
    def advised(self) -> float | None:
        """The rate at which a run that has failed would succeed [Hz]; None if none is known."""
        if self.run.trying or not isinstance(self.failure, SimulationError):
            return None
        return self.failure.rate

    @property
    def doubted(self) -> bool:
        """Whether the run has failed, but can continue with unreliable results."""
        return self.failure is not None and self.world.doubted

    @property
    def halted(self) -> str:
        """Why the run has paused at a limit of time or memory; empty if it has not."""
        return self.run.limits.message

    @property
    def trace(self) -> Trace:
        """Everything recorded of the run so far."""
        return self.run.trace
