"""The rate that springs and drag need: below it, leapfrog is unstable."""

from collections.abc import Mapping, Sequence
from math import inf

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.json_positions import Path
from sandbox.model.message import Message
from sandbox.physics.forces.law import Law, Turn
from sandbox.physics.forces.spring import SpringForce
from sandbox.physics.joints.exact.joint_failures import SINGULAR
from sandbox.physics.joints.joints import Joints
from sandbox.physics.state.errors import SimulationError
from sandbox.physics.state.motion import Instant, Motion

MARGIN = 4
"""The advised rate as a multiple of the least: there the energy swings by 6 % at most."""

READABLE = 1e9
"""Hz, up to which a rate is given to the last digit."""

CLOSE = 1 + 1e-9
"""How much a rate may be too low, by rounding."""

PROBE = 1e-6
"""m/s, the velocity at which the damping of bodies at rest is determined."""


def check_drag(
    law: Law, names: Sequence[str], start: Motion, joints: Joints, inverse_mass: Array, rate: float
) -> None:
    """Refuse a law that slows a body down so strongly that each step would throw it back further.

    As leapfrog guesses velocities, a law may take no more than all of one in a step. One that grows
    faster than the velocity is known where it begins.

    Parameters
    ----------
    law
        One that depends on each body's own velocity.
    names, inverse_mass
        (n,) and (n, 3), of the bodies; see `check_springs`.
    start
        Their motion at the start.
    joints
        Those of the scene: a light body that is held to a heavy one is slowed down with it.
    rate
        Steps a second [Hz].

    Raises
    ------
    SimulationError
        If the scene is not stable at that rate; it names the effect and the body.
    """
    with np.errstate(all="ignore"):  # what is not finite is told by the watchdog
        taken = np.asarray(_strength(law, start) * inverse_mass[:, 0])
        braked = _braking(law, start, inverse_mass[:, 2])
    if (needed := float(braked.max(initial=0.0))) > rate * CLOSE:
        name = names[int(braked.argmax())]
        cause = _acting(law.effect.name, name)
        raise _refused(name, cause, needed, rate, ("effects", law.effect.name))
    row = int(taken.argmax())
    if taken[row] > rate * CLOSE and (needed := _held(taken, inverse_mass, joints)) > rate * CLOSE:
        cause = _acting(law.effect.name, names[row])
        raise _refused(names[row], cause, needed, rate, ("effects", law.effect.name))


def check_turn(turn: Turn, names: Sequence[str], start: Motion, rate: float) -> None:
    """Refuse a law that turns velocities by more than 2 rad in a step, as springs' limit is.

    A circle would be wider than it should be by a fifth of it; see `check_drag` for the parameters.
    """
    with np.errstate(all="ignore"):  # what is not finite is told by the watchdog
        turning = np.abs(turn.rate(start))
    row = int(turning.argmax())
    if (needed := float(turning[row]) / 2) > rate * CLOSE:
        cause = _acting(turn.effect.name, names[row])
        raise _refused(names[row], cause, needed, rate, ("effects", turn.effect.name))


def _strength(law: Law, motion: Motion) -> Array:
    """Return the force of a law on each body over its velocity: (n,) [kg/s]."""
    moving = (motion.velocity != 0).any(axis=1, keepdims=True)
    probe = np.where(moving, motion.velocity, (PROBE, 0.0))
    forces = np.zeros((2, len(probe), 3))
    for force, velocity in zip(forces, (probe, np.zeros_like(probe)), strict=True):
        law.add(Instant.of(motion)._replace(velocity=velocity), force)
    change = forces[0, :, :2] - forces[1, :, :2]
    return np.asarray(np.hypot(*change.T) / np.hypot(*probe.T))


def _braking(law: Law, start: Motion, inverse_mass: Array) -> Array:
    """Return how fast a law slows down the turning of each body, with what it turns against: (n,).

    Parameters
    ----------
    inverse_mass
        (n,), one over the moments [1/(kg m²)].
    """
    found = np.zeros_like(inverse_mass)
    motion = Instant.of(start)
    for row in np.flatnonzero(inverse_mass) if law.effect.twists else ():
        torques = np.zeros((2, len(inverse_mass), 3))
        for torque, more in zip(torques, (0.0, PROBE), strict=True):
            spin = motion.angular_velocity.copy()
            spin[row] += more
            law.add(motion._replace(angular_velocity=spin), torque)
        change = np.abs(torques[1, :, 2] - torques[0, :, 2]) / PROBE
        found[row] = change @ inverse_mass
    return found


def _held(taken: Array, inverse_mass: Array, joints: Joints) -> float:
    """Return the fastest decay that joints leave [1/s], of those of free bodies: (n,).

    The largest eigenvalue of √M⁻¹ C √M⁻¹ in the directions that exact joints leave free.
    """
    decay = np.stack((taken, taken, np.zeros_like(taken)), axis=1).ravel()
    if not joints.together:
        return float(decay.max())
    kept = joints.together.stiff().reshape(-1, decay.size) * np.sqrt(inverse_mass.ravel())
    _, sizes, directions = np.linalg.svd(kept, full_matrices=False)
    kept = directions[sizes > SINGULAR * sizes.max(initial=0.0)]
    free = np.eye(decay.size) - kept.T @ kept
    return float(np.linalg.eigvalsh(free * decay @ free)[-1])


def check_springs(
    springs: Mapping[str, SpringForce],
    inverse_mass: Array,
    angle: Array,
    rate: float,
    reach: float = 2.0,
) -> None:
    """Refuse springs that are too stiff, or damp too much, for a rate.

    Parameters
    ----------
    springs
        All of a scene, by name.
    inverse_mass
        (n, 3), one over mass, mass and moment [1/kg, 1/(kg m²)].
    angle
        (n,), of the bodies at the start [rad].
    rate
        Steps a second [Hz].
    reach
        The largest ω h at which the scheme is stable; 2 for leapfrog.

    Raises
    ------
    SimulationError
        If the scene is not stable at that rate; it names the spring that asks for most.
    """
    needed, name = limit(springs, inverse_mass, angle)
    needed *= 2 / reach
    if needed > rate * CLOSE:
        cause = Message("the spring '{name}'", name=name)
        raise _refused(name, cause, needed, rate, ("joints", name))


def _acting(effect: str, body: str) -> Message:
    return Message("the effect '{effect}' on '{body}'", effect=effect, body=body)


def _refused(
    subject: str, cause: Message, needed: float, rate: float, path: Path
) -> SimulationError:
    least = Message("{least:.3g}", least=needed)
    if needed < READABLE:
        least = Message("{least:,.0f}", least=np.ceil(needed))
    reason = Message(
        "{cause} needs a 'rate' of at least {least}, not {rate:g}",
        cause=cause,
        least=least,
        rate=rate,
    )
    return SimulationError(subject, 0.0, reason, MARGIN * needed, path)


def limit(
    springs: Mapping[str, SpringForce], inverse_mass: Array, angle: Array
) -> tuple[float, str]:
    """Return the rate at which springs are just stable [Hz], and the name of the stiffest.

    See `check_springs` for what they are given.
    """
    if not springs:
        return 0.0, ""
    delassus = _delassus(list(springs.values()), inverse_mass, angle)
    stiffness = np.repeat([spring.steepness for spring in springs.values()], 2)
    damping = np.repeat([spring.damping for spring in springs.values()], 2)
    with np.errstate(all="ignore"):  # what is more than a number holds is infinite
        needed = just_stable(*(_largest(delassus, weight) for weight in (stiffness, damping)))
        own = delassus.diagonal()
        alone = [just_stable(k, c) for k, c in zip(stiffness * own, damping * own, strict=True)]
    return needed, list(springs)[int(np.argmax(alone)) // 2]


def just_stable(stiffness: float, damping: float) -> float:
    """Return the rate at which a mode is just stable [Hz].

    At the limit velocities change sign each step. In that, x'' = −k x − c x' with the velocity
    guessed from the two before, 3/2 and −1/2, gives k h² / 4 + c h = 1: ω h = 2 without damping.
    """
    return float(damping + np.sqrt(damping**2 + stiffness)) / 2


def _largest(delassus: Array, weight: Array) -> float:
    """Return the largest eigenvalue of M⁻¹ K, by that of √k J M⁻¹ Jᵀ √k."""
    root = np.sqrt(weight)
    matrix = root[:, None] * delassus * root
    return float(np.linalg.eigvalsh(matrix)[-1]) if np.isfinite(matrix).all() else inf


def _delassus(springs: list[SpringForce], inverse_mass: Array, angle: Array) -> Array:
    """Return how the ends of springs part by unit forces along others: J M⁻¹ Jᵀ, (2 s, 2 s).

    Each counts in both directions of the plane, for it may come to point in any.
    """
    jacobian = np.zeros((len(springs), 2, len(inverse_mass), 3))
    for row, spring in zip(jacobian, springs, strict=True):
        for end, sign in zip(spring.ends, (-1.0, 1.0), strict=True):
            if end.body is not None:
                arm = end.point * np.exp(1j * angle[end.body])
                row[0, end.body] += sign * np.array([1.0, 0.0, -arm.imag])
                row[1, end.body] += sign * np.array([0.0, 1.0, arm.real])
    flat = jacobian.reshape(2 * len(springs), -1)
    return np.asarray(flat * inverse_mass.ravel() @ flat.T)
