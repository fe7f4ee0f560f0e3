"""Earlier runs, kept for comparison when a parameter is changed."""

from typing import NamedTuple

from sandbox.app.drawing import theme
from sandbox.app.observing.state_history import History
from sandbox.app.observing.thinned_series import Trail
from sandbox.app.words.language import say
from sandbox.model.expressions import Values
from sandbox.physics.stepping.world import World

BRIEF = 0.05
"""The share of a level's duration that a branch must last to be kept: while a slider is dragged, a
run branches at every step."""


class Observed(NamedTuple):
    """What has been seen of a run.

    Attributes
    ----------
    trail, history
        The paths of its bodies, and everything else that was observed.
    world
        The world that was observed.
    """

    trail: Trail
    history: History
    world: World

    def steps(self) -> int:
        """Return how many steps it has taken."""
        return self.world.steps


class Earlier(NamedTuple):
    """A run with other parameters that was there before.

    Attributes
    ----------
    changed
        The parameters that were changed after it; none where a hand changed it.
    left
        When a branch left it [s]; None if the next run started anew.
    trail, history, world
        As of what was observed.
    """

    changed: frozenset[str]
    left: float | None
    trail: Trail
    history: History
    world: World

    def label(self, now: Values) -> str:
        """Label it by the parameters in which it differs from another run."""
        told = self.changed | _differing(self.world.values, now)
        values = ", ".join(f"{n} = {v:.6g}" for n, v in self.world.values.items() if n in told)
        if self.left is None:
            return values
        if not values:
            return say("left at {t:.2f} s", t=self.left)
        return say("{values}, left at {t:.2f} s", values=values, t=self.left)

    def repeats(self, other: "Earlier") -> bool:
        """Whether it had the parameters of another one, and was left at the same time."""
        return self.left == other.left and self.world.values == other.world.values


def alike(world: World, other: World) -> bool:
    """Whether two worlds have the same bodies, so that one run can be laid over the other."""
    return world is other or list(world.level.bodies) == list(other.level.bodies)


def kept(
    earlier: tuple[Earlier, ...], run: Observed, values: Values, left: float | None = None
) -> tuple[Earlier, ...]:
    """Return the earlier runs with one more; no more of them than there are colours.

    Parameters
    ----------
    earlier
        Those that there are; the newest is last.
    run
        The observations of the run that is left.
    values
        The parameters of what comes after it.
    left
        When a branch left it [s]; None if the next run starts anew.
    """
    made = Earlier(_differing(run.world.values, values), left, *run)
    others = tuple(one for one in earlier if not one.repeats(made))
    if (made.changed and len(others) < len(earlier)) or _is_brief(run):
        return earlier
    return (*others, made)[-len(theme.LANES) :]


def _differing(values: Values, others: Values) -> frozenset[str]:
    return frozenset(name for name, value in values.items() if value != others.get(name, value))


def _is_brief(run: Observed) -> bool:
    """Whether it is a branch that hardly lasted."""
    world, begun = run.world, float(run.history.snapshots.t[0])
    lasted, whole = world.t - begun, world.level.duration(world.values)
    return begun > 0 and lasted < BRIEF * whole
