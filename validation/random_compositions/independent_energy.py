"""The energy of a run, computed from the bodies' positions, and bounds on its error."""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.state.snapshot import Snapshot
from validation.random_compositions.independent_shape_properties import is_dynamic, moment
from validation.random_compositions.joint_constraints import JointConstraints, Places
from validation.random_compositions.recorded_run import RecordedRun
from validation.stability.scene_parts import Document

ROUGHEST = 0.067
"""The relative error of leapfrog's energy at the rate that the sandbox advises: there ω dt = 1/2,
and 1 / (1 − (ω dt / 2)²) = 1.067."""

USUAL = 0.9
"""The share of a run that determines the second-order error where bodies touch: impacts do not
count, and a run that goes wrong must not set its own bound."""

PEAKS = 4
"""The largest second-order error, as a multiple of that of this share."""

ROUNDING = 1e-12
"""The rounding of a thousand steps, as a share of the largest energy."""

TINY = 1e-15
"""The energy scale of a scene without energy [J]."""

NEXT = 2
"""All terms of an error as a multiple of its leading term, since they fall by ω dt <= 1/2."""

SLIGHT = 1e-4
"""The step of a second difference along straight lines [s]; its error is 3e-5 at ω = 200 rad/s."""

SINGULAR = 1e-12
"""The share of the stiffest row's stiffness below which joints count as redundant."""

TAUT = 1e-9
"""The tolerance within which a rope is taut [m]; see `property_checks.JOINTS`."""

KNOWN = 3e-9
"""The precision of heights [m]: surfaces have a skin of 1e-9 m, and joints hold to as much."""


class Energies:
    """The energies of a run; T instants, n bodies."""

    def __init__(self, recorded: RecordedRun, keeping: JointConstraints) -> None:
        document, seen = recorded.scene.document, recorded.states
        bodies = list(document["bodies"].values())
        self._recorded, self._keeping = recorded, keeping
        self._mass = np.array([float(b["mass"]) if is_dynamic(b) else 0.0 for b in bodies])
        self._moment = np.array([moment(b) if is_dynamic(b) else 0.0 for b in bodies])
        if "rotation" not in document["effects"]:
            self._moment[:] = 0.0
        gravity = document["effects"].get("gravity", {}).get("acceleration", (0.0, 0.0))
        self._gravity = np.array(gravity, dtype=float)
        squares = np.sum(seen.velocity**2, axis=-1)
        spins = seen.angular_velocity**2
        self._each: Array = (squares * self._mass + spins * self._moment) / 2
        self.kinetic: Array = self._each.sum(axis=1)
        self.stored: Array = self._springs(document, keeping)
        self.high: Array = -(seen.position @ self._gravity) @ self._mass
        self.total: Array = self.kinetic + self.stored + self.high

    @property
    def momentum(self) -> Array:
        """The momentum in x and y, and about the origin: (T, 3) [N s, N s, N m s]."""
        seen = self._recorded.states
        linear = np.einsum("n,tnc->tc", self._mass, seen.velocity)
        x, y = seen.position[..., 0], seen.position[..., 1]
        orbital = (x * seen.velocity[..., 1] - y * seen.velocity[..., 0]) @ self._mass
        return np.column_stack((linear, orbital + seen.angular_velocity @ self._moment))

    @property
    def bustle(self) -> Array:
        """The sums of the bodies' absolute momenta: (T, 3)."""
        seen = self._recorded.states
        sizes = np.hypot(seen.velocity[..., 0], seen.velocity[..., 1])
        linear = sizes @ self._mass
        far = np.hypot(seen.position[..., 0], seen.position[..., 1])
        spin = np.abs(seen.angular_velocity) @ self._moment
        return np.column_stack((linear, linear, (sizes * far) @ self._mass + spin))

    def weight(self) -> float:
        """Return the total weight [N]."""
        return float(self._mass.sum() * np.hypot(*self._gravity))

    def turnover(self) -> float:
        """Return the energy that was converted, exchanged, or was added by drives [J]."""
        swings = [float(np.ptp(e)) for e in (self.kinetic, self.stored, self.high)]
        return max(min(max(*swings, self._exchanged()), self._there()), self._recorded.worked)

    def _exchanged(self) -> float:
        """Return the most kinetic energy that a body took or gave, other than in an impact [J].

        Where joints alone act, the kinetic energy of all bodies is constant, and its swing is
        nothing but the error that it is to bound.
        """
        pairs = self._recorded.pairs
        ends = [i for i in range(1, len(pairs)) if pairs[i] != pairs[i - 1]]
        parts = np.split(self._each, ends)
        return max(float(np.ptp(part, axis=0).max()) for part in parts)

    def _there(self) -> float:
        """Return the energy that could be converted in free fall, an independent bound [J]."""
        t = float(self._recorded.states.t[-1])
        speeds = np.hypot(*self._recorded.states.velocity[0].T)
        fallen = self._mass @ (speeds * t + np.hypot(*self._gravity) * t**2 / 2)
        lifted = float(np.hypot(*self._gravity) * fallen)
        return float(self.kinetic[0] + self.stored[0]) + lifted

    def second_order(self) -> float:
        """Return the second-order error of leapfrog's energy [J].

        Leapfrog conserves H + dt² (v · V'' v / 12 − F · M⁻¹ F / 24) to higher order (Hairer, Lubich
        and Wanner, Geometric Numerical Integration, IX.8). Here |v · V'' v| = |m v · da/dt|, and F
        includes the forces of joints. The difference between two times may be twice as large.
        """
        seen, dt = self._recorded.states, self._recorded.dt
        pulls = np.sum(seen.acceleration**2, axis=-1) @ self._mass
        pulls += seen.angular_acceleration**2 @ self._moment
        if len(pulls) < 3:
            return 0.0
        change = np.hypot(*np.moveaxis(np.diff(seen.acceleration, axis=0), -1, 0)) / dt
        turn = np.abs(np.diff(seen.angular_acceleration, axis=0)) / dt
        speed = np.hypot(seen.velocity[1:, :, 0], seen.velocity[1:, :, 1])
        jerks = (speed * change) @ self._mass
        jerks += (np.abs(seen.angular_velocity[1:]) * turn) @ self._moment
        touching = "contact" in self._recorded.scene.document["effects"]
        share, peak = (USUAL, PEAKS) if touching else (1.0, 1.0)
        usual = np.quantile(pulls, share) / 12 + np.quantile(jerks, share) / 6
        return float(peak * dt**2 * usual)

    def swings(self, state: Snapshot) -> float:
        """Return the error of leapfrog's energy where joints curve motion the most [J].

        `state` is the motion, of this run or of a finer one; the step is that of this run.

        Constraint forces do no work, v · M a = 0, so v · M da/dt = −a · M a, and the terms of
        `second_order` become a · M a dt² / 4. The acceleration by a constraint follows from
        positions and velocities alone: J a = −dJ/dt v, with the least a · M a (Gauss). So a kick
        that goes wrong does not set its own bound, except by the share (ω dt)² / 2 of the motion it
        causes.
        """
        places = Places(state.position[..., 0], state.position[..., 1], state.angle, state.t)
        _, slopes = self._keeping.slopes(places)
        if not slopes.size:
            return 0.0
        bends = self._bends(state, places)
        held = np.stack(
            [~kept.pulls_only | (kept.violation > -TAUT) for kept in self._keeping(places)]
        )
        slopes, bends = slopes * held.T[..., None, None], bends * held.T
        inertia = np.stack((self._mass, self._mass, self._moment), axis=1)
        ease = np.divide(1.0, inertia, out=np.zeros_like(inertia), where=inertia > 0)
        mass = np.einsum("tinc,nc,tjnc->tij", slopes, ease, slopes)
        pulls = np.linalg.pinv(mass, SINGULAR, hermitian=True) @ bends[..., None]
        return float(np.einsum("ti,ti->t", bends, pulls[..., 0]).max() * self._recorded.dt**2 / 4)

    def _bends(self, state: Snapshot, poses: Places) -> Array:
        """Return the second time derivatives of the constraints in straight motion: (T, m)."""
        x, y = np.moveaxis(state.velocity, -1, 0)
        there = []
        for way in (-SLIGHT, 0.0, SLIGHT):
            moved = poses.x + way * x, poses.y + way * y
            turned = poses.angle + way * state.angular_velocity
            kept = self._keeping(Places(*moved, turned, poses.t + way))
            there.append(np.stack([row.violation for row in kept], axis=1))
        return np.asarray((there[0] - 2 * there[1] + there[2]) / SLIGHT**2)

    def landings(self) -> float:
        """Return the error of the energy where bodies land on each other within a drift [J].

        The ledger books the impact at the step. A force in a kick, with impulse m a dt, does its
        work at the mean of the velocities before and after it, each for half of the step. Half of
        that work may therefore be off by their difference: m a dt Δv / 4.
        """
        recorded, seen = self._recorded, self._recorded.states
        met = [i for i in range(2, recorded.steps) if recorded.pairs[i] - recorded.pairs[i - 1]]
        if not met:
            return 0.0
        at = np.array(met)
        jumps = np.hypot(*np.moveaxis(seen.velocity[at + 1] - seen.velocity[at - 2], -1, 0))
        pulls = np.hypot(*np.moveaxis(seen.acceleration[at - 2], -1, 0))
        pulls = np.maximum(pulls, np.hypot(*self._gravity))
        return float(np.sum((pulls * jumps) @ self._mass)) * recorded.dt / 4

    def allowed(self, overlapped: float) -> float:
        """Return the largest allowed error of the energy [J], from the depths of all overlaps [m].

        An impact that is found late begins with an overlap, and the bodies in it are then pushed
        apart.
        """
        largest = max(float(np.abs(e).max()) for e in (self.kinetic, self.stored, self.high))
        late = self.weight() * overlapped + self.landings()
        order = max(self.second_order(), self.swings(self._recorded.states))
        leading = min(order, ROUGHEST * self.turnover()) + late
        return NEXT * leading + self.weight() * KNOWN + ROUNDING * largest + TINY

    def _springs(self, document: Document, keeping: JointConstraints) -> Array:
        """Return the energy stored in springs: (T,) [J]."""
        seen = self._recorded.states
        places = Places(seen.position[..., 0], seen.position[..., 1], seen.angle, seen.t)
        total = np.zeros(len(seen.t))
        for joint in document["joints"].values():
            if joint["type"] == "spring":
                (ax, ay), (bx, by) = (keeping.point(end, places) for end in joint["ends"])
                far = np.hypot(ax - bx, ay - by)
                total += joint["stiffness"] * (far - joint.get("length", far[0])) ** 2 / 2
        return total


def is_passive(document: Document) -> bool:
    """Return whether nothing puts energy into a scene."""
    driven = (
        joint["type"] == "motor" or isinstance(joint.get("length"), str)
        for joint in document["joints"].values()
    )
    moved = (body.get("type") == "kinematic" for body in document["bodies"].values())
    return not (any(driven) or any(moved) or "belt" in document["effects"])
