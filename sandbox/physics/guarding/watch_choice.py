"""The watch over a run: its protocol, and its choice by what can go wrong in the level."""

from typing import TYPE_CHECKING, Protocol

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.guarding.lost_bodies import FreeFallWatch
from sandbox.physics.state.snapshot import Snapshot

if TYPE_CHECKING:
    from sandbox.physics.energy.step_record import Recorded


class Watch(Protocol):
    """Checks observations, and changes nothing; for the attributes see `Watchdog`."""

    doubts: bool
    trusts: bool

    @property
    def good(self) -> Snapshot:
        """The last state that passed the checks."""

    def look(
        self,
        now: Snapshot,
        contacts: Contacts,
        before: Array,
        *,
        disturbed: bool,
        cut: bool = False,
    ) -> None:
        """Check an observation; see `Watchdog.look`."""


def make_watch(run: "Recorded", now: Snapshot, contacts: Contacts, begun: Array) -> Watch:
    """Make the watch over a run from a state on, and check that state; see `Watchdog`.

    Raises `SimulationError` if the state fails the checks.
    """
    scene, touching = run.scene, run.level.effects.contact is not None
    watch: Watch
    with np.errstate(all="ignore"):  # the watch reports non-finite values by name
        if touching or scene.laws or scene.turns or run.level.joints:
            from sandbox.physics.guarding.watchdog import Watchdog  # few levels go without

            watch = Watchdog(run, now, contacts)
        else:
            watch = FreeFallWatch(scene, run.stepping, now)
        watch.look(now, contacts, begun, disturbed=True)
    return watch
