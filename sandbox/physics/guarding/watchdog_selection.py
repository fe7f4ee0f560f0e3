"""The watch over a run: its protocol, and its choice by what can go wrong in the level."""

from typing import TYPE_CHECKING, Protocol

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.guarding.non_finite_states import FreeFallWatch
from sandbox.physics.state.snapshot import Snapshot

if TYPE_CHECKING:
    from sandbox.physics.energy.step_record import Recorded


class Watch(Protocol):
    """Checks observations, and changes nothing; for the attributes see `Watchdog`."""

    is_doubtful: bool
    ignores_doubts: bool

    @property
    def last_good(self) -> Snapshot:
        """The last state that passed the checks."""

    def check(
        self,
        now: Snapshot,
        contacts: Contacts,
        velocity: Array,
        *,
        disturbed: bool,
        cut: bool = False,
    ) -> None:
        """Check an observation; see `Watchdog.check`."""


def make_watch(run: "Recorded", now: Snapshot, contacts: Contacts, velocity: Array) -> Watch:
    """Make the watch over a run from a state on, and check that state; see `Watchdog`.

    Raises `SimulationError` if the state fails the checks.
    """
    scene, has_contacts = run.scene, run.level.effects.contact is not None
    watch: Watch
    with np.errstate(all="ignore"):  # the watch reports non-finite values by name
        if has_contacts or scene.laws or scene.rotations or run.level.joints:
            from sandbox.physics.guarding.watchdog import Watchdog  # few levels go without

            watch = Watchdog(run, now, contacts)
        else:
            watch = FreeFallWatch(scene, run.stepping, now)
        watch.check(now, contacts, velocity, disturbed=True)
    return watch
