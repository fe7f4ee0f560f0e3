"""Earlier runs, kept for comparison after a parameter was changed."""

from typing import NamedTuple

from sandbox.app.drawing import theme
from sandbox.app.observing.thinned_history import ThinnedHistory
from sandbox.app.observing.thinned_series import ThinnedSeries
from sandbox.app.words.language import say
from sandbox.model.expressions import Values
from sandbox.physics.stepping.world import World

BRIEF = 0.05
"""A branch shorter than this fraction of the level's duration is not kept: while a slider is
dragged, a run branches at every step."""


class RunObservations(NamedTuple):
    """The observations of a run."""

    trail: ThinnedSeries
    """The paths of the bodies."""
    history: ThinnedHistory
    """All states that are kept."""
    world: World
    """The world of the run."""

    def steps(self) -> int:
        """Return the number of steps of the run."""
        return self.world.steps


class EarlierRun(NamedTuple):
    """An earlier run with other parameters or actions."""

    changed: frozenset[str]
    """The parameters that were changed after it; empty if the user acted on the run instead."""
    left: float | None
    """The time at which a branch left it [s]; None if the next run began at the start."""
    trail: ThinnedSeries
    history: ThinnedHistory
    world: World
    """The observations; see `RunObservations`."""

    def label(self, now: Values) -> str:
        """Return a label with the parameters that differ from another run's."""
        differences = self.changed | _differing(self.world.values, now)
        values = ", ".join(
            f"{n} = {v:.6g}" for n, v in self.world.values.items() if n in differences
        )
        if self.left is None:
            return values
        if not values:
            return say("left at {t:.2f} s", t=self.left)
        return say("{values}, left at {t:.2f} s", values=values, t=self.left)

    def repeats(self, other: "EarlierRun") -> bool:
        """Whether the run has the same parameters as another, and was left at the same time."""
        return self.left == other.left and self.world.values == other.world.values


def have_same_bodies(world: World, other: World) -> bool:
    """Whether two worlds have the same bodies, so that their runs can be drawn together."""
    return world is other or list(world.level.bodies) == list(other.level.bodies)


def with_one_more(
    earlier: tuple[EarlierRun, ...], run: RunObservations, values: Values, left: float | None = None
) -> tuple[EarlierRun, ...]:
    """Return the earlier runs with one more, at most as many as there are colours, the newest last.

    `values` are the parameters of the next run. If that is a branch, it leaves the run at the time
    `left` [s].
    """
    made = EarlierRun(_differing(run.world.values, values), left, *run)
    others = tuple(one for one in earlier if not one.repeats(made))
    if (made.changed and len(others) < len(earlier)) or _is_brief(run):
        return earlier
    return (*others, made)[-len(theme.LANES) :]


def _differing(values: Values, others: Values) -> frozenset[str]:
    return frozenset(name for name, value in values.items() if value != others.get(name, value))


def _is_brief(run: RunObservations) -> bool:
    """Whether a run is a branch of very short duration; see `BRIEF`."""
    world, begun = run.world, float(run.history.snapshots.t[0])
    lasted, whole = world.t - begun, world.level.duration(world.values)
    return begun > 0 and lasted < BRIEF * whole
