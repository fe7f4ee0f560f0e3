"""The stage of located impacts and located ends of slipping, at which drifts are cut.

See `events/located_impacts.py` and `events/slip_ends.py`. An impact in a drift changes the slips,
so the end of slipping is then left to the kick after it.
"""

from functools import partial
from typing import TYPE_CHECKING

from sandbox.model.expressions import Array
from sandbox.physics.energy.step_record import StepRecord
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.stepping.stage import Setup, Stage

if TYPE_CHECKING:
    from sandbox.physics.events.located_impacts import ImpactLocator
    from sandbox.physics.events.slip_ends import SlipEndLocator


def make(setup: Setup) -> Stage:
    """Make the stage."""
    located, stops = _located(setup), _stops(setup)
    cuts = Cuts(setup, located, stops)
    return Stage(
        before_drift=cuts.cut,
        after_step=stops.look if stops else None,
        started=cuts.start,
        contacts=cuts.contacts if stops else None,
        begun=cuts.begun,
        impacts=(lambda: located.impacts) if located else None,
        record=cuts.record,
        calls=sum(part is not None for part in (located, stops)),
    )


class Cuts:
    """Cuts the coming drift at impacts, or else at ends of slipping."""

    def __init__(
        self, setup: Setup, located: "ImpactLocator | None", stops: "SlipEndLocator | None"
    ) -> None:
        self._forces, self._scene, self._dt = setup.forces, setup.scene, setup.kicks.clock.dt
        self._located, self._stops = located, stops

    def start(self, begun: Array, acceleration: Array) -> Array | None:
        """Start from a motion; return the accelerations right at the start if they are known."""
        known = self._stops.start(begun, acceleration) if self._stops else None
        if self._located:
            self._located.begin(begun, acceleration if known is None else known)
        return known

    def cut(self) -> None:
        """Let bodies collide, or slipping end, in the coming drift."""
        if located := self._located:
            self._collide(located)
        if stops := self._stops:
            if located and located.impacts:
                stops.drop(located.begun)
            elif cut := stops.cut():
                self._forces.restart(cut.begun - cut.acceleration * self._dt)
                if located:
                    located.begun = cut.begun

    def _collide(self, located: "ImpactLocator") -> None:
        sequence = self._scene.sequence
        if cut := located.cut(self._forces.smooth, sequence.last.jump if sequence else None):
            self._forces.shift(cut.jump)
            if sequence:
                sequence.shift(cut.jump, cut.change)

    def contacts(self) -> Contacts:
        """Return the contacts of the last kick, which may have been taken again."""
        return (self._stops and self._stops.kicked) or self._scene.batch.contacts()

    def begun(self) -> Array:
        """Return the velocities at the beginning of the last kick: (n, 3) [m/s, rad/s]."""
        cutting = self._stops or self._located
        assert cutting
        return cutting.begun

    def record(self, step: StepRecord) -> StepRecord:
        """Add the impacts and the ends of slipping in the drift of a step to its record."""
        collided = self._located.last if self._located else None
        return step._replace(
            over=len(collided.impacts) if collided else 0,
            impacts=collided,
            stop=self._stops.last if self._stops else None,
        )


def _located(setup: Setup) -> "ImpactLocator | None":
    contact = setup.level.effects.contact
    if contact is None or contact.located is None:
        return None
    from sandbox.physics.events.located_impacts import locate

    return locate(setup.level, setup.values, setup.scene, setup.kicks.clock.dt)


def _stops(setup: Setup) -> "SlipEndLocator | None":
    friction = setup.level.effects.friction
    if friction is None or friction.located is None:
        return None
    from sandbox.physics.events.post_event_accelerations import ContinuationSolver
    from sandbox.physics.events.slip_ends import stop

    scene, kicks, forces = setup.scene, setup.kicks, setup.forces
    onwards = partial(ContinuationSolver, scene, kicks.settle, kicks.tried, kicks.clock.dt)
    return stop(setup.level, setup.values, scene, onwards, lambda: forces.smooth, kicks.clock.dt)
