"""Keyframes: whole states of a run, from which it goes on when the user goes back or ahead.

They are spaced by computing time, so from the last one before a step it takes about as long to get
there, wherever the step is.

Earlier observations are measured in the world that goes back. That shows the same at any step
unless events have switched forces or cut joints, so runs with events have no keyframes.
"""

from time import thread_time
from typing import NamedTuple

from sandbox.physics.energy.ledger import Ledger
from sandbox.physics.stepping.saved_state import SavedState, can_be_saved
from sandbox.physics.stepping.world import World

SPACING = 0.08
"""The computing time from one to the next [s]."""

SHARE = 0.05
"""The largest share of the computing time that saving them may take."""

MEMORY = 20e6
"""The memory of all keyframes of a run [bytes]; beyond it, every second one is dropped."""


class Keyframe(NamedTuple):
    """A saved state of a run."""

    step: int
    """The number of steps taken."""
    recorded: int
    """The number of instants in the recording."""
    state: SavedState
    """The state of the world, and of the ledger of the recording."""


class Keyframes:
    """The keyframes of a run in one world, in the order of their steps."""

    def __init__(self, world: World) -> None:
        self._world = world
        self._kept: list[Keyframe] = []
        self._spacing, self._due, self._spent = SPACING, SPACING, 0.0  # s

    def __len__(self) -> int:
        return len(self._kept)

    def note(self, recorded: int, ledger: Ledger | None, seconds: float) -> None:
        """Note that a step has taken some time [s], and save the state if it is time to.

        The recording has some instants, and perhaps a ledger of this world.
        """
        self._spent += seconds
        last = self._kept[-1] if self._kept else None
        if last and self._world.steps <= last.step:
            self._spent = 0.0
        elif self._spent >= self._due and self._can_be_saved():
            begun = thread_time()
            before = last.state if last else None
            state = SavedState(self._world, ledger, before=before)
            self._kept.append(Keyframe(self._world.steps, recorded, state))
            self._spent = 0.0
            self._due = max(self._spacing, (thread_time() - begun) / SHARE)
            self._thin()

    def _thin(self) -> None:
        if sum(each.state.size for each in self._kept) > MEMORY:
            del self._kept[1::2]
            self._spacing *= 2

    def before(self, step: int) -> Keyframe | None:
        """Return the last keyframe up to a step; None if there is none, or if it cannot be used."""
        found = next((each for each in reversed(self._kept) if each.step <= step), None)
        return found if found and self._can_be_saved() else None

    def _can_be_saved(self) -> bool:
        return not self._world.level.changes_during_run and can_be_saved(self._world)

    def forget_after(self, step: int) -> None:
        """Remove the keyframes after a step, from which the run takes another course."""
        self._kept = [each for each in self._kept if each.step <= step]
