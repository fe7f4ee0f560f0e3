"""RATTLE: velocities and accelerations that satisfy exact joints at the instant of a step."""

from sandbox.model.expressions import Array
from sandbox.physics.joints.exact.banded_systems import Banded
from sandbox.physics.joints.exact.constraint_conditioning import solved
from sandbox.physics.joints.exact.constraint_interface import Coordinates
from sandbox.physics.joints.exact.joint_system import JointSystem, coordinates_of

MOMENT = 1e-3
"""The fraction of a drift over which the Jacobian is differenced, before and after a step: small
enough for the error, which is of second order, and large enough against rounding."""


def motion(
    joints: JointSystem, mean: Array, law_acceleration: Array, drift: float
) -> tuple[Array, Array, Array]:
    """Return velocities, accelerations and forces at the present positions.

    The mean of the velocities before and after a kick violates J v = 0 at second order; that part
    is removed, as in RATTLE (Andersen 1983). A force of SHAKE is a mean over a kick, which differs
    at second order from the force at the instant itself. That one keeps J v = 0:

        J (a − M⁻¹ Jᵀ λ) + (dJ/dt) v = 0.

    Not for joints that change with time. `mean` are the mean velocities of the n bodies, (n, 3)
    [m/s, rad/s], `law_acceleration` the accelerations without the joints, (n, 3) [m/s², rad/s²],
    and `drift` is the duration of a drift [s].
    """
    pose, free_velocity = joints.pose(), coordinates_of(mean).values
    free_acceleration = coordinates_of(law_acceleration).values
    if joints.band:
        velocity, acceleration, tension = _by_band(
            joints.band, pose, free_velocity, free_acceleration, drift
        )
    else:
        velocity, acceleration, tension = _by_matrix(
            joints, pose, free_velocity, free_acceleration, drift
        )
    return velocity[joints.coordinate_indices], acceleration[joints.coordinate_indices], tension


def _by_matrix(
    joints: JointSystem,
    pose: Coordinates,
    free_velocity: Array,
    free_acceleration: Array,
    drift: float,
) -> tuple[Array, Array, Array]:
    jacobian = joints.equations.evaluate_without_memory(pose).jacobian
    response = jacobian * joints.inverse
    delassus = jacobian @ response.T
    velocity = free_velocity - solved(delassus, jacobian @ free_velocity) @ response
    displacement = MOMENT * abs(drift) * velocity
    ahead, behind = (
        joints.equations.evaluate_without_memory(Coordinates(pose.values + shift))
        for shift in (displacement, -displacement)
    )
    jacobian_rate = (ahead.jacobian - behind.jacobian) @ velocity / (2 * MOMENT * abs(drift))
    tension = solved(delassus, jacobian @ free_acceleration + jacobian_rate)
    return velocity, free_acceleration - tension @ response, tension


def _by_band(
    band: Banded, pose: Coordinates, free_velocity: Array, free_acceleration: Array, drift: float
) -> tuple[Array, Array, Array]:
    at_pose = band.linearize(pose)
    velocity = free_velocity - band.response(
        at_pose, band.solved(at_pose, at_pose, band.rates(at_pose, free_velocity))
    )
    displacement = MOMENT * abs(drift) * velocity
    ahead, behind = (
        band.linearize(Coordinates(pose.values + w)) for w in (displacement, -displacement)
    )
    jacobian_rate = band.rates(ahead, velocity) - band.rates(behind, velocity)
    required_rate = band.rates(at_pose, free_acceleration) + jacobian_rate / (
        2 * MOMENT * abs(drift)
    )
    tension = band.solved(at_pose, at_pose, required_rate)
    return velocity, free_acceleration - band.response(at_pose, tension), tension
