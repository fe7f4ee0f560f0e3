"""Earlier runs, kept for comparison when a parameter is changed."""

from typing import NamedTuple

from sandbox.app.drawing import theme
from sandbox.app.observing.history import History
from sandbox.app.observing.trail import Trail
from sandbox.app.words.language import say
from sandbox.model.expressions import Values
from sandbox.physics.stepping.world import World

BRIEF = 0.05
"""The part of a level's duration that a branch must have lasted for anything of it to stay: while a
slider is dragged, a run branches at every step."""


class Observed(NamedTuple):
    """What has been seen of a run.

    Attributes
    ----------
    trail, history
        Where its bodies have been, and all else that was observed.
    world
        What it was observed of.
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
    values
        The parameters that were changed after it, with the values that they had, in words; empty
        where a hand changed it.
    left
        When a branch left it [s]; None if the next run started anew.
    trail, history, world
        As of what was observed.
    """

    values: str
    left: float | None
    trail: Trail
    history: History
    world: World

    @property
    def label(self) -> str:
        """What it is, in words."""
        if self.left is None:
            return self.values
        if not self.values:
            return say("left at {t:.2f} s", t=self.left)
        return say("{values}, left at {t:.2f} s", values=self.values, t=self.left)


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
        What has been seen of the one that is left.
    values
        The parameters of what comes after it.
    left
        When a branch left it [s]; None if the next run starts anew.
    """
    before = run.world.values
    changed = ", ".join(f"{n} = {v:.6g}" for n, v in before.items() if v != values.get(n, v))
    made = Earlier(changed, left, *run)
    others = tuple(one for one in earlier if one.label != made.label)
    if (changed and len(others) < len(earlier)) or _is_brief(run):
        return earlier
    return (*others, made)[-len(theme.LANES) :]


def _is_brief(run: Observed) -> bool:
    """Whether it is a branch that hardly lasted."""
    world, begun = run.world, float(run.history.snapshots.t[0])
    lasted, whole = world.t - begun, world.level.duration(world.values)
    return begun > 0 and lasted < BRIEF * whole
