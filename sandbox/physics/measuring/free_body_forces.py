"""All forces on a body at a step, from the impulses that the engine gave it.

A kick of length h around a step changes a velocity from v₋ to v₊. A force is its impulse in the
kick over h: for weight and the force laws, as they acted there; for joints and contacts, from the
impulses of the solver. The acceleration is that over the same kick, a = (v₊ − v₋)/h, which is
leapfrog's acceleration at a step, as quantities and graphs show it. So

    Σ F = m a,    Σ (r × F) + couples = I α

is a claim about the engine, as both sides are computed independently. For variable masses, m is
that at the step, and the momentum flux of the matter is a force (Meshchersky). In a scheme of
fourth order, the forces of joints and the acceleration are those at the step itself (see
`ExactJoints.motion`).

An impact within the kick is a force, too: its impulse over h, which depends on the step as much as
on the impact, and is marked. The sum is then not guaranteed: for a pair that separated and touches
again within three steps, pymunk reports more than its actual impulse. A located impact, within the
drift before the kick, is not included.

pymunk reports no direction for the force of a hand, and of joints with `"exact": false`. Their
force is the rest of m a. If they act, the sum therefore proves nothing, and the diagram is marked.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.joints import bodies_of, is_exact
from sandbox.model.shapes import XY, evaluate
from sandbox.physics.contacts.coefficients.static_friction import BreakawayImpulse
from sandbox.physics.energy.step_record import StepRecord
from sandbox.physics.engine.space_arrays import Contacts
from sandbox.physics.forces.declared_laws import laws_by_entry
from sandbox.physics.forces.law import Law, LawInputs
from sandbox.physics.joints.joint_forces import pulls_on
from sandbox.physics.measuring.contact_forces import (
    ContactForce,
    forces_of_contacts,
    with_breakaway,
    with_torque,
)
from sandbox.physics.measuring.free_body import HAND, IMPACT, AppliedForce, FreeBody
from sandbox.physics.state.joint_anchors import Anchor
from sandbox.physics.state.motion import Instant, Motion
from sandbox.physics.stepping.world import World


class FreeBodies:
    """Makes free-body diagrams for the last observed step of a world.

    It costs a run nothing, and a diagram the work for one body.
    """

    def __init__(self, world: World) -> None:
        self._world, self._scene, level = world, world.scene, world.level
        self._names = list(world.scene.bodies)
        scene = world.scene
        inputs = LawInputs(
            level,
            world.values,
            self._names,
            scene.mass,
            scene.mass_fraction,
            world.dt,
            scene.switches,
        )
        self._laws = list(laws_by_entry(level.effects, inputs))
        self._pymunk_joints = {
            name: tuple(bodies_of(joint))
            for name, joint in level.joints.items()
            if not (is_exact(joint) or joint.kind.force)
        }

    def of(self, body: str) -> FreeBody | None:
        """Return the forces on a body; None if it is immovable, or if none are known yet.

        With a scheme that does not begin with half a kick they are known after its first step.
        Raises `ValueError` if the scene has no such body.
        """
        row = self._names.index(body)
        kick = self._kick(row)
        if not kick.mass or not np.isfinite(kick.acceleration).all():
            return None
        known_forces = [
            acting for acting in self._known_forces(kick) if acting.magnitude or acting.couple
        ]
        contact_forces = self._contact_forces(kick, known_forces)
        for press in contact_forces:
            known_forces += press.acting(self._names[press.row], kick.center)
        remaining = self._remaining_force(body, kick, known_forces)
        x, y, spin = kick.acceleration.tolist()
        direct = self._scene.direct
        jerked = direct is not None and bool(direct.drifts.jerked[row])
        struck = jerked or kick.struck or any(acting.name == IMPACT for acting in known_forces)
        return FreeBody(
            body=body, t=kick.step.t, mass=kick.mass, moment=kick.moment, center=kick.center,
            forces=(*known_forces, *remaining), acceleration=(x, y), angular_acceleration=spin,
            surface_directions=_surface_directions(contact_forces), struck=struck,
            is_completed=bool(remaining),
        )  # fmt: skip

    def _kick(self, row: int) -> "_Kick":
        scene, step = self._scene, self._world.last
        law_motion = step.law_motion or Instant.of(step.snapshot)
        mass_fraction = float(
            np.broadcast_to(scene.mass_fraction(law_motion.t), len(self._names))[row]
        )
        x, y = step.snapshot.position[row].tolist()
        acceleration = _accelerations(step, row, is_constrained=scene.joints.together is not None)
        mass = float(scene.mass[row]) * mass_fraction
        moment = float(scene.moment[row]) * mass_fraction
        return _Kick(row, step, law_motion, (x, y), mass, moment, acceleration)

    def _known_forces(self, kick: "_Kick") -> Iterator[AppliedForce]:
        """Yield the forces of gravity, laws, joints and sequential impacts."""
        scene, row, center = self._scene, kick.row, kick.center
        if gravity := scene.gravity:
            x, y = gravity.acceleration
            yield AppliedForce(
                gravity.effect.shown_force_name, "", (kick.mass * x, kick.mass * y), center
            )
        for entry, law in self._laws:
            at = getattr(entry, "at", None)
            arm = _lever_arm(evaluate(at, self._world.values), kick) if at else None
            own_name = getattr(entry, "name", None) or ""
            yield self._by_law(kick, law, arm)._replace(by=own_name)
        if (turning := kick.step.turning_acceleration) is not None:
            x, y = (kick.mass * turning[row]).tolist()
            name = ", ".join(turn.effect.shown_force_name for turn in scene.rotations)
            yield AppliedForce(name, "", (x, y), center)
        for name, spring in scene.joints.springs.items():
            acting = self._by_law(kick, spring, _joint_arm(spring.ends, kick))
            yield acting._replace(name=self._force_name(name), by=name)
        for joint, (x, y, torque) in pulls_on(scene.joints, row, len(self._names)):
            is_wound = joint in scene.joints.radii  # a string leaves its wheel at the rim
            arm = None if is_wound else _joint_arm(scene.joints.paths.get(joint, ()), kick)
            yield AppliedForce.of(self._force_name(joint), joint, (x, y), torque, center, arm)
        if (jump := kick.step.velocity_jump) is not None:
            x, y, spin = (jump[row] / kick.length).tolist()
            force = kick.mass * x, kick.mass * y
            yield AppliedForce.of(IMPACT, "", force, kick.moment * spin, center, None)

    def _by_law(self, kick: "_Kick", law: Law, arm: XY | None) -> AppliedForce:
        wrench = np.zeros((len(self._names), 3))
        law.add(kick.law_motion, wrench)
        x, y, torque = wrench[kick.row].tolist()
        return AppliedForce.of(law.effect.shown_force_name, "", (x, y), torque, kick.center, arm)

    def _force_name(self, joint: str) -> str:
        """Return the name of a joint's force; the joint of bodies that stuck has no name."""
        spec = self._world.level.joints.get(joint)
        return spec.kind.force_name if spec else "reaction"

    def _contact_forces(
        self, kick: "_Kick", known_forces: Sequence[AppliedForce]
    ) -> Sequence[ContactForce]:
        direct, contacts = self._scene.direct, kick.contacts
        wrenches = direct.wrenches(kick.row) if direct else None
        center = np.array(kick.center)
        raw = tuple(forces_of_contacts(contacts, wrenches, kick.row, center, kick.length))
        loosened_forces = with_breakaway(
            raw, self._breakaway_impulses(kick.row), kick.row, center, kick.length
        )
        if not kick.moment:
            return loosened_forces
        torque = sum(acting.torque(kick.center) for acting in known_forces)
        torque += sum(float(press.normal[2] + press.friction[2]) for press in loosened_forces)
        return with_torque(loosened_forces, kick.moment * float(kick.acceleration[2]) - torque)

    def _breakaway_impulses(self, row: int) -> Iterator[tuple[int, BreakawayImpulse]]:
        """Yield what contacts lost that broke loose, each with the index of the other body."""
        for pair, stick in self._scene.sticking.items():
            if row in pair:
                (other,) = pair - {row}
                yield from ((other, lost) for lost in stick.freed.values())

    def _remaining_force(
        self, body: str, kick: "_Kick", known_forces: Sequence[AppliedForce]
    ) -> Sequence[AppliedForce]:
        """Return the remaining force, of pymunk's own joints and a hand."""
        joints = [name for name, bodies in self._pymunk_joints.items() if body in bodies]
        is_held = kick.step.hold is not None and kick.step.hold[0] == kick.row
        if not (joints or is_held):
            return ()
        x, y = (kick.mass * kick.acceleration[:2]).tolist()
        remaining = (
            x - sum(a.force[0] for a in known_forces),
            y - sum(a.force[1] for a in known_forces),
        )
        torque = kick.moment * float(kick.acceleration[2]) - sum(
            a.torque(kick.center) for a in known_forces
        )
        name = " and ".join([*([HAND] if is_held else []), *(["reaction"] if joints else [])])
        return (AppliedForce.of(name, ", ".join(joints), remaining, torque, kick.center, None),)


class _Kick(NamedTuple):
    """The last kick of one body.

    Attributes
    ----------
    row, center, mass, moment, acceleration
        The body's row, centre of mass [m], mass [kg], moment [kg m²] and accelerations, (3,).
    step, law_motion
        The record of the step, and the motion that force laws saw in it.
    """

    row: int
    step: StepRecord
    law_motion: Motion
    center: XY
    mass: float
    moment: float
    acceleration: Array

    @property
    def length(self) -> float:
        """The length of the kick [s]; the first is half as long as the others."""
        full = self.step.parts[-1].kick
        return full / 2 if self.step.post_kick_velocity is None else full

    @property
    def contacts(self) -> Contacts:
        """The contacts of the kick itself, without the impacts that cut the drift before it."""
        return self.step.contacts.without_first(self.step.impact_count)

    @property
    def struck(self) -> bool:
        """Whether a contact of the body has just begun."""
        contacts = self.contacts
        return bool(contacts.first[(contacts.bodies == self.row).any(axis=1)].any())


def _accelerations(step: StepRecord, row: int, *, is_constrained: bool) -> Array:
    """Return the accelerations of a body over the kick, or at the step: (3,) [m/s², rad/s²]."""
    if step.post_kick_velocity is None or (step.composed and is_constrained):
        now = step.snapshot
        return np.append(now.acceleration[row], now.angular_acceleration[row])
    change = step.post_kick_velocity[row] - step.pre_kick_velocity[row]
    if step.belated_change is not None:
        change = change - step.belated_change[row]
    return change / step.parts[-1].kick


def _lever_arm(point: XY, kick: _Kick) -> XY:
    """Return the lever arm of a point of the body, along the axes of the plane [m]."""
    _, arm = Anchor(kick.row, complex(*point)).position_and_arm(kick.law_motion)
    return float(arm.real), float(arm.imag)


def _joint_arm(path: Sequence[Anchor], kick: _Kick) -> XY | None:
    """Return the lever arm at which a joint holds the body [m]; None if not at one point."""
    anchors = [anchor for anchor in path if anchor.body == kick.row]
    if len(anchors) != 1:
        return None
    _, arm = anchors[0].position_and_arm(kick.law_motion)
    return float(arm.real), float(arm.imag)


def _surface_directions(touching: Sequence[ContactForce]) -> tuple[XY, ...]:
    """Return the directions along surfaces, that with the largest normal force first."""
    sizes = [(float(np.hypot(*press.normal[:2])), press) for press in touching]
    hardest = sorted((each for each in sizes if each[0]), key=lambda each: -each[0])
    return tuple((float(p.normal[1]) / n, float(-p.normal[0]) / n) for n, p in hardest)
