"""What pages, panels, the banner and the stage read of a run."""

from collections.abc import Sequence

from sandbox.app.observing.earlier_runs import Earlier, Observed, alike
from sandbox.app.observing.energy_books import Books
from sandbox.app.observing.state_history import History
from sandbox.app.observing.thinned_series import Trail
from sandbox.app.runs.actions import Action
from sandbox.app.runs.companions import Companion
from sandbox.app.runs.live_run import LiveRun
from sandbox.app.runs.pace import Pace
from sandbox.app.runs.step_clock import Clock
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.physics.accuracy.calibration import Setting
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.stepping.world import World


class RunView:
    """The run that is played now.

    Attributes
    ----------
    run
        It; another one whenever it begins anew.
    """

    def __init__(self, run: LiveRun) -> None:
        self.run = run

    @property
    def world(self) -> World:
        """The world of the present run."""
        return self.run.world

    @property
    def level(self) -> Level:
        """The level that is played, with the alterations of the run so far."""
        return self.world.level

    @property
    def companions(self) -> tuple[Companion, ...]:
        """Other runs beside it, in lockstep."""
        return self.run.companions

    @property
    def earlier(self) -> tuple[Earlier, ...]:
        """The last runs with other parameters and the present bodies, the newest last."""
        return tuple(run for run in self.run.earlier if alike(run.world, self.world))

    @property
    def later(self) -> Observed | None:
        """The run as it was before a way back, if it had come farther; None if it had not.

        None as well if it has other bodies by then.
        """
        ahead = self.run.ahead
        farther = ahead is not None and ahead.steps() > self.world.steps
        return ahead if ahead and farther and alike(ahead.world, self.world) else None

    @property
    def trail(self) -> Trail:
        """Where the bodies have been."""
        return self.run.trail

    @property
    def history(self) -> History:
        """Everything that was observed of the present run."""
        return self.run.history

    @property
    def books(self) -> Books:
        """What energies there were, and where they came from."""
        return self.run.books

    @property
    def failure(self) -> SandboxError | None:
        """Why the run had to stop, or could not be built; None if all is well."""
        return self.run.failure

    @property
    def values(self) -> Values:
        """The parameters of the present run."""
        return self.world.values

    @property
    def begun_with(self) -> Values:
        """The parameters with which the present run began; it may have branched since."""
        return self.run.begun_with

    @property
    def setting(self) -> Setting | None:
        """The setting that reaches the accuracy of the level; None while it is unknown."""
        return self.run.setting

    @property
    def actions(self) -> Sequence[Action]:
        """The user's actions on the run so far."""
        return self.run.actions

    @property
    def all_actions(self) -> Sequence[Action]:
        """What a person has done to the run, also at recorded steps that are still to come."""
        return self.run.all_actions

    @property
    def clock(self) -> Clock:
        """What the steps take."""
        return self.run.clock

    @property
    def pace(self) -> Pace:
        """Whether the machine keeps up."""
        return self.run.pace

    @property
    def t(self) -> float:
        """The time that is shown [s]."""
        return self.run.t

    @property
    def end(self) -> int:
        """How many steps reach the level's duration."""
        return self.run.end

    @property
    def duration(self) -> float:
        """The time at which the run pauses by itself [s]."""
        return self.end * self.world.dt

    @property
    def span(self) -> int:
        """How many steps the bar of the time stands for: the level's, or more if there were."""
        return max(self.end, self.run.farthest.steps())

    @property
    def at_end(self) -> bool:
        """Whether the run stands where its level says that it is complete."""
        return self.world.steps == self.end

    @property
    def waiting(self) -> bool:
        """Whether no time passes before it is known which setting the level asks for."""
        return self.run.setting is None and self.world.level.stepping.accuracy is not None

    @property
    def advised(self) -> float | None:
        """The rate at which a run that had to stop holds; None if none is known [Hz]."""
        if self.run.trying or not isinstance(self.failure, SimulationError):
            return None
        return self.failure.rate

    @property
    def doubted(self) -> bool:
        """Whether the run had to stop, but could go on without being reliable."""
        return self.failure is not None and self.world.doubted

    @property
    def halted(self) -> str:
        """Why it has paused although nothing is wrong with it; empty if it has not."""
        return self.run.limits.message

    @property
    def trace(self) -> Trace:
        """Everything recorded of the run so far."""
        return self.run.trace
