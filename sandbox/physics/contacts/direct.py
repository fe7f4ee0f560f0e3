"""Contacts and exact joints, solved together in one step.

pymunk drifts and finds the contacts. What it makes of them is put aside: the velocities before the
kick are kicked anew, and the impulses λ at joints, contacts and friction are found together, so
that after the next drift joints are as long as they were, no gap has shrunk, and nothing slips that
friction holds:

    q' = q + h v',    v' = v + L a + M⁻¹ Jᵀ λ,    C(q') = 0,    0 <= λ_n  ⊥  V(q') - V(q) >= 0, ...

L is the length of the kick and h that of the drift. This is leapfrog under constraints (SHAKE) with
the complementarity of contact (Moreau 1988; Stewart and Trinkle 1996; Anitescu and Potra 1997),
solved by Newton's method over the problem in `complementarity`. A heavy body on a light one is as
easy as any other: nothing takes turns.

A contact that approaches faster than its own step makes it do is an impact. Then the kick is taken
in three parts: to the step, with what rests and what is joined; the impact, all at once and at the
velocities, with Newton's law of restitution; and on from the step.
"""

from typing import NamedTuple

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.batch import NO_CONTACTS, Batch, Booleans, Contacts, Integers
from sandbox.physics.contacts.complementarity import (
    Active,
    Friction,
    Problem,
    Unsolvable,
    solve,
)
from sandbox.physics.contacts.features import Features, Figures, Touching, features
from sandbox.physics.contacts.islands import islands
from sandbox.physics.errors import JointFailure, NoForces
from sandbox.physics.exact.equations import (
    MAX_ITERATIONS,
    QUADRATIC,
    Coordinates,
    Rows,
    order,
)
from sandbox.physics.exact.solver import TAUT, ExactJoints
from sandbox.physics.sequence import Impacts
from sandbox.physics.settling import PLACES

ROUNDING = 1e-9
"""An approach slower than this share of the speeds that it is the difference of is none, nor is one
of this share of what acts in a step."""

EXACT = 1e-12
"""The share of the work of impacts that may be rounding."""

GROWS = 1.1
"""How many times its kinetic energy a kick may leave with joints and contacts, of what it would
leave without them. They give none but for what a step is too long for."""

FURTHER = 1.5
"""How many times as far as it moves in a step a body may be found in another at first."""

AT_REST = 1e-9
"""m/s, below which surfaces that meet do not slip."""

HALVINGS = 50
"""How often the share of a rebound that gives no energy is halved in on."""


class Surfaces(NamedTuple):
    """How n bodies touch.

    Attributes
    ----------
    figures
        Their outlines.
    friction, static, restitution
        (n, n), the pairs' coefficients.
    running
        (n, 2), how fast their surfaces run, as those of belts do [m/s].
    correction
        The share of an overlap that a step takes back.
    slop
        The overlap that is left alone [m].
    """

    figures: Figures
    friction: Array
    static: Array
    restitution: Array
    running: Array
    correction: float
    slop: float


class Layout(NamedTuple):
    """The rows of a step: m of joints, k of gaps, f of slips, in this order.

    Attributes
    ----------
    problem
        What they ask for.
    islands
        The rows of each island.
    touching
        The points of the gaps and slips.
    restitution
        (k,), the coefficients of the gaps.
    gaps, slips
        Where they are among all rows.
    """

    problem: Problem
    islands: list[Integers]
    touching: Touching
    restitution: Array
    gaps: slice
    slips: slice


class Stage(NamedTuple):
    """A part of a kick with impacts: before them, the impacts, or after them.

    Attributes
    ----------
    lasts
        How long it is; 0 of the impacts [s].
    velocity
        (n, 3), the velocities that it ends with [m/s, rad/s].
    pulls
        (m,), the impulses along what joints keep; positive where they pull.
    contacts
        With the impulses in it.
    """

    lasts: float
    velocity: Array
    pulls: Array
    contacts: Contacts


class Kick(NamedTuple):
    """What is known of a kick before it is solved.

    Attributes
    ----------
    place
        Where everything is.
    layout, features
        The rows, and what touches what.
    here
        The rows where everything is.
    reply
        (r, 3 N), the velocities that a unit impulse of each gives.
    length
        (m,), what the joints keep after the drift.
    """

    place: Coordinates
    layout: Layout
    features: Features
    here: Rows
    reply: Array
    length: Array


class Known(NamedTuple):
    """What is known of a kick in the next one.

    Attributes
    ----------
    touching
        What touched.
    pull, force, along
        The forces of the joints, (m,), at the gaps, (k,), and along them, (f,) [N].
    on
        (k,), which gaps pushed.
    slip
        (f,), which way friction acted where it slipped; 0 elsewhere.
    """

    touching: Touching
    pull: Array
    force: Array
    along: Array
    on: Booleans
    slip: Integers


class Direct:
    """Solves contacts and exact joints together; n bodies.

    Parameters
    ----------
    batch
        Reads and writes the bodies.
    joints
        The exact ones; they may be none.
    surfaces
        How bodies touch.
    inertia
        (n, 3), masses, masses and moments; 0 of what nothing moves or turns [kg, kg m²].
    dt
        The time step [s].
    strikes
        Whether impacts are found here; else somebody else has seen to them.

    Attributes
    ----------
    contacts
        Those of the last kick.
    last
        What impacts did in it.
    stages
        Its parts, if there were impacts; else none.
    """

    def __init__(
        self,
        batch: Batch,
        joints: ExactJoints,
        surfaces: Surfaces,
        inertia: Array,
        dt: float,
        *,
        strikes: bool,
    ) -> None:
        self._batch, self._joints, self._surfaces = batch, joints, surfaces
        self._dt, self._strikes = dt, strikes
        self._belts = bool(surfaces.running.any())
        self._moves: Booleans = inertia[:, 0] > 0
        self._inertia = inertia
        self._order = order(len(inertia))
        self._begun = self._pull = self._change = np.zeros_like(inertia)
        self._lead = 0.0
        self._until = 0.0
        self._length = self._next = joints.lengths(0.0)
        self._laid: tuple[bytes, Layout] | None = None
        self._known: Known | None = None
        self._pairs: set[tuple[int, int]] | None = None  # that touched in the last step, if known
        self.contacts: Contacts = NO_CONTACTS
        self.last = _nothing(self._begun)
        self.stages: tuple[Stage, ...] = ()

    def begin(self, pull: Array, *, start: bool) -> None:
        """Take note of the velocities before a kick, and of what acts in it.

        Parameters
        ----------
        pull
            (n, 3), the accelerations by gravity and force laws [m/s², rad/s²].
        start
            Whether this is the first kick, which begins with the velocities at its step.
        """
        self._begun, self._pull = self._batch.velocity(), pull
        self._lead = 0.0 if start else self._joints.kick - self._dt / 2

    def solve(self, until: float) -> None:
        """Find the impulses of a kick, and give the bodies their velocities after it.

        Parameters
        ----------
        until
            The time at the end of the drift that follows [s].

        Raises
        ------
        JointFailure, NoForces
            If there are none.
        """
        self.contacts = self._believed(self._batch.contacts())
        self.last, self.stages = _nothing(self._begun), ()
        self._follow(until)
        if len(self.contacts.bodies) or self._joints.added.any():
            self._solve_all()
        else:
            self._known = None
            self._solve_joints(until)
        after = self._batch.velocity()
        struck = self.last.struck[:, None]
        whole = (after - self._begun) * (self._dt / self._joints.kick)
        self._change = np.where(struck, 2 * (after - self.last.velocity), whole)

    def forget(self) -> None:
        """Begin anew: bodies were put elsewhere."""
        self._pairs, self._known = None, None
        self._change = np.zeros_like(self._change)

    def _believed(self, contacts: Contacts) -> Contacts:
        """Return the contacts that there are.

        Of shapes that lie parallel, far from each other, pymunk now and then finds that they touch,
        without a direction or deep in each other. What has not touched in the step before can be no
        deeper in each other than the bodies have moved.
        """
        if not len(contacts.bodies):
            self._pairs = set()
            return contacts
        pairs = [(a, b) if a < b else (b, a) for a, b in contacts.bodies.tolist()]
        known = self._pairs
        good: Booleans = np.asarray(contacts.direction.any(axis=1))
        if known is not None and (new := np.array([pair not in known for pair in pairs])).any():
            good &= ~new | (contacts.depth <= self._moved(contacts))
        self._pairs = {pair for pair, keep in zip(pairs, good, strict=True) if keep}
        return contacts if good.all() else Contacts._make(field[good] for field in contacts)

    def _moved(self, contacts: Contacts) -> Array:
        """Return how far bodies can have come into each other in a step: (k,) [m]."""
        place = self._batch.state()[:, :2]
        arms = np.hypot(*np.moveaxis(contacts.points[:, :1] - place[contacts.bodies], 2, 0))
        motion = self._begun[contacts.bodies]
        ways = np.hypot(motion[..., 0], motion[..., 1]) + arms * np.abs(motion[..., 2])
        return np.asarray(FURTHER * ways.sum(axis=1) * self._dt + QUADRATIC)

    def _solve_joints(self, until: float) -> None:
        """Solve joints that nothing touches; ropes that come to no terms as contacts are."""
        velocity = self._batch.velocity()
        try:
            self._joints.solve(until)
        except JointFailure:
            self._batch.set_velocity(velocity)
            self._solve_all()

    def _follow(self, until: float) -> None:
        """Take up what joints keep after the drift, and what they kept before it."""
        if until == self._until and not self._joints.added.any():
            return
        lengths = self._joints.lengths(until)
        known = len(self._next) == len(lengths)
        self._until, self._length, self._next = until, self._next if known else lengths, lengths

    def _solve_all(self) -> None:
        self._joints.check()
        kick = self._look()
        if (self.contacts.depths > self._surfaces.slop).any() and self._surfaces.correction:
            kick = self._part(kick)
        begun, pull, lead = self._spread(self._begun), self._spread(self._pull), self._lead
        total = np.zeros(len(kick.reply))
        struck = self._struck(kick, begun + pull * lead, pull)
        if struck.any() or self._joints.added.any():
            came, total = self._come(kick, begun + pull * lead, struck)
            begun, pushes = self._bounce(kick, came, struck)
            self.stages = self._stage(kick, lead, came, total), self._stage(kick, 0, begun, pushes)
            total = total + pushes
            self._tell(kick, begun, pushes)
        else:
            lead = 0.0
        rest = self._joints.kick - lead
        impulse, moved, active = self._hold(kick, begun, pull, rest)
        if self.stages:
            self.stages = *self.stages, self._stage(kick, rest, moved, impulse)
        total = total + impulse
        self._batch.set_velocity(moved[self._order])
        self._note(kick, total, impulse, active, lead)

    # what there is

    def _look(self) -> Kick:
        """Return the rows where everything is."""
        place, _ = self._joints.coordinates()
        layout = self._lay_out()
        found = features(
            self.contacts,
            layout.touching,
            self._surfaces.figures,
            place,
            self._moves,
            self._joints.origin,
        )
        return self._kick_from(place, layout, found)

    def _kick_from(self, place: Coordinates, layout: Layout, found: Features) -> Kick:
        here = self._rows(place, found)
        return Kick(place, layout, found, here, here.gradient * self._joints.inverse, self._next)

    def _lay_out(self) -> Layout:
        contacts = self.contacts
        key = contacts.bodies.tobytes() + contacts.touches.tobytes() + bytes(len(self._next))
        if self._laid is None or self._laid[0] != key:
            self._laid = key, self._layout(contacts)
        return self._laid[1]

    def _layout(self, contacts: Contacts) -> Layout:
        """Return the rows of these contacts; the two points of a side share one friction."""
        joints, count = self._count, len(contacts.bodies)
        two = np.flatnonzero(contacts.touches == 2)
        pair = np.concatenate((np.arange(count), two))
        a, b = contacts.bodies[pair].T
        slips, static = self._surfaces.friction[a, b], self._surfaces.static[a, b]
        rubs = np.flatnonzero((slips[:count] > 0) | (static[:count] > 0))
        touching = Touching(a, b, pair, np.repeat((0, 1), (count, len(two))), rubs)
        partner = np.full(count, -1)
        partner[two] = count + np.arange(len(two))
        contact = np.stack((rubs, partner[rubs]), axis=1)
        contact = np.where(contact >= 0, contact + joints, -1)
        gaps = slice(joints, joints + len(pair))
        whole = gaps.stop + len(rubs)
        free, pushes = np.zeros(whole, dtype=bool), np.zeros(whole, dtype=bool)
        free[:joints] = ~self._joints.pulls_only
        pushes[:joints] = self._joints.pulls_only
        pushes[gaps] = True
        row = np.arange(gaps.stop, whole)
        friction = Friction(row, contact, static[rubs], slips[rubs], np.zeros(len(rubs)))
        touch = contacts.bodies[pair]
        bodies = [*self._joints.bodies, *touch, *touch[rubs]]
        return Layout(
            Problem(free, pushes, friction),
            islands(bodies, self._moves),
            touching,
            self._surfaces.restitution[a, b],
            gaps,
            slice(gaps.stop, whole),
        )

    @property
    def _count(self) -> int:
        """How many rows the joints have."""
        return len(self._joints.pulls_only)

    def _rows(self, place: Coordinates, found: Features) -> Rows:
        """Return all rows somewhere: joints as what is left of what they keep."""
        touch = found.look(place)
        if not self._count:
            return touch
        joints = self._joints.look(place)
        return Rows(
            np.concatenate((-joints.total, touch.total)),
            np.concatenate((-joints.gradient, touch.gradient)),
        )

    def _runs(self, kick: Kick) -> Array:
        """Return how fast surfaces slip by themselves, as belts do: (f,) [m/s]."""
        a, b, pair, _, rubs = kick.layout.touching
        if not self._belts:
            return np.zeros(len(rubs))
        running = self._surfaces.running
        runs, direction = running[b[rubs]] - running[a[rubs]], self.contacts.direction[pair[rubs]]
        return np.asarray(runs[:, 1] * direction[:, 0] - runs[:, 0] * direction[:, 1])

    def _spread(self, rates: Array) -> Array:
        """Return rates (n, 3) as rows have coordinates."""
        values = np.zeros(3 * len(rates) + 3)
        values[self._order] = rates
        return values

    # overlaps

    def _part(self, kick: Kick) -> Kick:
        """Take back a share of what overlaps too much: bodies are moved, velocities stay.

        As far as they part by themselves they are left to, for what bounces would have more energy
        further up; so is what has only met. What joints hold in each other stays as it is.
        """
        _, _, pair, point, _ = kick.layout.touching
        parting = kick.here.gradient[kick.layout.gaps] @ self._spread(self._begun)
        parting[self._pressed(kick)] = 0.0  # what rolls on parts a little, by the bend of its way
        deep = self.contacts.depths[pair, point] - self._surfaces.slop
        back = self._surfaces.correction * deep - np.maximum(parting, 0.0) * self._dt
        back = np.where(self._met(kick), np.maximum(back, 0.0), 0.0)
        if not back.any():
            return kick
        wanted = self._targets(kick)
        wanted[: self._count] = kick.here.total[: self._count]
        wanted[kick.layout.gaps] += back
        still = np.zeros_like(kick.place.values)
        layout = kick.layout
        none = np.zeros(len(layout.touching.rubs))
        friction = layout.problem.friction._replace(sticks=none, slips=none)
        smooth = layout._replace(problem=layout.problem._replace(friction=friction))
        none = np.zeros(len(wanted))
        try:
            moved = self._newton(kick._replace(layout=smooth), still, 1.0, wanted, none, None)[1]
        except (JointFailure, NoForces):
            return kick
        place = Coordinates(kick.place.values + moved)
        state = self._batch.state()
        shifted = moved[self._order]
        state[:, :3] = np.where(self._moves[:, None], state[:, :3] + shifted, state[:, :3])
        self._batch.set_state(state)
        return self._kick_from(place, layout, kick.features.moved(place))

    def _pressed(self, kick: Kick) -> Booleans:
        """Return which gaps pushed in the last kick: (k,)."""
        nothing = np.zeros_like(kick.place.values)
        return self._recalled(kick, nothing)[0] > 0

    def _met(self, kick: Kick) -> Booleans:
        """Return which gaps there were in the last kick: (k,)."""
        touching, known = kick.layout.touching, self._known
        if known is None:
            return np.zeros(len(touching.a), dtype=bool)
        if known.touching is touching:
            return np.ones(len(touching.a), dtype=bool)
        before = set(_keys(known.touching))
        return np.array([key in before for key in _keys(touching)])

    # impacts

    def _struck(self, kick: Kick, came: Array, pull: Array) -> Booleans:
        """Return which gaps close faster than what acts in a step makes them: (k,)."""
        gradient = kick.here.gradient[kick.layout.gaps]
        if not self._strikes:
            return np.zeros(len(gradient), dtype=bool)
        gives = np.abs(gradient @ np.stack((pull * self._dt, self._spread(self._change)), axis=1))
        speeds = np.abs(gradient) @ (np.abs(came) + np.abs(pull) * self._dt)
        allowed = gives.max(axis=1) + ROUNDING * speeds
        return np.asarray(gradient @ came < -allowed)

    def _come(self, kick: Kick, motion: Array, struck: Booleans) -> tuple[Array, Array]:
        """Return the velocities at the step before its impacts, and the impulses until there."""
        out = np.zeros(len(kick.reply), dtype=bool)
        out[: self._count] = self._joints.added
        out[kick.layout.gaps] = struck
        impulse = self._impulses(kick, motion, np.zeros(len(kick.reply)), out)
        return motion + impulse @ kick.reply, impulse

    def _bounce(self, kick: Kick, came: Array, struck: Booleans) -> tuple[Array, Array]:
        """Return the velocities after the impacts of a step, and their impulses.

        Newton's law of restitution does not look at friction, and can give energy with it (Kane and
        Levinson 1985). Then as much of the rebound is taken as gives none.
        """
        layout, gradient = kick.layout, kick.here.gradient
        approach = np.minimum(gradient[layout.gaps] @ came, 0.0) * struck
        leaves = np.zeros(len(kick.reply))
        leaves[layout.gaps] = layout.restitution * approach
        none = np.zeros(len(kick.reply), dtype=bool)

        def bounce(share: float) -> tuple[Array, float]:
            impulse = self._impulses(kick, came, share * leaves, none)
            rates = gradient @ came
            rates[layout.slips] += self._runs(kick)
            after = rates + gradient @ (impulse @ kick.reply)
            touch = slice(self._count, None)
            return impulse, float(impulse[touch] @ (rates + after)[touch]) / 2

        impulse, work = bounce(1.0)
        turned = float(np.abs(impulse) @ np.abs(kick.here.gradient @ came))
        if work > EXACT * turned and leaves.any():
            low, high = 0.0, 1.0
            for _ in range(HALVINGS):
                share = (low + high) / 2
                impulse, work = bounce(share)
                low, high = (share, high) if work <= 0 else (low, share)
            impulse, _ = bounce(low)
        return came + impulse @ kick.reply, impulse

    def _impulses(self, kick: Kick, motion: Array, leaves: Array, out: Booleans) -> Array:
        """Return the impulses at which velocities obey all rows but those that are out: (r,)."""
        problem, count = kick.layout.problem, self._count
        rate = kick.here.gradient @ motion + leaves
        rate[:count] += self._joint_rates(kick)
        rate[kick.layout.slips] += self._runs(kick)
        slack = np.zeros(len(rate), dtype=bool)
        slack[:count] = self._joints.pulls_only & (
            kick.here.total[:count] + self._length > TAUT + QUADRATIC
        )
        problem = problem._replace(free=problem.free & ~out, pushes=problem.pushes & ~out & ~slack)
        on = problem.free | (problem.pushes & (rate < 0))
        slips = np.zeros(len(problem.friction.row), dtype=np.intp)
        guess = Active(on, slips)
        return self._solve(kick, kick.here.gradient, problem, rate, guess)[0]

    def _joint_rates(self, kick: Kick) -> Array:
        """Return how fast what joints keep grows at the step: (m,) [m/s, rad/s]."""
        return np.asarray((kick.length - self._length) / self._joints.drift)

    def _tell(self, kick: Kick, left: Array, pushes: Array) -> None:
        """Note what impacts did."""
        jump = (pushes @ kick.reply)[self._order]
        reached = np.zeros(len(jump), dtype=bool)
        for rows in kick.layout.islands:
            if pushes[rows].any():
                reply = kick.reply[rows][:, self._order]
                reached |= reply.any(axis=(0, 2))
        jump = np.where(reached[:, None], jump, 0.0)
        self.last = Impacts(reached, jump, left[self._order], np.zeros(len(jump)))

    # the kick

    def _targets(self, kick: Kick) -> Array:
        """Return what the rows shall be after the drift: (r,)."""
        wanted = kick.here.total.copy()
        wanted[: self._count] = -kick.length
        wanted[kick.layout.slips] -= self._joints.drift * self._runs(kick)
        return wanted

    def _hold(
        self, kick: Kick, begun: Array, pull: Array, length: float
    ) -> tuple[Array, Array, Active]:
        """Return impulses with which all rows hold after the drift, and the velocities then.

        Newton's method begins with the forces of the step before. Where it does not come home, or
        comes with energy that nothing gave, bodies are jammed: what contacts have to give way by
        within a step is beyond them, and they are kept at the velocities instead of the places.
        """
        motion, wanted = begun + pull * length, self._targets(kick)
        guess, active = self._expected(kick, motion, length)
        drift = self._joints.drift
        try:
            found = self._newton(kick, motion, drift, wanted, guess, active)
            if self._kinetic(found[1]) <= GROWS * self._kinetic(motion):
                return found
        except (JointFailure, NoForces):
            pass
        return self._newton(kick, motion, drift, wanted, np.zeros(len(guess)), active, flat=True)

    def _kinetic(self, motion: Array) -> float:
        """Return the kinetic energy of velocities [J]."""
        return float(np.sum(self._inertia * motion[self._order] ** 2)) / 2

    def _newton(
        self,
        kick: Kick,
        motion: Array,
        drift: float,
        wanted: Array,
        impulse: Array,
        active: Active | None,
        *,
        flat: bool = False,
    ) -> tuple[Array, Array, Active]:
        """Return impulses, the velocities with them, and which rows hold, by Newton's method.

        Parameters
        ----------
        kick
            What is known.
        motion
            (3 N,), the velocities without impulses [m/s, rad/s].
        drift
            How long they last [s].
        wanted
            (r,), what the rows shall be after it.
        impulse, active
            A guess.
        flat
            Whether contacts are taken to change with the places as they do at the start.
        """
        problem = kick.layout.problem
        if active is None:
            active = Active(problem.free, np.zeros(len(problem.friction.row), dtype=np.intp))
        for _ in range(MAX_ITERATIONS):
            moved = motion + impulse @ kick.reply
            there = self._rows(Coordinates(kick.place.values + drift * moved), kick.features)
            if flat:
                there = self._flat(kick, there, drift * moved)
            wrong = there.total - wanted
            before = active
            rate = wrong / drift
            found, active = self._solve(kick, there.gradient, problem, rate, active, impulse)
            impulse = found
            off = np.where(active.on, np.abs(wrong), 0.0)
            if off.max(initial=0.0) <= QUADRATIC and active.key == before.key:
                return impulse, motion + impulse @ kick.reply, active
        raise self._lost(kick, int(off.argmax()))

    def _flat(self, kick: Kick, there: Rows, way: Array) -> Rows:
        """Return rows after a way, with contacts as if they changed with it linearly."""
        here, touch = kick.here, slice(self._count, None)
        total, gradient = there.total.copy(), there.gradient.copy()
        total[touch] = here.total[touch] + here.gradient[touch] @ way
        gradient[touch] = here.gradient[touch]
        return Rows(total, gradient)

    def _solve(
        self,
        kick: Kick,
        gradient: Array,
        problem: Problem,
        rate: Array,
        active: Active,
        impulse: Array | None = None,
    ) -> tuple[Array, Active]:
        """Solve each island by itself; rates are those with the impulses, if there are any."""
        found = np.zeros(len(rate))
        blur = PLACES * float(np.abs(kick.place.values).max()) / abs(self._joints.drift)
        on, slip = np.zeros(len(rate), dtype=bool), np.zeros_like(active.slip)
        first = kick.layout.slips.start
        for rows in kick.layout.islands:
            part, guess, slips = problem, active, rows[rows >= first] - first
            matrix, free, own = gradient, rate, impulse
            reply = kick.reply
            if len(rows) < len(rate):
                part = _part_of(problem, rows, slips)
                guess = Active(active.on[rows], active.slip[slips])
                matrix, reply, free = gradient[rows], reply[rows], rate[rows]
                own = None if impulse is None else impulse[rows]
            matrix = matrix @ reply.T
            free = free if own is None else free - matrix @ own
            try:
                found[rows], held = solve(part, matrix, free, guess, blur)
            except (Unsolvable, np.linalg.LinAlgError) as error:
                row = error.row if isinstance(error, Unsolvable) else 0
                raise self._lost(kick, int(rows[row])) from None
            on[rows], slip[slips] = held
        return found, Active(on, slip)

    def _lost(self, kick: Kick, row: int) -> JointFailure | NoForces:
        """Say what no impulses were found for."""
        if row < self._count:
            return self._joints.lost(row)
        a, b, _, _, rubs = kick.layout.touching
        gap = row - self._count
        gap = gap if gap < len(a) else int(rubs[gap - len(a)])
        return NoForces(int(a[gap]), int(b[gap]))

    # what is known of the step before

    def _expected(self, kick: Kick, motion: Array, length: float) -> tuple[Array, Active]:
        """Return the impulses by the forces of the last kick in so many seconds; what held."""
        layout = kick.layout
        force, along, on, slip = self._recalled(kick, motion)
        pull, taut = self._joints.expected()
        if self._known and len(self._known.pull) == len(pull):
            pull = self._known.pull
        impulse = np.concatenate((pull, force, along)) * length
        if not len(slip):
            return impulse, Active(np.concatenate((taut, on)), slip)
        contact = layout.problem.friction.contact
        presses = (on[contact - self._count * (contact >= 0)] & (contact >= 0)).any(axis=1)
        slip = np.where(presses, slip, 0)
        return impulse, Active(np.concatenate((taut, on, presses & (slip == 0))), slip)

    def _recalled(self, kick: Kick, motion: Array) -> tuple[Array, Array, Booleans, Integers]:
        """Return the forces at the gaps, (k,), and along them, (f,); what held, and what slipped.

        What is new holds if it meets, and slips if it does.
        """
        layout, known = kick.layout, self._known
        if known and known.touching is layout.touching:
            return known.force, known.along, known.on, known.slip
        rates = kick.here.gradient @ motion
        rates[layout.slips] += self._runs(kick)
        on, speed = rates[layout.gaps] < 0, rates[layout.slips]
        force, along = np.zeros(len(on)), np.zeros(len(speed))
        slip = np.where(np.abs(speed) > AT_REST, -np.sign(speed), 0).astype(np.intp)
        if known:
            rubs = {int(gap): place for place, gap in enumerate(layout.touching.rubs)}
            before = {int(gap): place for place, gap in enumerate(known.touching.rubs)}
            numbers = {key: gap for gap, key in enumerate(_keys(known.touching))}
            for gap, key in enumerate(_keys(layout.touching)):
                if (old := numbers.get(key)) is None:
                    continue
                force[gap], on[gap] = known.force[old], known.on[old]
                if gap in rubs and old in before:
                    along[rubs[gap]] = known.along[before[old]]
                    slip[rubs[gap]] = known.slip[before[old]]
        return force, along, on, slip

    def _stage(self, kick: Kick, lasts: float, ended: Array, impulse: Array) -> Stage:
        """Return what a part of the kick did."""
        pulls, contacts = impulse[: self._count], self._with(kick, impulse)
        return Stage(lasts, ended[self._order], pulls, contacts)

    def _with(self, kick: Kick, impulse: Array) -> Contacts:
        """Return the contacts with such impulses (r,)."""
        layout, touching = kick.layout, kick.layout.touching
        number = len(self.contacts.bodies)
        normal = np.bincount(touching.pair, impulse[layout.gaps], number).astype(float)
        friction = np.zeros(number)
        friction[touching.rubs] = impulse[layout.slips]
        direction = self.contacts.direction
        sideways = np.stack((-direction[:, 1], direction[:, 0]), axis=1)
        return self.contacts._replace(
            normal=normal,
            friction=np.abs(friction),
            impulse=direction * normal[:, None] + sideways * friction[:, None],
        )

    def _note(self, kick: Kick, total: Array, impulse: Array, active: Active, lead: float) -> None:
        """Keep what the kick was solved with, and tell its contacts."""
        layout, touching, count = kick.layout, kick.layout.touching, self._count
        struck = bool(self.last.struck.any())
        self._joints.take(total[:count] / self._joints.kick, active.on[:count], struck=struck)
        self.contacts = self._with(kick, total)
        forces = impulse / (self._joints.kick - lead)
        self._known = Known(
            touching,
            forces[:count],
            forces[layout.gaps],
            forces[layout.slips],
            active.on[layout.gaps],
            active.slip,
        )


def _keys(touching: Touching) -> list[tuple[int, int, int]]:
    """Return by what the gaps are known again in the next step."""
    seen: dict[tuple[int, int], int] = {}
    keys = []
    for a, b in zip(touching.a.tolist(), touching.b.tolist(), strict=True):
        both = (a, b) if a < b else (b, a)
        number = seen.get(both, 0)
        seen[both] = number + 1
        keys.append((*both, number))
    return keys


def _part_of(problem: Problem, rows: Integers, slips: Integers) -> Problem:
    """Return what some rows ask for, numbered by themselves."""
    if len(rows) == len(problem.free):
        return problem
    number = np.full(len(problem.free) + 1, -1)
    number[rows] = np.arange(len(rows))
    old = problem.friction
    friction = Friction(
        number[old.row[slips]],
        number[old.contact[slips]],
        old.sticks[slips],
        old.slips[slips],
        old.least[slips],
    )
    return Problem(problem.free[rows], problem.pushes[rows], friction)


def _nothing(velocity: Array) -> Impacts:
    """Return that there was no impact."""
    none = np.zeros(len(velocity), dtype=bool)
    return Impacts(none, np.zeros_like(velocity), velocity, np.zeros(len(velocity)))
