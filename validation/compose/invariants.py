"""Invariants: what must hold in any run, without a formula for it.

A judge returns judgements: a name, a figure, a bound, and whether the one is within the other. Not
every scene has something to be judged by each; then there is none.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import inf, log2
from typing import NamedTuple

import numpy as np

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Array
from sandbox.physics.state.snapshot import Snapshot
from validation.compose.energies import Energies, is_passive
from validation.compose.joint_constraints import Keeping, Places
from validation.compose.overlaps import SKIN, excess, overlapped
from validation.compose.recorded_run import Course, positions
from validation.compose.separation import couples
from validation.compose.shapes import extent, is_dynamic
from validation.compose.statics import Measured, Statics
from validation.compose.symmetry import mirrored, turned
from validation.stability.case import make
from validation.stability.scene import Document

FORCES = 1e-6
"""Of all weights together. The linear programme is solved to 1e-7, and surfaces are where they are
to a skin of 1e-9 m, a millionth of the least arm of 1 cm at a lever of ten."""

MARGIN = 0.9
"""The share of its friction with which a scene must stand to be called at rest: what stands by a
hair may fall."""

DRIFT = 1e-5
"""m: touching bodies may sink by the skin, 1e-6 m, and a lever of ten may magnify it."""

JOINTS = 1e-9
"""m: rounding is 1e-15 m of the scenes' 10 m, a thousand times in some hundred of equations that
masses of 1000 : 1 may amplify by as much."""

MOMENTUM = 1e-10
"""Of all that is in motion: rounding, 1e-16, of a thousand steps, and a thousand times for masses
of 1000 : 1."""

ORDER = 1.8
"""The least power of the step with which errors fall: 2, less the effect of the next term."""

EXACT = 1e-9
"""m, below which an error is rounding; see `JOINTS`."""

COARSE = 0.03
"""m, errors beyond this show no order: the runs have diverged."""

FEW = 12
"""The least number of steps within which an order, or a symmetry, can be seen."""

SYMMETRY = 1e-9
"""m: rounding that grows as e^(t √(g / l)): in `WINDOW`, for l = 2 cm, by 7000 times."""

WINDOW = 0.4
"""s, for which a symmetry is checked, or until a new contact: after that, the last digit decides
which corner hits first."""

TURN = 0.7
"""rad, the angle by which a scene is turned."""


@dataclass(frozen=True, slots=True)
class Judgement:
    """One judgement; the figure of `order` and `runs` is to be at least the bound."""

    name: str
    figure: float
    bound: float
    passed: bool


def _most(name: str, figure: float, bound: float) -> Judgement:
    return Judgement(name, figure, bound, bool(figure <= bound))


def _least(name: str, figure: float, bound: float) -> Judgement:
    return Judgement(name, figure, bound, bool(figure >= bound))


class Case:
    """A run, and what several judges need of it."""

    def __init__(self, course: Course) -> None:
        self.course = course
        self.document: Document = course.scene.document
        self.keeping = Keeping(self.document, course.level)
        self.energies = Energies(course, self.keeping)
        seen = course.seen
        touches = "contact" in self.document["effects"]
        found = couples(self.document, seen.position, seen.angle) if touches else ()
        self.couples = list(found)
        self.overlapped = sum(overlapped(couple) for couple in self.couples)
        bodies = self.document["bodies"].values()
        self.extents = np.array([extent(b) if is_dynamic(b) else 0.0 for b in bodies])

    def places(self, at: int | None = None) -> Places:
        """Return where bodies are: at all instants, or at one."""
        seen, rows = self.course.seen, slice(None) if at is None else slice(at, at + 1)
        x, y = seen.position[rows, :, 0], seen.position[rows, :, 1]
        return Places(x, y, seen.angle[rows], seen.t[rows])

    def rough(self) -> bool:
        """Whether surfaces rub."""
        return "friction" in self.document["effects"]

    def steady(self) -> int:
        """Return how many steps pass before rounding tips what stood in balance, if it did.

        A strut that stands upright under its load falls one way or the other, by the last digit.
        """
        places = self.course.seen.position[:, self.extents > 0]
        gone = np.abs(places - places[0]).max(axis=(1, 2), initial=0.0)
        if gone[min(FEW, self.course.steps)] > EXACT:
            return self.course.steps
        moved = np.flatnonzero(gone > EXACT)
        return int(moved[0]) if moved.size else self.course.steps


def runs(case: Case) -> Iterator[Judgement]:
    """Ask that it comes to its end."""
    course = case.course
    came = float(course.seen.t[-1])
    yield Judgement("runs", came, course.asked, not course.failure)


def statics(case: Case) -> Iterator[Judgement]:
    """Require that bodies at rest stay so, held by forces that can hold them."""
    course = case.course
    if not course.scene.rests:
        return
    if not Statics(case.document, case.keeping, case.places(0)).stands(MARGIN):
        return
    last = course.steps
    worst = 0.0
    for at in sorted({0, 1, last // 3, last // 3 + 1, 2 * last // 3, last - 1, last} - {-1}):
        there = Statics(case.document, case.keeping, case.places(at))
        measured = Measured(course.seen.normal[at], course.seen.tension[at])
        worst = max(worst, there.error(measured))
    yield _most("statics", worst, FORCES)
    yield _most("drift", _furthest(case, course.seen, course.seen), DRIFT)


def _furthest(case: Case, seen: Snapshot, start: Snapshot) -> float:
    """Return how far any point of a body that moves is from where it started [m]."""
    moved = np.hypot(*np.moveaxis(seen.position - start.position[0], -1, 0))
    turns = np.abs(seen.angle - start.angle[0]) * case.extents
    kinetic = np.array([not is_dynamic(b) for b in case.document["bodies"].values()])
    return float(np.where(kinetic, 0.0, moved + turns).max())


def energy(case: Case) -> Iterator[Judgement]:
    """Ask that no energy comes from nowhere, and that the books close.

    It must not grow from the start on, nor later: read between two steps, for at the step of an
    impact what is held is read as the mean of before and after.
    """
    energies = case.energies
    allowed = energies.allowed(case.overlapped)
    if is_passive(case.document):
        grown = float((energies.total - energies.total[0]).max())
        booked = case.course.booked
        later = float((booked - np.minimum.accumulate(booked)).max())
        yield _most("energy", max(grown, later), allowed)
    yield _most("books", float(np.abs(case.course.unexplained).max()), allowed)


def momentum(case: Case) -> Iterator[Judgement]:
    """Ask that momentum changes by impulses, and not at all where nothing gives any.

    What is pushed out of an overlap takes its momentum elsewhere: that much angular momentum is let
    pass.
    """
    course, energies = case.course, case.energies
    far, t = 1 + np.abs(course.seen.position).max(), course.seen.t[-1]
    bustle = energies.bustle.max(axis=0)
    scale = bustle + energies.weight() * t * np.array((1, 1, far))
    scale = np.where(scale > 0, scale, inf)
    pushed = np.array((0.0, 0.0, case.overlapped * scale[0]))
    lost = np.abs(course.lost_momentum)
    axes = [("x", "y", "angle").index(name) for name in course.scene.free]
    lost[:, axes] = np.maximum(lost, np.abs(energies.momentum - energies.momentum[0]))[:, axes]
    figure = float((np.maximum(lost - pushed, 0.0) / scale).max())
    yield _most("momentum", figure, MOMENTUM)


def joints(case: Case) -> Iterator[Judgement]:
    """Ask that joints hold at every step."""
    kept = case.keeping(case.places())
    if kept:
        yield _most("joints", max(float(k.error.max()) for k in kept), JOINTS)


def overlap(case: Case) -> Iterator[Judgement]:
    """Ask that bodies keep out of each other.

    An impact is found at the first step after it, as deep as the way of that step; so much is let
    pass, for a while. Where the other corner of a side comes down later, that is another impact.
    """
    if case.couples:
        yield _most(
            "overlap",
            max(excess(case.course, couple, case.extents) for couple in case.couples),
            SKIN,
        )


def order(case: Case) -> Iterator[Judgement]:
    """Ask that errors fall with the square of the step, where nothing sets in or ends at once."""
    course = case.course
    steps = min(_smooth(case), int(WINDOW * course.rate))
    if steps < FEW:
        return
    try:
        errors = _errors(case, 1, steps)
        if COARSE > errors[1] > EXACT and log2(errors[0] / errors[1]) < ORDER:
            errors = _errors(case, 2, steps)  # the next power of the step may still have a say
    except SandboxError:
        yield _least("order", 0.0, ORDER)
        return
    if errors[1] <= EXACT:
        yield _most("exact", errors[1], EXACT)
    elif errors[0] < COARSE:
        yield _least("order", log2(errors[0] / errors[1]), ORDER)


def _smooth(case: Case) -> int:
    """Return how many steps pass without anything that sets in or ends at once."""
    course = case.course
    if course.scene.rests or (case.rough() and any(course.pairs)):
        return 0  # nothing moves, or slipping may end anywhere
    taut = course.taut[1:]  # not every scheme knows its pulls at the start
    changed = np.flatnonzero((taut != taut[:1]).any(axis=1))
    setting_in = int(changed[0]) if changed.size else course.steps
    return min(course.undisturbed(), setting_in, case.steady()) - 1


def _errors(case: Case, finer: int, steps: int) -> tuple[float, float]:
    """Return how far runs at a rate, twice and four times that are apart [m]."""
    course = case.course
    seen = [
        positions(course.level, course.rate * factor, steps, factor)
        for factor in (finer, 2 * finer, 4 * finer)
    ]
    return _apart(case, seen[0], seen[1]), _apart(case, seen[1], seen[2])


def _apart(case: Case, one: Snapshot, other: Snapshot) -> float:
    """Return how far points of bodies are apart in two runs [m]."""
    apart = np.hypot(*np.moveaxis(one.position - other.position, -1, 0))
    return float((apart + np.abs(one.angle - other.angle) * case.extents).max())


def symmetry(case: Case) -> Iterator[Judgement]:
    """Ask that a scene does the same in a mirror, or turned with its gravity.

    Looked at until something touches that did not, and for no longer than `WINDOW`.
    """
    course = case.course
    steps = min(course.undisturbed(), case.steady(), int(WINDOW * course.rate))
    if steps < FEW:
        return
    c, s = np.cos(TURN), np.sin(TURN)
    back = Back(np.array([[-1.0, 0.0], [0.0, 1.0]]), -1.0, 0.0)
    yield _most("mirror", _astray(case, mirrored(case.document), back, steps), SYMMETRY)
    back = Back(np.array([[c, s], [-s, c]]), 1.0, -TURN)
    yield _most("rotation", _astray(case, turned(case.document, TURN), back, steps), SYMMETRY)


class Back(NamedTuple):
    """What brings a scene that was changed back: places by a matrix, angles by sign and offset."""

    matrix: Array
    sign: float
    offset: float  # rad


def _astray(case: Case, document: Document, back: Back, steps: int) -> float:
    """Return how far a changed scene, brought back, is from the run [m]; infinite if it stops."""
    course = case.course
    try:
        there = positions(make(document), course.rate, steps, 1)
    except SandboxError:
        return inf
    place, angle = there.position @ back.matrix.T, back.sign * there.angle + back.offset
    apart = np.hypot(*np.moveaxis(place - course.seen.position[: steps + 1], -1, 0))
    turn = np.abs(angle - course.seen.angle[: steps + 1]) * case.extents
    moves = [is_dynamic(body) for body in case.document["bodies"].values()]
    return float((apart + turn)[:, moves].max())


Judge = Callable[[Case], Iterator[Judgement]]

JUDGES: Sequence[Judge] = (
    runs, statics, energy, momentum, joints, overlap, order, symmetry
)  # fmt: skip


def judge(course: Course, judges: Sequence[Judge] = JUDGES) -> list[Judgement]:
    """Return all judgements of a run, or those of some judges."""
    with np.errstate(all="ignore"):
        case = Case(course)
        return [found for one in judges for found in one(case)]
