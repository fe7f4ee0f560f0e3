"""Where the energy and the momentum of a run come from, and where they go.

A step drifts, then kicks. Read from the middle of one drift to the middle of the next it is half a
drift, one kick, half a drift, and only the kick changes velocities. An impulse J in a kick that
takes a velocity from v₋ to v₊ does the work J · (v₋ + v₊)/2, whatever else acts in the same kick.
So the kinetic energy changes by the sum of the works of all impulses, exactly, and each is booked
by itself.

A force with a potential is booked by what became of its potential energy, read in the middle of the
drift, instead of by its work. The two differ by what a step is too coarse for. That difference, and
whatever else has no cause, is `unexplained`: the numerical error. Nothing corrects it.

A step of fourth order is several of those, of which the last kick is shared with the next step. It
is read from step to step instead, each half of that kick booked on its own side.

What cannot give energy is not believed to: surfaces that press on each other, impacts with e = 1, a
joint that keeps its length. What they do all the same is left unexplained.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from sandbox.model import accounts
from sandbox.model.expressions import Array
from sandbox.model.joints import Spring, bodies_of, is_exact
from sandbox.physics.contacts.direct.solver import Stage
from sandbox.physics.contacts.impulse_work import Kick, completed, pressed, rubbing
from sandbox.physics.energy.balance import Balance
from sandbox.physics.energy.jerks import reached
from sandbox.physics.energy.step_record import Recorded
from sandbox.physics.engine.batch import Booleans, Contacts
from sandbox.physics.events.acting import Acted
from sandbox.physics.events.impact_response import Collided
from sandbox.physics.events.slip import Stop
from sandbox.physics.forces.law import Law, Turn
from sandbox.physics.forces.spring import SpringForce
from sandbox.physics.forces.turning import given
from sandbox.physics.forces.variable_mass import MassFlows
from sandbox.physics.geometry.distance import surfaces
from sandbox.physics.joints.pulls import Pulls, pulls_of
from sandbox.physics.state.motion import Instant, momentum

SEEN = 1e-12
"""The share of a place, or of a metre, by which a body must have been moved to be seen to be."""


class Ledger:
    """Keeps the books of a run; n bodies. The run pays nothing for it.

    Open it on a world, let it `note` every step, and read its `balance`. What it knows of a step is
    the world's record of it.

    Parameters
    ----------
    run
        Which, such as a world.
    begun
        To open the books one step back: (n, 3), the velocities that the last kick began with
        [m/s, rad/s].

    Attributes
    ----------
    steps
        How many of the run's are booked.
    """

    def __init__(self, run: Recorded, begun: Array | None = None) -> None:
        scene, level = run.scene, run.level
        self._run, self._scene, self._step = run, scene, run.last
        self._laws: tuple[Law, ...] = (*([scene.gravity] if scene.gravity else []), *scene.laws)
        self._mass = scene.inertia
        self._surfaces = surfaces(scene.bodies.values())
        # solved directly, friction takes from a rebound what it would give otherwise
        self._elastic = _elastic(run) and not (scene.direct and level.effects.friction)
        self._potential = dict.fromkeys(accounts.potentials(level), 0.0)
        self._works = dict.fromkeys((*accounts.works(level), "hand"), 0.0)
        self._losses = dict.fromkeys(accounts.losses(level), 0.0)
        self._impulses = {name: np.zeros(3) for name in accounts.outside(level)}
        own = [j for j in level.joints.values() if not (isinstance(j, Spring) or is_exact(j))]
        self._driven = any(accounts.drives(joint, level) for joint in own)
        self._hung = {list(scene.bodies).index(name) for joint in own for name in bodies_of(joint)}
        self._composed = self._step.composed
        if self._composed:
            begun = None
            run.keep_trail()
        self._back = begun is not None
        self.steps = self._step.steps - self._back
        self._velocity = scene.batch.velocity() if begun is None else begun
        slack = pulls_of(scene.joints, len(self._mass)).tension <= 0
        self._slack = slack, slack  # in the last kick, and in that before it
        self._overlaps = 0.0
        start = self._middle(0.5 - self._back, self._velocity)
        if self._composed:
            start = Instant.of(self._step.snapshot)
        self._start = self._store(start), self._momentum(start)
        self._end = start

    def note(self) -> None:
        """Book the world's last step; one that is booked already is left alone.

        Raises
        ------
        ValueError
            If the world has taken more than one step since.
        """
        self._step = step = self._run.last
        if step.steps == self.steps:
            return
        if step.steps != self.steps + 1:
            raise ValueError(f"the ledger has seen step {self.steps}, the world {step.steps}")
        self.steps = step.steps
        if self._composed and step.composed:
            self._follow()
            return
        if self._composed:
            self._change_over()
        before = self._velocity if self._back else self._drifted()
        self._back = False
        self._part(before)
        after = self._scene.batch.velocity()
        t = step.t if step.seen is None else float(step.seen.t)
        seen = step.seen or self._middle(0.0, before)
        moment = Kick(t, step.dt, seen, step.snapshot.position, before, self._inertia(t))
        self._carry(t, before, after)
        pulls = pulls_of(self._scene.joints, len(self._mass))
        begun, slack = before, self._slack[0] | self._slack[1]
        if len(slack) > len(pulls.tension):  # some were cut, and no rope was caught by that
            slack = np.zeros(len(pulls.tension), dtype=bool)
        for lasts, ended, tension, contacts in self._stages(after, pulls.tension):
            kick = moment._replace(length=lasts, mean=(begun + ended) / 2)
            self._book(kick, ended - begun, pulls._replace(tension=tension), contacts, slack)
            begun = ended
            if len(slack) == len(tension):
                slack = slack | (tension <= 0)
        slack = pulls.tension <= 0
        self._slack = slack, self._slack[0] if len(self._slack[0]) == len(slack) else slack
        self._velocity, self._end = after, self._middle(0.5, after)
        self._store(self._end)

    def _stages(self, after: Array, tension: Array) -> Iterable[Stage]:
        """Return the parts of the last kick, with impulses for forces."""
        dt, direct = self._step.dt, self._scene.direct
        if direct and direct.stages:
            return direct.stages
        return (Stage(dt, after, tension * dt, self._kicked()),)

    def _book(
        self, kick: Kick, change: Array, pulls: Pulls, contacts: Contacts, slack: Booleans
    ) -> None:
        """Book a kick that changes velocities so, (n, 3), and which ropes were slack before it.

        A rope that is caught stops all that it reaches at once. What keeps its length and what
        touches there work on each other within the kick; what they take together is the loss.
        """
        rest = kick.inertia * change
        rest -= sum((self._force(law, kick) for law in self._laws), np.zeros_like(rest))
        rest -= sum((self._turn(turn, kick) for turn in self._scene.turns), np.zeros_like(rest))
        impulses, works = self._joints(kick, pulls)
        rest -= impulses
        jump = self._jump(kick)
        rest -= jump
        rest -= self._own(kick, rest, contacts)
        rest -= self._hand(kick, rest, contacts)
        lost = self._touch(kick, rest, kick.work(jump), contacts)
        if len(slack) < len(works):
            self._lose("sticking", float(works.sum()))
        else:
            moves = kick.inertia[:, 0] > 0
            lost += float(works[reached(pulls, contacts, slack, moves)].sum())
        if lost:
            self._lose("impacts", lost)

    def _follow(self) -> None:
        """Book the kicks of a step, in which nothing acts but smooth forces and joints.

        Of the kicks at its two ends half is its own.
        """
        step, end = self._step, self._end
        parts, begun = step.parts, float(end.t)
        half = parts[-1].kick / 2
        self._push(begun, half, end, self._velocity)
        velocity = self._velocity
        for part, state in zip(parts, step.trail, strict=False):
            t = begun + part.ahead * step.dt
            before = Instant.at(t, state, velocity)
            velocity = state[:, 3:]
            self._push(t, part.kick, before, velocity)
        self._end = Instant.of(step.snapshot)
        before = self._end._replace(velocity=velocity[:, :2], angular_velocity=velocity[:, 2])
        self._push(float(self._end.t), half, before, _velocity(self._end))
        self._velocity = self._scene.batch.velocity()
        self._store(self._end)

    def _change_over(self) -> None:
        """Take up the half kick with which the world has gone over to leapfrog, for a hand."""
        self._velocity = self._step.begun
        self._push(float(self._end.t), self._step.dt / 2, self._end, self._velocity)
        self._composed = False

    def _push(self, t: float, length: float, seen: Instant, after: Array) -> None:
        """Book a kick in which only laws and joints act, from velocities to others: (n, 3)."""
        before, inertia = _velocity(seen), self._inertia(t)
        kick = Kick(t, length, seen, seen.position, (before + after) / 2, inertia)
        laws = sum((self._force(law, kick) for law in self._laws), np.zeros_like(after))
        if self._scene.joints.together:
            self._give("supports", inertia * (after - before) - laws, kick.place)

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
            self._overlaps,
        )

    def _middle(self, ahead: float, velocity: Array, t: float | None = None) -> Instant:
        """Return the motion so many steps after (or before) the last, all drifting like that."""
        now, later = self._step.snapshot, ahead * self._step.dt
        return Instant(
            np.asarray(self._step.t + later if t is None else t),
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

    def _stored(self, motion: Instant) -> float:
        """Return what is stored somewhere [J]."""
        stores = (law for law in self._laws if law.effect.book == "potential")
        return sum(float(law.potential_energy(motion).sum()) for law in stores)

    def _store(self, motion: Instant) -> float:
        """Note what is stored, and return the whole energy [J]."""
        self._potential = dict.fromkeys(self._potential, 0.0)
        for law in self._laws:
            if law.effect.book == "potential":
                self._potential[law.effect.booked] += float(law.potential_energy(motion).sum())
        return self._kinetic(motion) + sum(self._potential.values())

    def _momentum(self, motion: Instant) -> Array:
        return momentum(self._inertia(motion.t) * _velocity(motion), motion.position)

    def _give(self, name: str, impulse: Array, place: Array) -> None:
        """Book what gave momentum, unless bodies give it to each other."""
        if name in self._impulses:
            self._impulses[name] = self._impulses[name] + momentum(impulse, place)

    def _drifted(self) -> Array:
        """Book what cut the last drift, and return the velocities that it ended with: (n, 3)."""
        step = self._step
        if step.acted:
            return self._act(step.acted)
        if step.stop:
            return self._stop(step.stop)
        return self._cut(step.impacts) if step.impacts else self._velocity

    def _cut(self, collided: Collided) -> Array:
        """Book the impacts that cut the last drift; return the velocities that it ended with."""
        impacts = collided.impacts
        self._go_on(collided.begun, collided.lifted)
        self._put_in(
            {"bodies": sum(i.kinematic for i in impacts), "belt": sum(i.driven for i in impacts)}
        )
        self._rub(sum(impact.rubbed for impact in impacts))
        if not self._elastic:
            for impact in impacts:
                self._lose("impacts", impact.pressed)
        if "supports" in self._impulses:
            self._impulses["supports"] += sum((impact.given for impact in impacts), collided.pulled)
        return collided.begun

    def _stop(self, stop: Stop) -> Array:
        """Book slipping that ended in the last drift; return the velocities that it ended with."""
        before = self._end
        self._go_on(stop.begun, stop.lifted)
        for law in self._laws:
            wrench = np.zeros_like(self._mass)
            law.add(before, wrench)
            self._do(law, float(np.sum(wrench * stop.way)))
        self._put_in(stop.works)
        self._rub(stop.rubbed)
        if "supports" in self._impulses:
            self._impulses["supports"] += stop.given
        return stop.begun

    def _act(self, happened: Acted) -> Array:
        """Book what events did in the last drift; return the velocities that it ended with."""
        self._go_on(happened.begun, happened.lifted)
        self._put_in({"events": happened.switched})
        rest = happened.given
        for law, worked, pushed in zip(self._laws, happened.worked, happened.pushed, strict=True):
            self._do(law, worked)
            if law.effect.name in self._impulses:
                self._impulses[law.effect.name] += pushed
            rest = rest - pushed
        if "supports" in self._impulses:
            self._impulses["supports"] += rest
        return happened.begun

    def _go_on(self, begun: Array, lifted: float) -> None:
        """Stand in the middle of the last drift as if it had not been cut.

        What is held there, other than along the way, is taken as if it had been from the start.
        """
        self._end = self._middle(-0.5, begun)
        self._store(self._end)
        energy, momentum_then = self._start
        self._start = energy + lifted, momentum_then

    def _part(self, drifted: Array) -> None:
        """See what taking back overlaps gave: bodies are not where their drift ended, (n, 3)."""
        if not len(self._step.contacts.bodies):
            return
        now, half = self._step.snapshot, self._step.dt / 2
        ended = self._end._replace(
            position=self._end.position + half * drifted[:, :2],
            angle=self._end.angle + half * drifted[:, 2],
        )
        moved = np.abs(now.position - ended.position).max()
        if moved > SEEN * (1 + np.abs(now.position).max()):
            there = ended._replace(position=now.position, angle=now.angle)
            self._overlaps += self._stored(there) - self._stored(ended)

    def _rub(self, work: float) -> None:
        """Book the work of friction."""
        if "friction" in self._losses:
            self._losses["friction"] += work

    def _do(self, law: Law, work: float) -> None:
        """Book the work of a law that is not booked by what it stores."""
        if law.effect.book == "work":
            self._works[law.effect.booked] += work
        elif law.effect.book == "loss":
            self._losses[law.effect.booked] += work

    def _put_in(self, works: Mapping[str, float]) -> None:
        """Book works by what did them, where there is an account for it."""
        for name in works.keys() & self._works.keys():
            self._works[name] += works[name]

    def _carry(self, t: float, before: Array, after: Array) -> None:
        """Book what matter brings, or takes along, that is not a force."""
        flows = self._scene.share
        if not isinstance(flows, MassFlows):
            return
        earlier, now, later = (self._inertia(t + h * self._step.dt) for h in (-0.5, 0, 0.5))
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
            self._give(name, share, self._step.snapshot.position)
            self._works[name] += float(energy[bodies].sum())

    def _stored_with(self, motion: Instant, t: float) -> Array:
        """Return by how much each body stores more with its mass at another time: (n,) [J]."""
        other = motion._replace(t=np.asarray(t))
        stores = [law for law in self._laws if law.effect.book == "potential"]
        more = [law.potential_energy(other) - law.potential_energy(motion) for law in stores]
        return sum(more, np.zeros(len(self._mass)))

    def _force(self, law: Law, kick: Kick) -> Array:
        """Book the impulse of a law, and return it: (n, 3).

        What moves as told holds its own against it, and does work by that.
        """
        every = self._impulse(law, kick)
        impulse = np.where(kick.inertia > 0, every, 0.0)
        self._give(law.effect.name, impulse, kick.place)
        self._do(law, kick.work(every))
        if "bodies" in self._works:
            self._works["bodies"] -= kick.work(np.where(self._mass[:, :1] > 0, 0.0, every))
        if isinstance(law, SpringForce) and law.damping:
            elastic = self._impulse(replace(law, damping=0.0), kick)
            self._losses["damping"] += kick.work(every - elastic)
        return impulse

    def _turn(self, turn: Turn, kick: Kick) -> Array:
        """Book the impulse of what turns velocities, which does no work; return it: (n, 3)."""
        impulse = np.zeros_like(self._mass)
        change = given(turn.rate(kick.seen), kick.mean[:, :2], kick.length)
        impulse[:, :2] = kick.inertia[:, :2] * change
        self._give(turn.effect.name, impulse, kick.place)
        return impulse

    def _impulse(self, law: Law, kick: Kick) -> Array:
        wrench = np.zeros_like(self._mass)
        law.add(kick.seen, wrench)
        return wrench * kick.length

    def _joints(self, kick: Kick, pulls: Pulls) -> tuple[Array, Array]:
        """Book the impulses of the exact joints; return them, (n, 3), and their works, (m,).

        Those of what is driven are booked, and 0.
        """
        kinematic = kick.inertia[:, 0] == 0
        drives = pulls.changes | (pulls.jacobian[:, kinematic] != 0).any(axis=(1, 2))
        impulses = -pulls.tension[:, None, None] * pulls.jacobian
        impulses = np.where(kick.inertia > 0, impulses, 0.0)
        works = np.sum(impulses * kick.mean, axis=(1, 2))
        if "joints" in self._works:
            self._works["joints"] += float(works[drives].sum())
        together: Array = impulses.sum(axis=0)
        self._give("supports", together, kick.place)
        return together, np.where(drives, 0.0, works)

    def _own(self, kick: Kick, rest: Array, contacts: Contacts) -> Array:
        """Book pymunk's own joints: what is left to the bodies they hold, but for contacts."""
        impulse = np.zeros_like(rest)
        if not self._hung:
            return impulse
        for row in self._hung:
            impulse[row] = rest[row]
            impulse[row, :2] -= pressed(contacts, row)
        impulse[kick.inertia == 0] = 0.0
        self._give("supports", impulse, kick.place)
        if self._driven:
            self._works["joints"] += kick.work(impulse)
        return impulse

    def _kicked(self) -> Contacts:
        """Return the contacts of the kick, without the impacts that cut the drift before it."""
        collided = self._step.impacts
        return self._step.contacts.after(len(collided.impacts) if collided else 0)

    def _jump(self, kick: Kick) -> Array:
        """Return the impulses of impacts that come one after the other: (n, 3)."""
        if self._step.jump is None:
            return np.zeros_like(self._mass)
        impulse = kick.inertia * self._step.jump
        self._give("supports", impulse, kick.place)
        return impulse

    def _lose(self, name: str, work: float) -> None:
        """Book a loss; what would be a gain stays unexplained."""
        self._losses[name] += min(work, 0.0)

    def _hand(self, kick: Kick, rest: Array, contacts: Contacts) -> Array:
        """Book what a hand has pulled, as far as contacts do not account for it: (n, 3)."""
        impulse = np.zeros_like(rest)
        hold = self._step.hold
        if hold is None:
            return impulse
        row, (x, y) = hold
        pull = rest[row, :2] - pressed(contacts, row)
        impulse[row] = *pull, (x * pull[1] - y * pull[0]) * (self._mass[row, 2] > 0)
        self._works["hand"] += kick.work(impulse)
        self._impulses.setdefault("hand", np.zeros(3))
        self._give("hand", impulse, kick.place)
        return impulse

    def _touch(self, kick: Kick, rest: Array, jumped: float, contacts: Contacts) -> float:
        """Book what contacts did: all that is left to the bodies that touch, and in sequence.

        Return the work that impacts may account for.
        """
        if not len(contacts.bodies):
            return 0.0
        touching = np.zeros(len(rest), dtype=bool)
        touching[contacts.bodies] = True
        impulse = np.where(touching[:, None], rest, 0.0)
        self._give("supports", impulse, kick.place)
        pressing = kick.work(impulse)
        across, drives = rubbing(
            completed(contacts, impulse), kick.place, kick.mean, kick.inertia, self._surfaces
        )
        drives = {name: work for name, work in drives.items() if name in self._works}
        given = jumped + pressing - sum(drives.values())
        if (
            not kick.length
        ):  # in an impact friction and rebound act at once, and one feeds the other
            across = min(max(across, given), 0.0)
        self._put_in(drives)
        self._rub(across)
        lost = given - across
        if lost > 0 and not kick.length and "sticking" in self._losses:
            self._losses["sticking"] += lost  # who sticks presses on each other in the same impact
            return 0.0
        return 0.0 if self._elastic else lost


def _velocity(motion: Instant) -> Array:
    return np.column_stack((motion.velocity, motion.angular_velocity))


def _carriers(flows: MassFlows) -> dict[str, list[int]]:
    """Return the bodies that lose or gain matter, by the effect that lets them."""
    found: dict[str, list[int]] = {}
    for flow in flows.flows:
        bodies = found.setdefault(flow.effect, [])
        if flow.body not in bodies:
            bodies.append(flow.body)
    return found


def _elastic(run: Recorded) -> bool:
    """Whether all impacts have e = 1, so that none may take energy."""
    effect, values = run.level.effects.restitution, run.values
    if effect is None:
        return False
    own = [body.restitution for body in run.level.bodies.values() if body.restitution]
    return all(e(values) == 1 for e in (*own, *(pair.coefficient for pair in effect.pairs)))
