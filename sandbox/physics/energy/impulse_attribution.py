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
    couples,
    pressed,
    rubbing,
)
from sandbox.physics.energy.impulse_propagation import reached
from sandbox.physics.energy.ledger_entries import Entries
from sandbox.physics.energy.step_record import Recorded, StepRecord
from sandbox.physics.engine.space_arrays import Booleans, Contacts
from sandbox.physics.forces.law import Law, VelocityRotation, exert
from sandbox.physics.forces.spring import damps
from sandbox.physics.forces.velocity_rotation import given
from sandbox.physics.geometry.outline_distance import surfaces
from sandbox.physics.joints.joint_forces import JointForces
from sandbox.physics.state.motion import Instant

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
        own = [j for j in level.joints.values() if not (j.kind.force or is_exact(j))]
        self._driven = any(ledger_accounts.drives(joint, level) for joint in own)
        self._hung = {list(scene.bodies).index(name) for joint in own for name in bodies_of(joint)}

    def begin(self) -> None:
        """Begin a kick, or an impact; all entries until the next call are part of it."""
        self._entries.begin()

    def book(
        self,
        step: StepRecord,
        kick: KickRecord,
        change: Array,
        pulls: JointForces,
        contacts: Contacts,
        slack: Booleans | None,
    ) -> None:
        """Book a kick, or a part of it, with its change of velocities, (n, 3).

        `slack` are the ropes that were slack before it; None where bodies have just stuck together.

        A rope that becomes taut stops all bodies that it reaches at once. There, joints and
        contacts do work on each other within the kick; their total is the loss.
        """
        rest = kick.inertia * change
        rest -= sum((self.force(law, kick) for law in self._laws), np.zeros_like(rest))
        rest -= sum((self._turn(turn, kick) for turn in self._scene.turns), np.zeros_like(rest))
        impulses, works = self._joints(kick, pulls)
        rest -= impulses
        jump = self._jump(step, kick)
        rest -= jump
        rest -= self._own(kick, rest, contacts)
        rest -= self._hand(step, kick, rest, contacts)
        lost = self._touch(kick, rest, kick.work(jump), contacts)
        if slack is None:
            self._entries.lose("sticking", float(works.sum()))
        else:
            moves = kick.inertia[:, 0] > 0
            if kick.length < 0:  # the excess of the ropes is taken back
                pulls = pulls._replace(tension=np.abs(pulls.tension))
            lost += float(works[reached(pulls, contacts, slack, moves)].sum())
        if lost:
            self._entries.lose("impacts", lost)

    def jolt(self, jolt: "Jolt") -> None:
        """Book an impact of joints at one instant: the energy that they take is lost."""
        self.begin()
        kick = KickRecord(
            jolt.t,
            0.0,
            Instant.at(jolt.t, jolt.place, jolt.begun),
            jolt.place[:, :2],
            (jolt.begun + jolt.after) / 2,
            self._mass,
        )
        impulses, works = self._joints(kick, jolt.pulls)
        rest = kick.inertia * (jolt.after - jolt.begun) - impulses
        lost = float(works.sum()) + self._touch(kick, rest, 0.0, jolt.contacts)
        if not jolt.elastic:
            self._entries.lose("impacts", lost)

    def force(self, law: Law, kick: KickRecord) -> Array:
        """Book the impulse of a law, and return it: (n, 3).

        A kinematic body resists the force, and thereby does work.
        """
        every = self._impulse(law, kick)
        impulse = np.where(kick.inertia > 0, every, 0.0)
        self._entries.give(law.effect.name, impulse, kick.place)
        if law.effect.book in ("work", "loss"):
            self._entries.do(law, kick.work(every))
        if "bodies" in self._entries.works:
            self._entries.works["bodies"] -= kick.work(np.where(self._mass[:, :1] > 0, 0.0, every))
        if damps(law):
            elastic = self._impulse(replace(law, damping=0.0), kick)
            self._entries.losses["damping"] += kick.work(every - elastic)
        return impulse

    def _turn(self, turn: VelocityRotation, kick: KickRecord) -> Array:
        """Book the impulse of forces that turn velocities, which do no work; return it: (n, 3)."""
        impulse = np.zeros_like(self._mass)
        change = given(turn.rate(kick.seen), kick.mean[:, :2], kick.length)
        impulse[:, :2] = kick.inertia[:, :2] * change
        self._entries.give(turn.effect.name, impulse, kick.place)
        return impulse

    def _impulse(self, law: Law, kick: KickRecord) -> Array:
        wrench = np.zeros_like(self._mass)
        exert(law, kick.seen, wrench)
        return wrench * kick.length

    def _joints(self, kick: KickRecord, pulls: JointForces) -> tuple[Array, Array]:
        """Book the impulses of the exact joints; return them, (n, 3), and their works, (m,).

        The works of driven joints are booked here, and returned as 0.
        """
        carried = np.where(kick.inertia[:, :1] == 0, kick.mean, 0.0)  # of kinematic bodies
        drives = pulls.changes | (pulls.jacobian * carried != 0).any(axis=(1, 2))
        impulses = -pulls.tension[:, None, None] * pulls.jacobian
        impulses = np.where(kick.inertia > 0, impulses, 0.0)
        works = np.sum(impulses * kick.mean, axis=(1, 2))
        if "joints" in self._entries.works:
            self._entries.works["joints"] += float(works[drives].sum())
        together: Array = impulses.sum(axis=0)
        self._entries.give("supports", together, kick.place)
        return together, np.where(drives, 0.0, works)

    def _own(self, kick: KickRecord, rest: Array, contacts: Contacts) -> Array:
        """Book pymunk's own joints: the rest of the impulse on their bodies, without contacts."""
        impulse = np.zeros_like(rest)
        if not self._hung:
            return impulse
        for row in self._hung:
            impulse[row] = rest[row]
            impulse[row, :2] -= pressed(contacts, row)
        impulse[kick.inertia == 0] = 0.0
        self._entries.give("supports", impulse, kick.place)
        if self._driven:
            self._entries.works["joints"] += kick.work(impulse)
        return impulse

    def _couples(self, kick: KickRecord, contacts: Contacts, impulse: Array) -> Array | float:
        """Return the torques of contacts, (k,), if a kinematic body turns in one; else 0."""
        turns = (self._mass[:, 2] == 0) & (kick.mean[:, 2] != 0)
        if not turns[contacts.bodies].any():
            return 0.0
        return couples(contacts, impulse, kick.place, kick.inertia)

    def _jump(self, step: StepRecord, kick: KickRecord) -> Array:
        """Book the impulses of sequential impacts, and return them: (n, 3)."""
        if step.jump is None:
            return np.zeros_like(self._mass)
        impulse = kick.inertia * step.jump
        self._entries.give("supports", impulse, kick.place)
        return impulse

    def _hand(self, step: StepRecord, kick: KickRecord, rest: Array, contacts: Contacts) -> Array:
        """Book the impulse of a hand, without that of contacts, and return it: (n, 3)."""
        impulse = np.zeros_like(rest)
        hold = step.hold
        if hold is None:
            return impulse
        row, (x, y) = hold
        pull = rest[row, :2] - pressed(contacts, row)
        impulse[row] = *pull, (x * pull[1] - y * pull[0]) * (self._mass[row, 2] > 0)
        self._entries.works["hand"] += kick.work(impulse)
        self._entries.impulses.setdefault("hand", np.zeros(3))
        self._entries.give("hand", impulse, kick.place)
        return impulse

    def _touch(self, kick: KickRecord, rest: Array, jumped: float, contacts: Contacts) -> float:
        """Book the contacts: the remaining impulses on touching bodies, and sequential impacts.

        Return the work of impacts.
        """
        if not len(contacts.bodies):
            return 0.0
        touching = np.zeros(len(rest), dtype=bool)
        touching[contacts.bodies] = True
        impulse = np.where(touching[:, None], rest, 0.0)
        self._entries.give("supports", impulse, kick.place)
        pressing = kick.work(impulse)
        whole = completed(contacts, impulse)
        turned = self._couples(kick, whole, impulse)
        across, drives = rubbing(whole, kick.place, kick.mean, kick.inertia, self._surfaces, turned)
        drives = {name: work for name, work in drives.items() if name in self._entries.works}
        given = jumped + pressing - sum(drives.values())
        if not kick.length:
            # in an impact friction and rebound act at once, and exchange energy
            across = min(max(across, given), 0.0)
        self._entries.put_in(drives)
        if "friction" in self._entries.losses:
            across = self._entries.lose("friction", across)
        lost = given - across
        if lost > 0 and not kick.length and "sticking" in self._entries.losses:
            self._entries.losses["sticking"] += (
                lost  # bodies that stick press on each other in the same impact
            )
            return 0.0
        return 0.0 if self.elastic else lost


def _elastic(run: Recorded) -> bool:
    """Return whether all impacts have e = 1, so that none may take energy."""
    effect, values = run.level.effects.restitution, run.values
    if effect is None:
        return False
    own = [body.restitution for body in run.level.bodies.values() if body.restitution]
    return all(e(values) == 1 for e in (*own, *(pair.coefficient for pair in effect.pairs)))
