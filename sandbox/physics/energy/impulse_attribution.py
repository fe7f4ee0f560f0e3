"""Attribution of a kick's impulses to forces, joints, contacts and the hand."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from sandbox.model import ledger_accounts
from sandbox.model.expressions import Array
from sandbox.model.joints import bodies_of, is_exact
from sandbox.physics.contacts.impacts.contact_work import (
    KickRecord,
    completed,
    contact_friction_work,
    contact_torques,
    normal_impulse,
)
from sandbox.physics.energy.ledger_entries import Entries
from sandbox.physics.energy.step_record import Recorded, StepRecord
from sandbox.physics.energy.taut_rope_jerks import reached_by_jerk
from sandbox.physics.engine.space_arrays import Booleans, Contacts
from sandbox.physics.forces.law import Law, exert
from sandbox.physics.forces.spring import damps
from sandbox.physics.forces.velocity_rotation import mean_acceleration, rotation_rates
from sandbox.physics.geometry.outline_distance import surfaces
from sandbox.physics.joints.joint_forces import JointForces
from sandbox.physics.state.motion import Instant, Reading

if TYPE_CHECKING:
    from sandbox.physics.events.joint_impacts import Jolt


class Attribution:
    """Books the share of each cause in the kicks of a run, in accounts; n bodies.

    If no impact may take energy, `elastic`, a loss is left unexplained.
    """

    def __init__(self, run: Recorded, laws: tuple[Law, ...], entries: Entries) -> None:
        scene, level = run.scene, run.level
        self._scene, self._laws, self._entries = scene, laws, entries
        self._mass = scene.inertia
        self._surfaces = surfaces(scene.bodies.values())
        # in the direct solver, friction takes energy from a rebound
        self.elastic = _elastic(run) and not (scene.direct and level.effects.friction)
        pymunk_joints = [j for j in level.joints.values() if not (j.kind.force or is_exact(j))]
        self._has_drives = any(ledger_accounts.drives(joint, level) for joint in pymunk_joints)
        self._pymunk_jointed = {
            list(scene.bodies).index(name) for joint in pymunk_joints for name in bodies_of(joint)
        }

    def begin(self) -> None:
        """Begin a kick, or an impact; all entries until the next call are part of it."""
        self._entries.begin()

    def book(
        self,
        step: StepRecord,
        kick: KickRecord,
        change: Array,
        joint_forces: JointForces,
        contacts: Contacts,
        slack: Booleans | None,
    ) -> None:
        """Book a kick, or a part of it, with its change of velocities, (n, 3).

        `slack` are the ropes that were slack before it; None where bodies have just stuck together.

        A rope that becomes taut stops all bodies that it reaches at once. There, joints and
        contacts do work on each other within the kick; their total is the loss.
        """
        remaining = kick.inertia * change
        remaining -= sum((self.book_law(law, kick) for law in self._laws), np.zeros_like(remaining))
        remaining -= self._book_rotations(kick)
        impulses, works = self._book_joints(kick, joint_forces)
        remaining -= impulses
        jump_impulse = self._book_sequential_impacts(step, kick)
        remaining -= jump_impulse
        remaining -= self._book_pymunk_joints(kick, remaining, contacts)
        remaining -= self._book_hand(step, kick, remaining, contacts)
        loss = self._book_contacts(kick, remaining, kick.work(jump_impulse), contacts)
        if slack is None:
            self._entries.add_loss("sticking", float(works.sum()))
        else:
            movable = kick.inertia[:, 0] > 0
            if kick.length < 0:  # the excess of the ropes is taken back
                joint_forces = joint_forces._replace(tension=np.abs(joint_forces.tension))
            loss += float(works[reached_by_jerk(joint_forces, contacts, slack, movable)].sum())
        if loss:
            self._entries.add_loss("impacts", loss)

    def book_jolt(self, jolt: "Jolt") -> None:
        """Book an impact of joints at one instant: the energy that they take is lost."""
        self.begin()
        kick = KickRecord(
            jolt.t,
            0.0,
            Instant.at(jolt.t, jolt.pose, jolt.velocity_before),
            jolt.pose[:, :2],
            (jolt.velocity_before + jolt.velocity_after) / 2,
            self._mass,
        )
        impulses, works = self._book_joints(kick, jolt.joint_impulses)
        remaining = kick.inertia * (jolt.velocity_after - jolt.velocity_before) - impulses
        loss = float(works.sum()) + self._book_contacts(kick, remaining, 0.0, jolt.contacts)
        if not jolt.elastic:
            self._entries.add_loss("impacts", loss)

    def book_law(self, law: Law, kick: KickRecord) -> Array:
        """Book the impulse of a law, and return it: (n, 3).

        A kinematic body resists the force, and thereby does work.
        """
        full_impulse = self._impulse(law, kick)
        impulse = np.where(kick.inertia > 0, full_impulse, 0.0)
        self._entries.add_impulse(law.effect.name, impulse, kick.positions)
        if law.effect.book in ("work", "loss"):
            self._entries.add_law_work(law, kick.work(full_impulse))
        if "bodies" in self._entries.works:
            self._entries.works["bodies"] -= kick.work(
                np.where(self._mass[:, :1] > 0, 0.0, full_impulse)
            )
        if damps(law):
            elastic = self._impulse(replace(law, damping=0.0), kick)
            self._entries.losses["damping"] += kick.work(full_impulse - elastic)
        return impulse

    def _book_rotations(self, kick: KickRecord) -> Array:
        """Book the impulses of forces that turn velocities, which do no work; return their sum.

        It is (n, 3). Each force has the share of its rate.
        """
        impulse = np.zeros_like(self._mass)
        if kick.turning_acceleration is None:
            return impulse
        turns, acceleration = self._scene.rotations, kick.turning_acceleration
        if isinstance(kick.law_motion, Reading):
            acceleration = acceleration + mean_acceleration(turns, kick.law_motion.path)
        impulse[:, :2] = kick.inertia[:, :2] * acceleration * kick.length
        whole = rotation_rates(turns, kick.law_motion)
        for turn in turns:
            rate = turn.rate(kick.law_motion)
            share = np.divide(rate, whole, out=np.zeros_like(whole), where=whole != 0)
            self._entries.add_impulse(turn.effect.name, impulse * share[:, None], kick.positions)
        return impulse

    def _impulse(self, law: Law, kick: KickRecord) -> Array:
        wrench = np.zeros_like(self._mass)
        exert(law, kick.law_motion, wrench)
        return wrench * kick.length

    def _book_joints(self, kick: KickRecord, joint_forces: JointForces) -> tuple[Array, Array]:
        """Book the impulses of the exact joints; return them, (n, 3), and their works, (m,).

        The works of driven joints are booked here, and returned as 0.
        """
        prescribed = np.where(
            kick.inertia[:, :1] == 0, kick.mean_velocity, 0.0
        )  # of kinematic bodies
        drives = joint_forces.changes | (joint_forces.jacobian * prescribed != 0).any(axis=(1, 2))
        impulses = -joint_forces.tension[:, None, None] * joint_forces.jacobian
        impulses = np.where(kick.inertia > 0, impulses, 0.0)
        works = np.sum(impulses * kick.mean_velocity, axis=(1, 2))
        if "joints" in self._entries.works:
            self._entries.works["joints"] += float(works[drives].sum())
        total: Array = impulses.sum(axis=0)
        self._entries.add_impulse("supports", total, kick.positions)
        return total, np.where(drives, 0.0, works)

    def _book_pymunk_joints(self, kick: KickRecord, remaining: Array, contacts: Contacts) -> Array:
        """Book pymunk's own joints: the rest of the impulse on their bodies, without contacts."""
        impulse = np.zeros_like(remaining)
        if not self._pymunk_jointed:
            return impulse
        for row in self._pymunk_jointed:
            impulse[row] = remaining[row]
            impulse[row, :2] -= normal_impulse(contacts, row)
        impulse[kick.inertia == 0] = 0.0
        self._entries.add_impulse("supports", impulse, kick.positions)
        if self._has_drives:
            self._entries.works["joints"] += kick.work(impulse)
        return impulse

    def _contact_torques(
        self, kick: KickRecord, contacts: Contacts, impulse: Array
    ) -> Array | float:
        """Return the torques of contacts, (k,), if a kinematic body turns in one; else 0."""
        turns = (self._mass[:, 2] == 0) & (kick.mean_velocity[:, 2] != 0)
        if not turns[contacts.bodies].any():
            return 0.0
        return contact_torques(contacts, impulse, kick.positions, kick.inertia)

    def _book_sequential_impacts(self, step: StepRecord, kick: KickRecord) -> Array:
        """Book the impulses of sequential impacts, and return them: (n, 3)."""
        if step.velocity_jump is None:
            return np.zeros_like(self._mass)
        impulse = kick.inertia * step.velocity_jump
        self._entries.add_impulse("supports", impulse, kick.positions)
        return impulse

    def _book_hand(
        self, step: StepRecord, kick: KickRecord, remaining: Array, contacts: Contacts
    ) -> Array:
        """Book the impulse of a hand, without that of contacts, and return it: (n, 3)."""
        impulse = np.zeros_like(remaining)
        hold = step.hold
        if hold is None:
            return impulse
        row, (x, y) = hold
        pull = remaining[row, :2] - normal_impulse(contacts, row)
        impulse[row] = *pull, (x * pull[1] - y * pull[0]) * (self._mass[row, 2] > 0)
        self._entries.works["hand"] += kick.work(impulse)
        self._entries.impulses.setdefault("hand", np.zeros(3))
        self._entries.add_impulse("hand", impulse, kick.positions)
        return impulse

    def _book_contacts(
        self, kick: KickRecord, remaining: Array, jump_work: float, contacts: Contacts
    ) -> float:
        """Book the contacts: the remaining impulses on touching bodies, and sequential impacts.

        Return the work of impacts.
        """
        if not len(contacts.bodies):
            return 0.0
        touching = np.zeros(len(remaining), dtype=bool)
        touching[contacts.bodies] = True
        impulse = np.where(touching[:, None], remaining, 0.0)
        self._entries.add_impulse("supports", impulse, kick.positions)
        pressing = kick.work(impulse)
        complete = completed(contacts, impulse)
        torques = self._contact_torques(kick, complete, impulse)
        friction_work, drives = contact_friction_work(
            complete, kick.positions, kick.mean_velocity, kick.inertia, self._surfaces, torques
        )
        drives = {name: work for name, work in drives.items() if name in self._entries.works}
        contact_work = jump_work + pressing - sum(drives.values())
        if not kick.length:
            # in an impact friction and rebound act at once, and exchange energy
            friction_work = min(max(friction_work, contact_work), 0.0)
        self._entries.add_works(drives)
        if "friction" in self._entries.losses:
            friction_work = self._entries.add_loss("friction", friction_work)
        loss = contact_work - friction_work
        if loss > 0 and not kick.length and "sticking" in self._entries.losses:
            self._entries.losses["sticking"] += (
                loss  # bodies that stick press on each other in the same impact
            )
            return 0.0
        return 0.0 if self.elastic else loss


def _elastic(run: Recorded) -> bool:
    """Return whether all impacts have e = 1, so that none may take energy."""
    effect, values = run.level.effects.restitution, run.values
    if effect is None:
        return False
    coefficients = [body.restitution for body in run.level.bodies.values() if body.restitution]
    return all(
        e(values) == 1 for e in (*coefficients, *(pair.coefficient for pair in effect.pairs))
    )
