"""What watches a run, as far as its level can go wrong."""

from functools import partial
from typing import Protocol

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.energy.step_record import Recorded
from sandbox.physics.engine.batch import Contacts
from sandbox.physics.guarding.energy_audit import Audit
from sandbox.physics.guarding.watchdog import Watchdog
from sandbox.physics.state.snapshot import Snapshot


class Watch(Protocol):
    """Looks at what is observed anyway, and changes nothing."""

    @property
    def good(self) -> Snapshot:
        """The last state in which all was well, as far as was looked."""

    def look(
        self,
        now: Snapshot,
        contacts: Contacts,
        before: Array,
        *,
        disturbed: bool,
        cut: bool = False,
    ) -> None:
        """Look at what was observed; see `Watchdog.look`."""


def make_watch(run: Recorded) -> Watch:
    """Make what watches a run from its present state on, and let it look at that.

    Raises
    ------
    SimulationError
        If something is wrong with it.
    """
    last = run.last
    with np.errstate(all="ignore"):  # what is not finite is told by name
        audit = partial(Audit, run)
        built = run.level, run.values, run.stepping, run.scene
        dog = Watchdog(*built, last.snapshot, last.contacts, audit)
        dog.look(last.snapshot, last.contacts, last.begun, disturbed=True)
    return dog
