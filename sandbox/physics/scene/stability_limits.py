"""The rates that springs and drag need; below these, leapfrog is unstable."""

from collections.abc import Mapping, Sequence

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.json_positions import Path
from sandbox.model.translatable_message import Message
from sandbox.physics.forces.law import Law, VelocityRotation
from sandbox.physics.forces.spring import SpringForce
from sandbox.physics.joints.exact.joint_failures import SINGULAR
from sandbox.physics.joints.scene_joints import Joints
from sandbox.physics.state.motion import Instant, Motion
from sandbox.physics.state.simulation_errors import SimulationError

MARGIN = 4
"""The advised rate over the least stable one; at it the energy oscillates by at most 6 %."""

READABLE = 1e9
"""Hz, the rate below which all digits are given."""

CLOSE = 1 + 1e-9
"""The largest ratio of the rate needed to the rate given, for rounding errors."""

PROBE = 1e-6
"""m/s, the velocity at which the damping of bodies at rest is determined."""


def check_drag(
    law: Law, names: Sequence[str], start: Motion, joints: Joints, inverse_mass: Array, rate: float
) -> None:
    """Refuse a drag so strong that velocities would alternate and grow from step to step.

    With the velocities that leapfrog extrapolates, the drag must not take more than the whole
    velocity in a step. A drag that grows faster than the velocity is evaluated at the start.

    The law depends on each body's own velocity; `start` is the motion at the start. Since a light
    body joined to a heavy one slows down with it, the `joints` count; for `inverse_mass` and
    `rate`, see `check_springs`. Raises `SimulationError`, which names the effect and the body.
    """
    with np.errstate(all="ignore"):  # the watchdog reports values that are not finite
        decay = np.asarray(_strength(law, start) * inverse_mass[:, 0])
        angular_decay = _angular_decay(law, start, inverse_mass[:, 2])
    if (required_rate := float(angular_decay.max(initial=0.0))) > rate * CLOSE:
        name = names[int(angular_decay.argmax())]
        cause = _acting(law.effect.name, name)
        raise _refused(name, cause, required_rate, rate, ("effects", law.effect.name))
    row = int(decay.argmax())
    if (
        decay[row] > rate * CLOSE
        and (required_rate := _constrained_decay(decay, inverse_mass, joints)) > rate * CLOSE
    ):
        cause = _acting(law.effect.name, names[row])
        raise _refused(names[row], cause, required_rate, rate, ("effects", law.effect.name))


def check_turn(turn: VelocityRotation, names: Sequence[str], start: Motion, rate: float) -> None:
    """Refuse a law that turns velocities by more than 2 rad in a step, as the limit of springs.

    There a circle is too large by a fifth. See `check_drag` for the parameters.
    """
    with np.errstate(all="ignore"):  # the watchdog reports values that are not finite
        rates = np.abs(turn.rate(start))
    row = int(rates.argmax())
    if (required_rate := float(rates[row]) / 2) > rate * CLOSE:
        cause = _acting(turn.effect.name, names[row])
        raise _refused(names[row], cause, required_rate, rate, ("effects", turn.effect.name))


def _strength(law: Law, motion: Motion) -> Array:
    """Return the force of a law on each body over its velocity: (n,) [kg/s]."""
    moving = (motion.velocity != 0).any(axis=1, keepdims=True)
    probe = np.where(moving, motion.velocity, (PROBE, 0.0))
    forces = np.zeros((2, len(probe), 3))
    for force, velocity in zip(forces, (probe, np.zeros_like(probe)), strict=True):
        law.add(Instant.of(motion)._replace(velocity=velocity), force)
    change = forces[0, :, :2] - forces[1, :, :2]
    return np.asarray(np.hypot(*change.T) / np.hypot(*probe.T))


def _angular_decay(law: Law, start: Motion, inverse_mass: Array) -> Array:
    """Return the decay rates of angular velocities by a law, with reactions: (n,) [1/s].

    `inverse_mass`, (n,), has the inverse moments of inertia [1/(kg m²)].
    """
    decay = np.zeros_like(inverse_mass)
    motion = Instant.of(start)
    if not law.effect.exerts_torque:
        return decay

    def change(faster: Array) -> Array:
        """Return how the torques change if bodies turn faster: (n,)."""
        torques = np.zeros((2, len(inverse_mass), 3))
        for torque, more in zip(torques, (np.zeros_like(faster), faster), strict=True):
            law.add(motion._replace(angular_velocity=motion.angular_velocity + more), torque)
        return np.asarray(np.abs(torques[1, :, 2] - torques[0, :, 2]))

    all_faster = PROBE * (1 + np.sin(np.arange(len(inverse_mass))) / 2)  # on two bodies, too
    for row in np.flatnonzero(inverse_mass * change(all_faster)):
        one_faster = np.where(np.arange(len(inverse_mass)) == row, PROBE, 0.0)
        decay[row] = change(one_faster) @ inverse_mass / PROBE
    return decay


def _constrained_decay(decay_of_free: Array, inverse_mass: Array, joints: Joints) -> float:
    """Return the fastest decay with joints [1/s], from the rates of free bodies: (n,) [1/s].

    It is the largest eigenvalue of √M⁻¹ C √M⁻¹ in the directions that exact joints leave free.
    """
    if not joints.together:
        return float(decay_of_free.max())
    stiff = joints.together.two_sided_jacobian()
    if not len(stiff):  # ropes that are slack
        return float(decay_of_free.max())
    joined = np.flatnonzero(stiff.any(axis=(0, 2)))
    others = float(np.delete(decay_of_free, joined).max(initial=0.0))
    constrained = (stiff[:, joined] * np.sqrt(inverse_mass[joined])).reshape(len(stiff), -1)
    _, sizes, directions = np.linalg.svd(constrained, full_matrices=False)
    constrained = directions[sizes > SINGULAR * sizes.max(initial=0.0)]
    decay = np.stack((decay_of_free, decay_of_free, np.zeros_like(decay_of_free)), axis=1)[
        joined
    ].ravel()

    def matrix() -> Array:
        free = np.eye(decay.size) - constrained.T @ constrained
        return np.asarray(free * decay @ free)

    def times(rates: Array) -> Array:
        slowed = decay * (rates - constrained.T @ (constrained @ rates))
        return np.asarray(slowed - constrained.T @ (constrained @ slowed))

    from sandbox.physics.scene.spring_modes import largest_eigenvalue

    return max(others, largest_eigenvalue(decay.size, matrix, times))


def check_springs(
    springs: Mapping[str, SpringForce],
    inverse_mass: Array,
    angle: Array,
    rate: float,
    reach: float = 2.0,
) -> None:
    """Refuse springs that are too stiff, or damp too much, for a rate of steps [Hz].

    `inverse_mass`, (n, 3), is one over mass, mass and moment of inertia [1/kg, 1/(kg m²)]; `angle`,
    (n,), are the angles of the bodies at the start [rad]; `reach` is the largest ω h at which the
    scheme is stable, 2 for leapfrog. Raises `SimulationError`, which names the spring that needs
    the highest rate.
    """
    required_rate, name = stability_limit(springs, inverse_mass, angle)
    required_rate *= 2 / reach
    if required_rate > rate * CLOSE:
        cause = Message("the spring '{name}'", name=name)
        raise _refused(name, cause, required_rate, rate, ("joints", name))


def _acting(effect: str, body: str) -> Message:
    return Message("the effect '{effect}' on '{body}'", effect=effect, body=body)


def _refused(
    subject: str, cause: Message, required_rate: float, rate: float, path: Path
) -> SimulationError:
    if not np.isfinite(required_rate):
        steep = Message(
            "{cause} is infinitely stiff near its state at the start; no 'rate' is enough",
            cause=cause,
        )
        return SimulationError(subject, 0.0, steep, path=path)
    least_rate = Message("{least:.3g}", least=required_rate)
    if required_rate < READABLE:
        least_rate = Message("{least:,.0f}", least=np.ceil(required_rate))
    reason = Message(
        "{cause} needs a 'rate' of at least {least}, not {rate:g}",
        cause=cause,
        least=least_rate,
        rate=rate,
    )
    return SimulationError(subject, 0.0, reason, MARGIN * required_rate, path)


def stability_limit(
    springs: Mapping[str, SpringForce], inverse_mass: Array, angle: Array
) -> tuple[float, str]:
    """Return the rate at which springs are just stable [Hz], and the spring that needs most alone.

    See `check_springs` for the parameters.
    """
    if not springs:
        return 0.0, ""
    from sandbox.physics.scene.spring_modes import SpringModes  # what few levels need

    modes = SpringModes(list(springs.values()), inverse_mass, angle)
    stiffness = np.repeat([spring.largest_stiffness for spring in springs.values()], 2)
    damping = np.repeat([spring.damping for spring in springs.values()], 2)
    with np.errstate(all="ignore"):  # values beyond the range of floats become infinite
        required_rate = just_stable(*(modes.largest(weight) for weight in (stiffness, damping)))
        own_modes = modes.own
        alone_rates = [
            just_stable(k, c)
            for k, c in zip(stiffness * own_modes, damping * own_modes, strict=True)
        ]
    return required_rate, list(springs)[int(np.argmax(alone_rates)) // 2]


def just_stable(stiffness: float, damping: float) -> float:
    """Return the rate at which a mode x'' = −k x − c x' is just stable [Hz].

    At the limit velocities change sign in each step. With the velocity extrapolated from the two
    before, by weights 3/2 and −1/2, this gives k h² / 4 + c h = 1: ω h = 2 without damping.
    """
    return float(damping + np.sqrt(damping**2 + stiffness)) / 2
