"""The frozen record of a step, from which the energy books are kept."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol

from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.model.shapes import XY
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.scene.substep import Substep
from sandbox.physics.state.motion import Reading
from sandbox.physics.state.snapshot import Snapshot

if TYPE_CHECKING:
    from sandbox.physics.contacts.direct.drifts.fallback_subdivision import DividedDrift
    from sandbox.physics.events.impact_response import DriftImpacts
    from sandbox.physics.events.joint_cuts_and_force_switches import EventEntries
    from sandbox.physics.events.slip_phases import SlipEntries


class StepRecord(NamedTuple):
    """The last observed step of a run; n bodies."""

    steps: int
    """The number of steps taken, with this one."""
    dt: float
    """The time step [s]."""
    snapshot: Snapshot
    contacts: Contacts
    """The state, and the contacts."""
    pre_kick_velocity: Array
    """(n, 3), the velocities at the beginning of the last kick [m/s, rad/s]."""
    post_kick_velocity: Array | None
    """(n, 3), the velocities at its end; None at the start of a run."""
    law_motion: Reading | None
    """The motion that the laws saw in the last kick; None if there are none."""
    law_acceleration: Array
    """(n, 3), the accelerations by gravity and force laws in the last kick [m/s², rad/s²]."""
    turning_acceleration: Array | None
    """(n, 2), the part of these that rotated velocities [m/s²]; None without such forces."""
    parts: Sequence[Substep]
    """The drifts and kicks of the step."""
    trail: Sequence[Array]
    """Positions and velocities after each part but the last: (n, 6) each; empty unless kept."""
    hold: tuple[int, XY] | None
    """The row of the body that a hand holds, and the lever arm from its centre to the grip [m];
    None if it holds none."""
    impact_count: int = 0
    """The number of contacts, first in the list, that were impacts in its drift."""
    impacts: "DriftImpacts | None" = None
    """The located impacts in its drift; None if there were none."""
    slip_ends: "SlipEntries | None" = None
    """The ends of slipping in its drift; None if there were none."""
    events: "EventEntries | None" = None
    """The events in its drift; None if there were none."""
    divided_drift: "DividedDrift | None" = None
    """The parts of its drift, if it was taken in parts; else None."""
    belated_change: Array | None = None
    """(n, 3), the changes of velocities at the beginning of the last kick that make up for what
    forces did differently before it [m/s, rad/s]; None if there are none."""
    velocity_jump: Array | None = None
    """(n, 3), the jumps of velocity in sequential impacts [m/s, rad/s]; None without."""

    @property
    def t(self) -> float:
        """The time [s]."""
        return self.steps * self.dt

    @property
    def composed(self) -> bool:
        """Whether the step had several drifts and kicks."""
        return len(self.parts) > 1


class Measured(Protocol):
    """A run whose quantities are measured."""

    @property
    def level(self) -> Level:
        """The level, which determines the quantities that exist."""

    @property
    def values(self) -> Values:
        """The parameters of the level."""

    @property
    def scene(self) -> Scene:
        """The masses, laws and joints of the bodies."""


class Recorded(Measured, Protocol):
    """A run whose books can be kept."""

    @property
    def stepping(self) -> Stepping:
        """How time advances."""

    @property
    def last(self) -> StepRecord:
        """The last step."""

    def keep_trail(self) -> None:
        """Keep the trail of all further steps."""
