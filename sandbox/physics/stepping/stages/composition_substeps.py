"""The stage of the schemes of higher order: several drifts and kicks, some backwards in time."""

from sandbox.model.expressions import Array
from sandbox.physics.scene.composition_schemes import composition, substeps
from sandbox.physics.stepping.stage import Setup, Stage


def make(setup: Setup) -> Stage:
    """Make the stage: all drifts and kicks of a step but the last, which every step has."""
    parts = LeadingSubsteps(setup)
    return Stage(before_drift=parts.take, begun=parts.begun)


class LeadingSubsteps:
    """Takes all drifts and kicks of a step but the last."""

    def __init__(self, setup: Setup) -> None:
        self._kicks, self._batch = setup.kicks, setup.scene.batch
        held = setup.scene.joints.together is not None
        scheme = composition(setup.stepping.order, held=held)
        self._kicks.compose(substeps(scheme, self._kicks.clock.dt))
        self._begun = self._batch.velocity()

    def take(self) -> None:
        """Take them, and keep the velocities after them."""
        self._kicks.lead()
        self._begun = self._batch.velocity()

    def begun(self) -> Array:
        """Return the velocities at the beginning of the last kick: (n, 3) [m/s, rad/s]."""
        return self._begun
