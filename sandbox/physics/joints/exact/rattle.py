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
    pose, free = joints.pose(), coordinates_of(mean).values
    driven = coordinates_of(law_acceleration).values
    if joints.band:
        moves, accelerations, tension = _by_band(joints.band, pose, free, driven, drift)
    else:
        moves, accelerations, tension = _by_matrix(joints, pose, free, driven, drift)
    return moves[joints.order], accelerations[joints.order], tension


def _by_matrix(
    joints: JointSystem, pose: Coordinates, free: Array, driven: Array, drift: float
) -> tuple[Array, Array, Array]:
    jacobian = joints.equations.evaluate_without_memory(pose).jacobian
    response = jacobian * joints.inverse
    delassus = jacobian @ response.T
    moves = free - solved(delassus, jacobian @ free) @ response
    way = MOMENT * abs(drift) * moves
    ahead, behind = (
        joints.equations.evaluate_without_memory(Coordinates(pose.values + w)) for w in (way, -way)
    )
    turning = (ahead.jacobian - behind.jacobian) @ moves / (2 * MOMENT * abs(drift))
    tension = solved(delassus, jacobian @ driven + turning)
    return moves, driven - tension @ response, tension


def _by_band(
    band: Banded, pose: Coordinates, free: Array, driven: Array, drift: float
) -> tuple[Array, Array, Array]:
    here = band.linearize(pose)
    moves = free - band.response(here, band.solved(here, here, band.rates(here, free)))
    way = MOMENT * abs(drift) * moves
    ahead, behind = (band.linearize(Coordinates(pose.values + w)) for w in (way, -way))
    turning = band.rates(ahead, moves) - band.rates(behind, moves)
    needed = band.rates(here, driven) + turning / (2 * MOMENT * abs(drift))
    tension = band.solved(here, here, needed)
    return moves, driven - band.response(here, tension), tension
