"""Invariants: what must hold in any run, without a closed form.

A judge yields judgements, each with a name, a figure, its bound, and whether it is met. A judge
that does not apply to a scene yields none.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import inf, log2
from typing import NamedTuple

import numpy as np

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Array
from sandbox.physics.state.snapshot import Snapshot
from validation.random_compositions.body_distances import SKIN, couples, excess, overlapped
from validation.random_compositions.independent_energy import NEXT, Energies, is_passive
from validation.random_compositions.independent_shape_properties import extent, is_dynamic
from validation.random_compositions.joint_constraints import JointConstraints, Places
from validation.random_compositions.recorded_run import RecordedRun, Refused, positions, run, start
from validation.random_compositions.scene_symmetries import mirrored, turned
from validation.random_compositions.static_equilibrium import Measured, Statics
from validation.stability.hard_case import make
from validation.stability.scene_parts import Document

FORCES = 1e-6
"""The tolerance of forces, relative to the total weight. The linear programme is solved to 1e-7,
and surfaces are located to a skin of 1e-9 m: a millionth of the shortest arm of 1 cm at a leverage
of ten."""

MARGIN = 0.9
"""The share of its friction with which a scene must stand to be expected at rest, since rounding
may tip one that barely stands."""

DRIFT = 1e-5
"""The tolerance at rest [m]: contacts may sink by the skin of 1e-6 m, at a leverage of ten."""

JOINTS = 1e-9
"""The tolerance of joints [m]: the rounding of positions of 10 m is 1e-15 m, times a thousand for a
hundred or more equations, times a thousand for mass ratios of 1000 : 1."""

MOMENTUM = 1e-10
"""The relative tolerance of momentum: rounding, 1e-16, times a thousand steps, times a thousand for
mass ratios of 1000 : 1."""

ORDER = 1.8
"""The least power of the step with which errors fall: 2, less the effect of the next term."""

EXACT = 1e-9
"""The error below which it is rounding [m]; see `JOINTS`."""

COARSE = 0.03
"""The error above which no order can show, since the runs have diverged [m]."""

FINELY = 4
"""How many times finer a run is with which the energy of another is compared."""

FEW = 12
"""The least number of steps that show an order or a symmetry."""

SYMMETRY = 1e-9
"""The tolerance of symmetries [m]: rounding that grows as e^(t √(g / l)), which within `WINDOW` and
for l = 2 cm is a factor of 7000."""

WINDOW = 0.4
"""The time for which a symmetry is checked, unless a new contact ends it [s]: after that, rounding
decides which corner hits first."""

TURN = 0.7
"""The angle by which a scene is turned [rad]."""


@dataclass(frozen=True, slots=True)
class Judgement:
    """A judgement; the figures of `order` and `runs` must be at least their bounds."""

    name: str
    figure: float
    bound: float
    passed: bool


def _most(name: str, figure: float, bound: float) -> Judgement:
    return Judgement(name, figure, bound, bool(figure <= bound))


def _least(name: str, figure: float, bound: float) -> Judgement:
    return Judgement(name, figure, bound, bool(figure >= bound))


class Case:
    """A run, and the data that several judges need."""

    def __init__(self, recorded: RecordedRun) -> None:
        self.recorded = recorded
        self.document: Document = recorded.scene.document
        self.keeping = JointConstraints(self.document, recorded.level)
        self.energies = Energies(recorded, self.keeping)
        seen = recorded.states
        touches = "contact" in self.document["effects"]
        found = couples(self.document, seen.position, seen.angle) if touches else ()
        self.couples = list(found)
        self.overlapped = sum(overlapped(couple) for couple in self.couples)
        bodies = self.document["bodies"].values()
        self.extents = np.array([extent(b) if is_dynamic(b) else 0.0 for b in bodies])

    def poses(self, at: int | None = None) -> Places:
        """Return the positions of the bodies, at all instants or at one."""
        seen, rows = self.recorded.states, slice(None) if at is None else slice(at, at + 1)
        x, y = seen.position[rows, :, 0], seen.position[rows, :, 1]
        return Places(x, y, seen.angle[rows], seen.t[rows])

    def rough(self) -> bool:
        """Whether there is friction."""
        return "friction" in self.document["effects"]

    def steps_before_tipping(self) -> int:
        """Return the number of steps until rounding tips a scene that is in unstable balance.

        A strut that stands upright under its load falls to a side that rounding decides. A scene
        that moves from the start returns all of its steps.
        """
        places = self.recorded.states.position[:, self.extents > 0]
        gone = np.abs(places - places[0]).max(axis=(1, 2), initial=0.0)
        if gone[min(FEW, self.recorded.steps)] > EXACT:
            return self.recorded.steps
        moved = np.flatnonzero(gone > EXACT)
        return int(moved[0]) if moved.size else self.recorded.steps


def runs(case: Case) -> Iterator[Judgement]:
    """Require that the run reaches its end."""
    recorded = case.recorded
    came = float(recorded.states.t[-1])
    yield Judgement("runs", came, recorded.intended_duration, not recorded.failure)


def statics(case: Case) -> Iterator[Judgement]:
    """Require that bodies at rest stay so, held by forces in equilibrium."""
    recorded = case.recorded
    if not recorded.scene.is_at_rest:
        return
    if not Statics(case.document, case.keeping, case.poses(0)).stands(MARGIN):
        return
    last = recorded.steps
    worst = 0.0
    for at in sorted({0, 1, last // 3, last // 3 + 1, 2 * last // 3, last - 1, last} - {-1}):
        there = Statics(case.document, case.keeping, case.poses(at))
        measured = Measured(recorded.states.normal[at], recorded.states.tension[at])
        worst = max(worst, there.error(measured))
    yield _most("statics", worst, FORCES)
    yield _most("drift", _furthest(case, recorded.states, recorded.states), DRIFT)


def _furthest(case: Case, state: Snapshot, start: Snapshot) -> float:
    """Return the largest distance of any point of a dynamic body from its start [m]."""
    moved = np.hypot(*np.moveaxis(state.position - start.position[0], -1, 0))
    turns = np.abs(state.angle - start.angle[0]) * case.extents
    kinetic = np.array([not is_dynamic(b) for b in case.document["bodies"].values()])
    return float(np.where(kinetic, 0.0, moved + turns).max())


def energy(case: Case) -> Iterator[Judgement]:
    """Require that no energy appears, and that the energy balance closes.

    Energy must not grow, neither from the start nor later. The latter is read between steps, since
    velocities at the step of an impact are the mean of those before and after it.
    """
    errors = _energy_errors(case)
    allowed = case.energies.allowed(case.overlapped)
    if max(errors.values()) > allowed:
        allowed = max(allowed, _whipped(case))
    for name, error in errors.items():
        yield _most(name, error, allowed)


def _energy_errors(case: Case) -> dict[str, float]:
    """Return the energy that the ledger cannot explain and, where none may, that appeared [J]."""
    total, booked = case.energies.total, case.recorded.ledger_energy
    books = float(np.abs(case.recorded.unexplained).max())
    if not is_passive(case.document):
        return {"books": books}
    later = (booked - np.minimum.accumulate(booked)).max()
    return {"energy": float(max((total - total[0]).max(), later)), "books": books}


def _whipped(case: Case) -> float:
    """Return the error allowed where a joint whips a body round faster than was foreseen [J].

    A finer run tells the peak of its acceleration, and what a second-order error would be. One
    that does not conserve energy itself allows nothing.
    """
    recorded = case.recorded
    try:
        world = start(recorded.level, FINELY * recorded.rate)
    except Refused:
        return 0.0
    finer = Case(run(recorded.scene, recorded.level, world, float(recorded.states.t[-1])))
    error = max(_energy_errors(finer).values())
    if error > finer.energies.allowed(finer.overlapped):
        return 0.0
    return NEXT * min(case.energies.swings(finer.recorded.states), FINELY**2 * error)


def momentum(case: Case) -> Iterator[Judgement]:
    """Require that momentum changes by impulses only, and otherwise not at all.

    Bodies that are pushed out of an overlap carry their momentum along; that much angular momentum
    is allowed.
    """
    recorded, energies = case.recorded, case.energies
    far, t = 1 + np.abs(recorded.states.position).max(), recorded.states.t[-1]
    bustle = energies.bustle.max(axis=0)
    scale = bustle + energies.weight() * t * np.array((1, 1, far))
    scale = np.where(scale > 0, scale, inf)
    pushed = np.array((0.0, 0.0, case.overlapped * scale[0]))
    lost = np.abs(recorded.lost_momentum)
    axes = [("x", "y", "angle").index(name) for name in recorded.scene.conserved_momenta]
    lost[:, axes] = np.maximum(lost, np.abs(energies.momentum - energies.momentum[0]))[:, axes]
    figure = float((np.maximum(lost - pushed, 0.0) / scale).max())
    yield _most("momentum", figure, MOMENTUM)


def joints(case: Case) -> Iterator[Judgement]:
    """Require that joints hold at every step."""
    kept = case.keeping(case.poses())
    if kept:
        yield _most("joints", max(float(k.error.max()) for k in kept), JOINTS)


def overlap(case: Case) -> Iterator[Judgement]:
    """Require that bodies do not overlap.

    An impact is found at the first step after it, at a depth of up to the motion in that step; this
    depth is allowed for a while. If the other corner of a side lands later, that is another impact.
    """
    if case.couples:
        yield _most(
            "overlap",
            max(excess(case.recorded, couple, case.extents) for couple in case.couples),
            SKIN,
        )


def order(case: Case) -> Iterator[Judgement]:
    """Require that errors fall with the square of the step, while forces change smoothly."""
    recorded = case.recorded
    steps = min(_smooth(case), int(WINDOW * recorded.rate))
    if steps < FEW:
        return
    try:
        errors = _errors(case, 1, steps)
        if COARSE > errors[1] > EXACT and log2(errors[0] / errors[1]) < ORDER:
            errors = _errors(case, 2, steps)  # the next power of the step may still matter
    except SandboxError:
        yield _least("order", 0.0, ORDER)
        return
    if errors[1] <= EXACT:
        yield _most("exact", errors[1], EXACT)
    elif errors[0] < COARSE:
        yield _least("order", log2(errors[0] / errors[1]), ORDER)


def _smooth(case: Case) -> int:
    """Return the number of steps before any force sets in or ends suddenly."""
    recorded = case.recorded
    if recorded.scene.is_at_rest or (case.rough() and any(recorded.pairs)):
        return 0  # nothing moves, or slipping may end at any time
    taut = recorded.taut[1:]  # not all schemes know the tensions at the start
    changed = np.flatnonzero((taut != taut[:1]).any(axis=1))
    setting_in = int(changed[0]) if changed.size else recorded.steps
    return min(recorded.undisturbed(), setting_in, case.steps_before_tipping()) - 1


def _errors(case: Case, finer: int, steps: int) -> tuple[float, float]:
    """Return the differences between runs at a rate, twice and four times that [m]."""
    recorded = case.recorded
    seen = [
        positions(recorded.level, recorded.rate * factor, steps, factor)
        for factor in (finer, 2 * finer, 4 * finer)
    ]
    return _apart(case, seen[0], seen[1]), _apart(case, seen[1], seen[2])


def _apart(case: Case, one: Snapshot, other: Snapshot) -> float:
    """Return the largest distance between corresponding points in two runs [m]."""
    apart = np.hypot(*np.moveaxis(one.position - other.position, -1, 0))
    return float((apart + np.abs(one.angle - other.angle) * case.extents).max())


def symmetry(case: Case) -> Iterator[Judgement]:
    """Require that a mirrored scene, and one rotated with its gravity, move accordingly.

    This is checked until there is a new contact, and for no longer than `WINDOW`.
    """
    recorded = case.recorded
    steps = min(recorded.undisturbed(), case.steps_before_tipping(), int(WINDOW * recorded.rate))
    if steps < FEW:
        return
    c, s = np.cos(TURN), np.sin(TURN)
    back = InverseTransform(np.array([[-1.0, 0.0], [0.0, 1.0]]), -1.0, 0.0)
    yield _most("mirror", _astray(case, mirrored(case.document), back, steps), SYMMETRY)
    back = InverseTransform(np.array([[c, s], [-s, c]]), 1.0, -TURN)
    yield _most("rotation", _astray(case, turned(case.document, TURN), back, steps), SYMMETRY)


class InverseTransform(NamedTuple):
    """The inverse transformation of a changed scene: a matrix for positions, and one for angles."""

    matrix: Array
    sign: float
    offset: float  # rad


def _astray(case: Case, document: Document, back: InverseTransform, steps: int) -> float:
    """Return the distance of a changed scene from the run [m]; infinite if it stops."""
    recorded = case.recorded
    try:
        there = positions(make(document), recorded.rate, steps, 1)
    except SandboxError:
        return inf
    place, angle = there.position @ back.matrix.T, back.sign * there.angle + back.offset
    apart = np.hypot(*np.moveaxis(place - recorded.states.position[: steps + 1], -1, 0))
    turn = np.abs(angle - recorded.states.angle[: steps + 1]) * case.extents
    moves = [is_dynamic(body) for body in case.document["bodies"].values()]
    return float((apart + turn)[:, moves].max())


Judge = Callable[[Case], Iterator[Judgement]]

JUDGES: Sequence[Judge] = (
    runs, statics, energy, momentum, joints, overlap, order, symmetry
)  # fmt: skip


def judge(recorded: RecordedRun, judges: Sequence[Judge] = JUDGES) -> list[Judgement]:
    """Return all judgements of a run, or those of given judges."""
    with np.errstate(all="ignore"):
        case = Case(recorded)
        return [found for one in judges for found in one(case)]
