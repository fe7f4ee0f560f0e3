"""The watchdog: it stops a run that has gone wrong, and reports why, and a rate that should hold.

It reads the observations that are made anyway, and changes nothing. Energies and the lengths of
joints are expensive, so it checks them only every few observations. Euler's schemes are
deliberately bad: for them it only checks that numbers stay finite, and that the energy does not
keep multiplying.
"""

from math import inf, isfinite
from typing import NoReturn

import numpy as np

from sandbox.model import ledger_accounts
from sandbox.model.expressions import Array
from sandbox.model.translatable_message import NOTHING, Message
from sandbox.physics.contacts.detection.pair_limit import crowded, most_pairs
from sandbox.physics.energy.step_record import Recorded
from sandbox.physics.engine.space_arrays import Contacts, Integers
from sandbox.physics.geometry.body_thickness import thickness
from sandbox.physics.guarding.energy_audit import DrivenAudit, PassiveAudit
from sandbox.physics.guarding.least_step_rate import (
    RateBound,
    damping_bounds,
    law_in_words,
    stiffness_bounds,
)
from sandbox.physics.guarding.non_finite_states import (
    energy_from_scheme,
    is_finite,
    refuse_infinite_energy,
    refuse_non_finite,
    stop_run,
)
from sandbox.physics.scene.stability_limits import MARGIN, stability_limit
from sandbox.physics.state.motion import Instant, kinetic_energy
from sandbox.physics.state.simulation_errors import SimulationError
from sandbox.physics.state.snapshot import Snapshot

EVERY = 8
"""The observations between two checks of energies and joints."""

DEEP = 0.5
"""The greatest overlap with another body, as a share of the thickness."""

HALFWAY = 0.5
"""The share of the allowed overlap above which a pair is watched: a body that is pressed through
another is next seen on its far side, with less overlap."""

LITTLE = 0.01
"""The same share, below which an overlap is negligible."""

PARTED = 0.05
"""The largest error of an exact joint, as a share of the thickness of the thinnest body."""

TURNS = Message(
    "contact forces and those of exact joints are solved in turn here, and do not converge"
)
"""The cause of failures without the direct solver, such as a heavy body on a light one."""

UNNOTICED = 1e-3
"""The relative increase of an overlap over that at the start that is allowed."""

DIVERGED = 1e4
"""The growth of energy that Euler's schemes may have, as a factor."""

TIGHTEST = 1e-3
"""The lower bound on 1 − (ω dt / 2)²."""

NUDGE = 1e-6
"""The displacement for the numerical derivative of a force, as a share of the thickness."""


class Watchdog:
    """Watches a world from its start; n bodies.

    `start` and `contacts` are those at the start of the `run`. `last_good` is the last state that
    passed the checks. `is_doubtful` tells whether it stopped a run that could continue but cannot
    be trusted, because of an overlap, a joint error, or unexplained energy. `ignores_doubts` tells
    whether it lets such runs go on: it then stops only runs that are lost, or too large for a step.
    """

    def __init__(self, run: Recorded, start: Snapshot, contacts: Contacts) -> None:
        level, stepping, scene = run.level, run.stepping, run.scene
        self._scene, self._names, self._rate = scene, list(scene.bodies), stepping.rate
        self._is_strict, self._scheme = not stepping.is_stock, stepping.scheme
        joined = scene.joints.together is not None and level.effects.contact is not None
        self._solves_in_turns = joined and scene.direct is None
        self._most_pairs = most_pairs(stepping.iterations, direct=scene.direct is not None)
        self._thickness = np.where(
            scene.mass > 0, [thickness(body, run.values) for body in level.bodies.values()], inf
        )
        self._allowed: tuple[Integers | None, Array] = None, self._thickness  # allowed overlaps
        self._starts_separated = float(self._depth(contacts).max(initial=0.0)) < LITTLE
        self._deepest = max(1.0, self._depth(contacts).max(initial=0.0) * (1 + UNNOTICED))
        oscillation = self._oscillation(start) if self._is_strict else DIVERGED
        finite_thickness = np.where(np.isfinite(self._thickness), self._thickness, 0.0)
        self._passive_audit = PassiveAudit(
            scene, start, finite_thickness, oscillation, stepping.rate
        )
        self._has_no_input = not ledger_accounts.works(level)
        self._driven_audit = None
        if not stepping.is_composed and not self._has_no_input:
            self._driven_audit = DrivenAudit(
                run, self._passive_audit.negligible, oscillation, not self._is_strict
            )
        self._deep_normals: dict[tuple[int, int], Array] = {}  # normals of deep overlaps, by pair
        self._recent = [start]
        self.last_good = start
        self.is_doubtful = self.ignores_doubts = False
        if not isfinite(self._passive_audit.energies(start)[0]):
            self._refuse_beyond(
                int(np.argmax(kinetic_energy(scene.mass, scene.moment, start))), start
            )

    def check(
        self,
        now: Snapshot,
        contacts: Contacts,
        velocity: Array,
        *,
        disturbed: bool,
        cut: bool = False,
    ) -> None:
        """Check an observation.

        `velocity`, (n, 3), are the velocities at the beginning of the last kick [m/s,
        rad/s]. A hand has given energy to the scene if `disturbed`; impacts have cut the last drift
        if `cut`. Raises `SimulationError` if a body is lost or overlaps too much, a joint has
        parted, or energy is unexplained.
        """
        self.last_good = self._recent[-1]
        self._check_finite(now)
        if len(contacts.bodies) > self._most_pairs:
            self._refuse_crowd(now, contacts)
        if self.ignores_doubts:
            self._recent = [now]
            return
        if self._is_strict and len(contacts.bodies):
            self._check_overlaps(now, contacts)
        direct = self._scene.direct
        drift_velocity = (
            velocity
            if direct is None or direct.drifts.mean_velocity_before is None
            else direct.drifts.mean_velocity_before
        )
        self._passive_audit.add_correction(now, contacts, None if cut else drift_velocity)
        if self._driven_audit and not disturbed:
            self._refuse_if(
                now,
                self._driven_audit.unexplained_energy(
                    now, velocity, self._passive_audit.correction
                ),
            )
        self._recent.append(now)
        if len(self._recent) > EVERY:
            self._check_energy_and_joints(now, disturbed=disturbed)

    def _check_energy_and_joints(self, now: Snapshot, *, disturbed: bool) -> None:
        """Do the expensive checks."""
        self.last_good = self._recent[0]
        if self._is_strict:
            self._check_joint_gaps(now)
        if self._has_no_input and not disturbed:
            self._refuse_if(now, self._passive_audit.unexplained_energy(now))
        self._recent = self._recent[-1:]

    def _check_finite(self, now: Snapshot) -> None:
        if not is_finite(now):
            refuse_non_finite(
                self._names, now, self._rate,
                lambda row: self._non_finite_law(row, now) or self._cause(row),
                self._cause_if_known,
            )  # fmt: skip

    def _cause_if_known(self, row: int) -> tuple[Message, float | None]:
        return self._known_cause(row) or (NOTHING, None)

    def _non_finite_law(self, row: int, now: Snapshot) -> tuple[Message, None] | None:
        """Return the law that has no finite value at the present position or time of a body."""
        last = self._recent[-1]
        position = np.where(np.isfinite(now.position), now.position, last.position)
        motion = Instant.of(last)._replace(t=now.t, position=position)
        for law in self._scene.laws:
            wrench = np.zeros((len(position), 3))
            law.add(motion, wrench)
            if not np.isfinite(wrench[row]).all():
                law_name = law_in_words(self._scene, law)
                return Message(": {law} no longer has a finite value", law=law_name), None
        return None

    def _refuse_beyond(self, row: int, now: Snapshot) -> NoReturn:
        """Stop because a body's energy is not finite."""
        refuse_infinite_energy(self._names, row, now, self._rate, self._cause_if_known)

    def _stop(self, row: int, now: Snapshot, reason: Message, rate: float | None) -> NoReturn:
        stop_run(self._names[row], now, reason, rate, self._rate)

    def _refuse_crowd(self, now: Snapshot, contacts: Contacts) -> NoReturn:
        """Stop because too many bodies touch for a step."""
        row = int(np.bincount(contacts.bodies.ravel()).argmax())
        self._stop(row, now, crowded(self._names[row], self._most_pairs), None)

    def _check_overlaps(self, now: Snapshot, contacts: Contacts) -> None:
        depth = self._depth(contacts)
        worst = int(depth.argmax())
        if depth[worst] > self._deepest:
            deep = float(contacts.depth[worst])
            self._refuse_sunk(now, contacts.bodies[worst].tolist(), deep)
        was_deep, self._deep_normals = self._deep_normals, {}
        if self._deepest > 1 or not (was_deep or depth[worst] > HALFWAY):
            return
        for pair, direction, deep in zip(
            contacts.bodies.tolist(), contacts.direction, (depth > HALFWAY).tolist(), strict=True
        ):
            before = was_deep.get((pair[0], pair[1]))
            if before is not None and before @ direction < 0:
                self._refuse_sunk(now, pair)
            if deep:
                self._deep_normals[pair[0], pair[1]] = direction

    def _refuse_sunk(self, now: Snapshot, pair: list[int], deep: float | None = None) -> NoReturn:
        """Stop because the thinner of two bodies overlaps the other too much, or is past it."""
        self.is_doubtful = True
        a, b = sorted(pair, key=lambda row: float(self._thickness[row]))
        thin, other = self._names[a], self._names[b]
        reason = Message("'{thin}' is pressed through '{other}'", thin=thin, other=other)
        if deep is not None:
            reason = Message(
                "'{thin}' is {deep:.3g} m deep in '{other}', more than half its thickness",
                thin=thin,
                other=other,
                deep=deep,
            )
        speed = np.hypot(*(self._recent[-1].velocity[a] - self._recent[-1].velocity[b]))
        allowed = DEEP * self._thickness[a]
        if speed > allowed * self._rate:
            required_rate = 2 * speed / allowed
            cause = Message(": at {speed:.3g} m/s a step is too long for it", speed=speed)
        else:
            required_rate = 4 * self._rate
            cause = Message(": the load on it is too much for the solver")
        reason = Message("{reason}{cause}", reason=reason, cause=cause)
        self._stop(a, now, reason, required_rate)

    def _depth(self, contacts: Contacts) -> Array:
        """Return the overlaps of pairs as shares of those allowed: (k,)."""
        if contacts.bodies is not self._allowed[0]:  # the same array in most steps
            allowed = DEEP * self._thickness[contacts.bodies].min(axis=1)
            self._allowed = contacts.bodies, allowed
        return np.asarray(contacts.depth / self._allowed[1])

    def _check_joint_gaps(self, now: Snapshot) -> None:
        thinnest = self._thickness.min(initial=inf)
        name, gap = self._scene.joints.parting()
        if gap > PARTED * thinnest:
            self.is_doubtful = True
            reason = Message("the joint '{name}' has parted by {gap:.3g} m", name=name, gap=gap)
            hint = Message("let bodies start apart, or give 'contact' a 'correction' of 0")
            if self._solves_in_turns and self._starts_separated:
                cause = TURNS
                hint = Message("{hint}, or the 'solver' \"direct\"", hint=hint)
            else:
                cause = Message("bodies that overlap are pushed apart against it")
            reason = Message("{reason}: {cause}", reason=reason, cause=cause)
            raise SimulationError(name, float(now.t), reason, hint=hint)

    def _refuse_if(self, now: Snapshot, gained: float) -> None:
        """Stop if there is unexplained energy [J]."""
        if gained:
            self._refuse(now, gained)

    def _refuse(self, now: Snapshot, gained: float) -> NoReturn:
        """Stop because of unexplained energy [J]."""
        row = int(np.argmax(kinetic_energy(self._scene.mass, self._scene.moment, now)))
        if not isfinite(gained):
            self._refuse_beyond(row, now)
        self.is_doubtful = True
        name = self._names[row]
        cause, rate = self._cause(row)
        reason = Message(
            "{gained:.3g} J have come from nowhere, most of them in '{name}'{cause}",
            gained=gained,
            name=name,
            cause=cause,
        )
        self._stop(row, now, reason, rate)

    def _oscillation(self, start: Snapshot) -> float:
        """Return the oscillation of a spring's energy with leapfrog: 1 / (1 − (ω dt / 2)²)."""
        required_rate, _ = stability_limit(
            self._scene.joints.springs, self._scene.inverse_mass, start.angle
        )
        return 1 / max(1 - (required_rate / self._rate) ** 2, TIGHTEST)

    def _cause(self, row: int) -> tuple[Message, float | None]:
        """Return the force that was too strong for a body, and the rate that it needs [Hz]."""
        if not self._is_strict:
            return energy_from_scheme(self._scheme), None
        if known := self._known_cause(row):
            return known
        cause = Message(": {turns}", turns=TURNS) if self._solves_in_turns else NOTHING
        return cause, MARGIN * self._rate

    def _known_cause(self, row: int) -> tuple[Message, float] | None:
        worst = max(self._exceeded_bounds(row), default=None)
        if worst is None:
            return None
        required_rate = MARGIN * worst.rate
        cause = Message(": {subject} changes too fast for a step", subject=worst.subject)
        return cause, required_rate

    def _exceeded_bounds(self, row: int) -> list[RateBound]:
        """Return the needs above the present rate, including a margin.

        Forces that depend on positions are checked in all recent states. Forces that grow with
        velocities have grown because of the failure itself: they are checked in the last good
        state, at the time of the failure.
        """
        nudge = NUDGE * min(float(self._thickness[row]), 1.0)
        bounds = [
            n for state in self._recent for n in stiffness_bounds(self._scene, row, state, nudge)
        ]
        last_good, t = self._recent[0], self._recent[-1].t
        motion = Instant.of(last_good)._replace(t=t)
        bounds += damping_bounds(self._scene, row, motion)
        return [need for need in bounds if MARGIN * need.rate > self._rate]
