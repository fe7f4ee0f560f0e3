"""The plugin of the schemes of higher order: several drifts and kicks, some backwards in time."""

from sandbox.model.expressions import Array
from sandbox.physics.scene.composition_schemes import composition, substeps
from sandbox.physics.stepping.step_plugin import Plugin, Setup


def make(setup: Setup) -> Plugin:
    """Make the plugin: all drifts and kicks of a step but the last, which every step has."""
    leading = LeadingSubsteps(setup)
    return Plugin(before_drift=leading.take, pre_kick_velocity=leading.pre_kick_velocity)


class LeadingSubsteps:
    """Takes all drifts and kicks of a step but the last."""

    def __init__(self, setup: Setup) -> None:
        self._kicks, self._batch = setup.kicks, setup.scene.batch
        is_constrained = setup.scene.joints.together is not None
        scheme = composition(setup.stepping.order, is_constrained=is_constrained)
        self._kicks.compose(substeps(scheme, self._kicks.clock.dt))
        self._pre_kick_velocity = self._batch.velocity()

    def take(self) -> None:
        """Take them, and keep the velocities after them."""
        self._kicks.take_leading_parts()
        self._pre_kick_velocity = self._batch.velocity()

    def pre_kick_velocity(self) -> Array:
        """Return the velocities at the beginning of the last kick: (n, 3) [m/s, rad/s]."""
        return self._pre_kick_velocity
