"""Where the energy and the momentum of a run come from, and where they go.

A step drifts, then kicks. Read from the middle of one drift to the middle of the next it is half a
drift, one kick, half a drift, and only the kick changes velocities. An impulse J in a kick that
takes a velocity from v₋ to v₊ does the work J · (v₋ + v₊)/2, whatever else acts in the same kick.
So the kinetic energy changes by the sum of the works of all impulses, exactly, and each is booked
by itself.

A force with a potential is booked by what became of its potential energy, read in the middle of the
drift, instead of by its work. The two differ by what a step is too coarse for. That difference, and
whatever else has no cause, is `unexplained`: the numerical error. Nothing corrects it.

What cannot give energy is not believed to: surfaces that press on each other, impacts with e = 1, a
joint that keeps its length. What they do all the same is left unexplained.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from sandbox.model import accounts
from sandbox.model.expressions import Array
from sandbox.model.joints import Spring, bodies_of, is_exact
from sandbox.model.quantities import Quantity
from sandbox.model.shapes import evaluate
from sandbox.physics.batch import Contacts
from sandbox.physics.laws.law import Law
from sandbox.physics.laws.spring import SpringForce
from sandbox.physics.massflow import MassFlows
from sandbox.physics.motion import Instant
from sandbox.physics.world import World

COMPONENTS = {"x": 0, "y": 1}


@dataclass(frozen=True, slots=True)
class Balance:
    """The books at a step, as they stand in the middle of the drift that follows it.

    Attributes
    ----------
    kinetic
        Of all bodies [J].
    potential
        By what stores it [J].
    work, loss
        By what put it in, or took it for good, since the books were opened [J].
    unexplained
        What the energy has grown by beyond that [J].
    impulse
        By what gave it from outside, since then: x, y and, about the origin, angular momentum, (3,)
        each [N s, N m s].
    unexplained_impulse
        What the momentum has grown by beyond that: (3,).
    """

    kinetic: float
    potential: Mapping[str, float]
    work: Mapping[str, float]
    loss: Mapping[str, float]
    unexplained: float
    impulse: Mapping[str, Array]
    unexplained_impulse: Array

    @property
    def energy(self) -> float:
        """Kinetic and potential [J]."""
        return self.kinetic + sum(self.potential.values())

    def value(self, quantity: Quantity) -> float:
        """Return a quantity that the ledger keeps; a vector without a component is its size."""
        kind, _, name = quantity.attribute.partition(".")
        match kind:
            case "work":
                return self.work[name]
            case "loss":
                return self.loss[name]
            case "unexplained_energy":
                return self.unexplained
        given = self.impulse[name] if name else self.unexplained_impulse
        if kind in ("angular_impulse", "unexplained_angular_momentum"):
            return float(given[2])
        if quantity.component:
            return float(given[COMPONENTS[quantity.component]])
        return float(np.hypot(given[0], given[1]))


class Ledger:
    """Keeps the books of a world; n bodies. The world pays nothing for it.

    Open it on a world, let it `note` every step, and read its `balance`.
    """

    def __init__(self, world: World) -> None:
        scene, level = world.scene, world.level
        self._world, self._scene = world, scene
        self._laws: tuple[Law, ...] = (*([scene.gravity] if scene.gravity else []), *scene.laws)
        self._mass = np.stack((scene.mass, scene.mass, scene.moment), axis=1)
        self._surfaces = _surfaces(world)
        self._elastic = _elastic(world)
        self._potential = dict.fromkeys(accounts.potentials(level), 0.0)
        self._works = dict.fromkeys((*accounts.works(level), "hand"), 0.0)
        self._losses = dict.fromkeys(accounts.losses(level), 0.0)
        self._impulses = {name: np.zeros(3) for name in accounts.outside(level)}
        own = [j for j in level.joints.values() if not (isinstance(j, Spring) or is_exact(j))]
        self._driven = any(accounts.drives(joint, level) for joint in own)
        self._hung = {list(scene.bodies).index(name) for joint in own for name in bodies_of(joint)}
        self._steps, self._velocity = world.steps, scene.batch.velocity()
        self._slack = scene.joints.pulls(len(self._mass)).tension <= 0
        start = self._middle(0.5, self._velocity)
        self._start = self._store(start), self._momentum(start)
        self._end = start

    def note(self) -> None:
        """Book the world's last step; one that is booked already is left alone.

        Raises
        ------
        ValueError
            If the world has taken more than one step since.
        """
        world = self._world
        if world.steps == self._steps:
            return
        if world.steps != self._steps + 1:
            raise ValueError(f"the ledger has seen step {self._steps}, the world {world.steps}")
        self._steps = world.steps
        before, after = self._cut(), self._scene.batch.velocity()
        t = world.t if world.kick is None else float(world.kick.t)
        inertia = self._inertia(t)
        kick = _Kick(t, world.snapshot.position, (before + after) / 2, inertia)
        self._carry(t, before, after)
        rest = inertia * (after - before)
        rest -= sum((self._force(law, kick) for law in self._laws), np.zeros_like(rest))
        rest -= self._joints(kick)
        jump = self._jump(kick)
        rest -= jump
        rest -= self._own(kick, rest)
        rest -= self._hand(kick, rest)
        self._touch(kick, rest, kick.work(jump))
        self._velocity, self._end = after, self._middle(0.5, after)
        self._store(self._end)

    @property
    def balance(self) -> Balance:
        """How the books stand."""
        kinetic = self._kinetic(self._end)
        (begun, begun_with), given = self._start, sum(self._impulses.values(), np.zeros(3))
        explained = sum(self._works.values()) + sum(self._losses.values())
        return Balance(
            kinetic,
            dict(self._potential),
            dict(self._works),
            {name: -work for name, work in self._losses.items()},
            kinetic + sum(self._potential.values()) - begun - explained,
            {name: impulse.copy() for name, impulse in self._impulses.items()},
            self._momentum(self._end) - begun_with - given,
        )

    def _middle(self, ahead: float, velocity: Array, t: float | None = None) -> Instant:
        """Return the motion so many steps after (or before) the last, all drifting like that."""
        now, later = self._world.snapshot, ahead * self._world.dt
        return Instant(
            np.asarray(self._world.t + later if t is None else t),
            now.position + later * velocity[:, :2],
            now.angle + later * velocity[:, 2],
            velocity[:, :2],
            velocity[:, 2],
        )

    def _inertia(self, t: float | Array) -> Array:
        """Return masses, masses and moments at a time: (n, 3) [kg, kg m²]."""
        share = np.asarray(self._scene.share(np.asarray(t)))
        return self._mass * (share[:, None] if share.ndim else share)

    def _kinetic(self, motion: Instant) -> float:
        velocity = _velocity(motion)
        return float(np.sum(self._inertia(motion.t) * velocity * velocity) / 2)

    def _store(self, motion: Instant) -> float:
        """Note what is stored, and return the whole energy [J]."""
        self._potential = dict.fromkeys(self._potential, 0.0)
        for law in self._laws:
            if law.book == "potential":
                self._potential[law.effect] += float(law.potential_energy(motion).sum())
        return self._kinetic(motion) + sum(self._potential.values())

    def _momentum(self, motion: Instant) -> Array:
        return _total(self._inertia(motion.t) * _velocity(motion), motion.position)

    def _give(self, name: str, impulse: Array, place: Array) -> None:
        """Book what gave momentum, unless bodies give it to each other."""
        if name in self._impulses:
            self._impulses[name] = self._impulses[name] + _total(impulse, place)

    def _cut(self) -> Array:
        """Book the impacts that cut the last drift; return the velocities that it ended with.

        Before and after them the books stand as if the drift had not been cut, in its middle.
        """
        located = self._world.located
        if located is None or not located.impacts:
            return self._velocity
        had = self._kinetic(self._end) + sum(self._potential.values())
        self._end = self._middle(-0.5, located.begun)
        gained = self._store(self._end) - had
        told = sum(impact.told for impact in located.impacts)
        rubbed = sum(impact.rubbed for impact in located.impacts)
        if "bodies" in self._works:
            self._works["bodies"] += told
        if "friction" in self._losses:
            self._losses["friction"] += rubbed
        if not self._elastic:
            self._lose("impacts", gained - told - rubbed)
        if "supports" in self._impulses:
            self._impulses["supports"] += sum(i.given for i in located.impacts)
        return located.begun

    def _carry(self, t: float, before: Array, after: Array) -> None:
        """Book what matter brings, or takes along, that is not a force."""
        flows = self._scene.share
        if not isinstance(flows, MassFlows):
            return
        earlier, now, later = (self._inertia(t + h * self._world.dt) for h in (-0.5, 0, 0.5))
        brought = (later - now) * after + (now - earlier) * before
        energy = np.sum((later - now) * after * after + (now - earlier) * before * before, axis=1)
        energy = (
            energy / 2
            + self._stored_with(self._end, t)
            - self._stored_with(self._middle(0.5, after), t)
        )
        for name, bodies in _carriers(flows).items():
            share = np.zeros_like(brought)
            share[bodies] = brought[bodies]
            self._give(name, share, self._world.snapshot.position)
            self._works[name] += float(energy[bodies].sum())

    def _stored_with(self, motion: Instant, t: float) -> Array:
        """Return by how much each body stores more with its mass at another time: (n,) [J]."""
        other = motion._replace(t=np.asarray(t))
        stores = [law for law in self._laws if law.book == "potential"]
        more = [law.potential_energy(other) - law.potential_energy(motion) for law in stores]
        return sum(more, np.zeros(len(self._mass)))

    def _force(self, law: Law, kick: "_Kick") -> Array:
        """Book the impulse of a law, and return it: (n, 3)."""
        impulse = self._impulse(law, kick)
        self._give(law.effect, impulse, kick.place)
        if law.book == "work":
            self._works[law.effect] += kick.work(impulse)
        elif law.book == "loss":
            self._losses[law.effect] += kick.work(impulse)
        elif isinstance(law, SpringForce) and law.damping:
            elastic = self._impulse(replace(law, damping=0.0), kick)
            self._losses["damping"] += kick.work(impulse - elastic)
        return impulse

    def _impulse(self, law: Law, kick: "_Kick") -> Array:
        wrench = np.zeros_like(self._mass)
        seen = self._world.kick or self._middle(0.0, self._velocity)
        law.add(seen, wrench)
        return np.where(kick.inertia > 0, wrench * self._world.dt, 0.0)

    def _joints(self, kick: "_Kick") -> Array:
        """Book the impulses of the exact joints, and return them: (n, 3)."""
        pulls = self._scene.joints.pulls(len(self._mass))
        told = kick.inertia[:, 0] == 0
        drives = pulls.changes | (pulls.gradient[:, told] != 0).any(axis=(1, 2))
        impulses = -self._world.dt * pulls.tension[:, None, None] * pulls.gradient
        impulses = np.where(kick.inertia > 0, impulses, 0.0)
        works = np.sum(impulses * kick.mean, axis=(1, 2))
        if "joints" in self._works:
            self._works["joints"] += float(works[drives].sum())
        if len(self._slack) < len(works):
            self._lose("sticking", float(works[~drives].sum()))
        elif (jerked := pulls.pulls_only & self._slack & ~drives).any():
            self._lose("impacts", float(works[jerked].sum()))
        self._slack = pulls.tension <= 0
        together: Array = impulses.sum(axis=0)
        self._give("supports", together, kick.place)
        return together

    def _own(self, kick: "_Kick", rest: Array) -> Array:
        """Book pymunk's own joints: what is left to the bodies they hold, but for contacts."""
        impulse = np.zeros_like(rest)
        if not self._hung:
            return impulse
        contacts = self._kicked()
        for row in self._hung:
            impulse[row] = rest[row]
            impulse[row, :2] -= _pressed(contacts, row)
        impulse[kick.inertia == 0] = 0.0
        self._give("supports", impulse, kick.place)
        if self._driven:
            self._works["joints"] += kick.work(impulse)
        return impulse

    def _kicked(self) -> Contacts:
        """Return the contacts of the kick, without the impacts that cut the drift before it."""
        located = self._world.located
        return self._world.contacts.after(len(located.impacts) if located else 0)

    def _jump(self, kick: "_Kick") -> Array:
        """Return the impulses of impacts that come one after the other: (n, 3)."""
        if self._world.jump is None:
            return np.zeros_like(self._mass)
        impulse = kick.inertia * self._world.jump
        self._give("supports", impulse, kick.place)
        return impulse

    def _lose(self, name: str, work: float) -> None:
        """Book a loss; what would be a gain stays unexplained."""
        self._losses[name] += min(work, 0.0)

    def _hand(self, kick: "_Kick", rest: Array) -> Array:
        """Book what a hand has pulled, as far as contacts do not account for it: (n, 3)."""
        impulse = np.zeros_like(rest)
        hold = self._world.hand.hold
        if hold is None:
            return impulse
        row, (x, y) = hold
        pull = rest[row, :2] - _pressed(self._kicked(), row)
        impulse[row] = *pull, (x * pull[1] - y * pull[0]) * (self._mass[row, 2] > 0)
        self._works["hand"] += kick.work(impulse)
        self._impulses.setdefault("hand", np.zeros(3))
        self._give("hand", impulse, kick.place)
        return impulse

    def _touch(self, kick: "_Kick", rest: Array, jumped: float) -> None:
        """Book what contacts did: all that is left to the bodies that touch, and in sequence."""
        contacts = self._kicked()
        if not len(contacts.bodies):
            return
        touching = np.zeros(len(rest), dtype=bool)
        touching[contacts.bodies] = True
        impulse = np.where(touching[:, None], rest, 0.0)
        self._give("supports", impulse, kick.place)
        pressing = kick.work(impulse)
        across, drives = self._rub(_completed(contacts, impulse), kick)
        for name, work in drives.items():
            self._works[name] += work
        if "friction" in self._losses:
            self._losses["friction"] += across
        if not self._elastic:
            self._lose("impacts", jumped + pressing - across - sum(drives.values()))

    def _rub(self, contacts: Contacts, kick: "_Kick") -> tuple[float, dict[str, float]]:
        """Return the work of friction, and what belts and bodies that move as told put in."""
        along = np.stack((-contacts.direction[:, 1], contacts.direction[:, 0]), axis=1)
        friction = np.sum(contacts.impulse * along, axis=1)[:, None] * along
        second = np.where(contacts.touches == 2, 1, 0)
        points = (contacts.points[:, 0] + contacts.points[np.arange(len(second)), second]) / 2
        slip = np.zeros_like(along)
        work = {"bodies": 0.0, "belt": 0.0}
        for side, sign in ((0, -1.0), (1, 1.0)):
            rows = contacts.bodies[:, side]
            arm, mean = points - kick.place[rows], kick.mean[rows]
            moves = mean[:, :2] + mean[:, 2:] * np.stack((-arm[:, 1], arm[:, 0]), axis=1)
            told = (kick.inertia[rows, :1] == 0) * moves
            runs = self._surfaces[rows]
            slip += sign * (moves + runs)
            work["bodies"] -= sign * float(np.sum(contacts.impulse * told))
            work["belt"] -= sign * float(np.sum(friction * runs))
        return float(np.sum(friction * slip)), {n: w for n, w in work.items() if n in self._works}


class _Kick(NamedTuple):
    """What a kick is booked with; n bodies.

    Attributes
    ----------
    t
        When it was [s].
    place
        (n, 2), where the bodies were [m].
    mean
        (n, 3), the mean of their velocities before and after [m/s, rad/s].
    inertia
        (n, 3), their masses, masses and moments; 0 for what nothing moves [kg, kg m²].
    """

    t: float
    place: Array
    mean: Array
    inertia: Array

    def work(self, impulse: Array) -> float:
        """Return the work of impulses: (n, 3) [J]."""
        return float(np.sum(impulse * self.mean))


def _velocity(motion: Instant) -> Array:
    return np.column_stack((motion.velocity, motion.angular_velocity))


def _total(impulse: Array, place: Array) -> Array:
    """Return the sum of impulses, and that of their moments about the origin: (3,)."""
    x, y = place.T
    moment = x * impulse[:, 1] - y * impulse[:, 0] + impulse[:, 2]
    return np.array([*impulse[:, :2].sum(axis=0), moment.sum()])


def _pressed(contacts: Contacts, row: int) -> Array:
    """Return the impulse of all contacts on a body: (2,)."""
    given = contacts.impulse[contacts.bodies[:, 1] == row].sum(axis=0)
    taken = contacts.impulse[contacts.bodies[:, 0] == row].sum(axis=0)
    return np.asarray(given - taken)


def _completed(contacts: Contacts, impulse: Array) -> Contacts:
    """Return contacts with the whole impulse where a body has but one, not pymunk's share of it.

    Friction that breaks loose within a step is taken down after pymunk has solved it.
    """
    counts = np.bincount(contacts.bodies.ravel(), minlength=len(impulse))
    whole = contacts.impulse.copy()
    for side, sign in ((0, -1.0), (1, 1.0)):
        rows = contacts.bodies[:, side]
        alone = (counts[rows] == 1) & impulse[rows].any(axis=1)
        whole[alone] = sign * impulse[rows[alone], :2]
    return contacts._replace(impulse=whole)


def _carriers(flows: MassFlows) -> dict[str, list[int]]:
    """Return the bodies that lose or gain matter, by the effect that lets them."""
    found: dict[str, list[int]] = {}
    for flow in flows.flows:
        bodies = found.setdefault("thrust" if flow.rate < 0 else "accretion", [])
        if flow.body not in bodies:
            bodies.append(flow.body)
    return found


def _surfaces(world: World) -> Array:
    """Return how fast the bodies' surfaces run: (n, 2) [m/s]."""
    surfaces = np.zeros((len(world.scene.bodies), 2))
    for row, (name, body) in enumerate(world.scene.bodies.items()):
        for belt in world.level.effects.belt or ():
            if belt.body == name:
                x, y = evaluate(belt.velocity, world.values)
                c, s = np.cos(body.angle), np.sin(body.angle)
                surfaces[row] = c * x - s * y, s * x + c * y
    return surfaces


def _elastic(world: World) -> bool:
    """Whether all impacts have e = 1, so that none may take energy."""
    effect, values = world.level.effects.restitution, world.values
    if effect is None:
        return False
    own = [body.restitution for body in world.level.bodies.values() if body.restitution]
    return all(e(values) == 1 for e in (*own, *(pair.coefficient for pair in effect.pairs)))
