"""The plugin of located impacts and located ends of slipping, at which drifts are cut.

See `events/located_impacts.py` and `events/slip_ends.py`. An impact in a drift changes the slips,
so the end of slipping is then left to the kick after it.
"""

from functools import partial
from typing import TYPE_CHECKING

from sandbox.model.expressions import Array
from sandbox.physics.energy.step_record import StepRecord
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.stepping.step_plugin import Plugin, Setup

if TYPE_CHECKING:
    from sandbox.physics.events.located_impacts import ImpactLocator
    from sandbox.physics.events.slip_ends import SlipEndLocator


def make(setup: Setup) -> Plugin:
    """Make the plugin."""
    impacts, slip_ends = _impacts(setup), _slip_ends(setup)
    cuts = Cuts(setup, impacts, slip_ends)
    return Plugin(
        before_drift=cuts.cut,
        after_step=slip_ends.detect if slip_ends else None,
        started=cuts.start,
        contacts=cuts.contacts if slip_ends else None,
        pre_kick_velocity=cuts.pre_kick_velocity,
        impacts=(lambda: impacts.impacts) if impacts else None,
        record=cuts.record,
        calls=sum(part is not None for part in (impacts, slip_ends)),
    )


class Cuts:
    """Cuts the coming drift at impacts, or else at ends of slipping."""

    def __init__(
        self,
        setup: Setup,
        impacts: "ImpactLocator | None",
        slip_ends: "SlipEndLocator | None",
    ) -> None:
        self._forces, self._scene, self._dt = setup.forces, setup.scene, setup.kicks.clock.dt
        self._impacts, self._slip_ends = impacts, slip_ends

    def start(self, velocity: Array, acceleration: Array) -> Array | None:
        """Start from a motion; return the accelerations right at the start if they are known."""
        exact = self._slip_ends.start(velocity, acceleration) if self._slip_ends else None
        if self._impacts:
            self._impacts.begin(velocity, acceleration if exact is None else exact)
        return exact

    def cut(self) -> None:
        """Let bodies collide, or slipping end, in the coming drift."""
        if impacts := self._impacts:
            self._collide(impacts)
        if slip_ends := self._slip_ends:
            if impacts and impacts.impacts:
                slip_ends.leave_to_impact(impacts.pre_kick_velocity)
            elif cut := slip_ends.cut():
                self._forces.restart(cut.pre_kick_velocity - cut.acceleration * self._dt)
                if impacts:
                    impacts.pre_kick_velocity = cut.pre_kick_velocity

    def _collide(self, impacts: "ImpactLocator") -> None:
        sequence = self._scene.sequence
        forces, jump = self._forces, sequence.last.jump if sequence else None
        if cut := impacts.cut(forces.law_acceleration, forces.law_motion, jump):
            forces.shift(cut.jump - cut.acceleration_change * self._dt, cut.wrench_change)
            if sequence:
                sequence.shift(cut.jump, cut.acceleration_change)

    def contacts(self) -> Contacts:
        """Return the contacts of the last kick, which may have been taken again."""
        return (self._slip_ends and self._slip_ends.kicked) or self._scene.batch.contacts()

    def pre_kick_velocity(self) -> Array:
        """Return the velocities at the beginning of the last kick: (n, 3) [m/s, rad/s]."""
        locator = self._slip_ends or self._impacts
        assert locator
        return locator.pre_kick_velocity

    def record(self, step: StepRecord) -> StepRecord:
        """Add the impacts and the ends of slipping in the drift of a step to its record."""
        collided = self._impacts.last if self._impacts else None
        return step._replace(
            impact_count=len(collided.impacts) if collided else 0,
            impacts=collided,
            slip_ends=self._slip_ends.last if self._slip_ends else None,
        )


def _impacts(setup: Setup) -> "ImpactLocator | None":
    contact = setup.level.effects.contact
    if contact is None or contact.located is None:
        return None
    from sandbox.physics.events.located_impacts import locate

    return locate(setup.level, setup.values, setup.scene, setup.kicks.clock.dt)


def _slip_ends(setup: Setup) -> "SlipEndLocator | None":
    friction = setup.level.effects.friction
    if friction is None or friction.located is None:
        return None
    from sandbox.physics.events.post_event_accelerations import ContinuationSolver
    from sandbox.physics.events.slip_ends import stop

    scene, kicks, forces = setup.scene, setup.kicks, setup.forces
    continuation = partial(ContinuationSolver, scene, kicks.settle, kicks.trial, kicks.clock.dt)
    return stop(
        setup.level,
        setup.values,
        scene,
        continuation,
        lambda: forces.law_acceleration,
        kicks.clock.dt,
    )
