"""Formulas in the time have a value for the whole run, and rods change their length gradually."""

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

from sandbox.model.errors import brief
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Array, Values
from sandbox.model.functions_of_one_variable import Formula
from sandbox.model.joints import Rod
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.level_parts import expressions
from sandbox.model.rules.conditions.condition import Condition
from sandbox.model.translatable_message import Message

MOST = 1000
"""The most times at which a formula is evaluated; each step, if there are fewer."""

FEW = 50
"""The least of these times in a level with many such formulas."""

SHARED = 100 * MOST
"""The times of all formulas together above which each gets fewer."""

HALVINGS = 40
"""The number of bisections of an interval in search of a jump."""

SMOOTH = 10
"""The number after which only intervals are bisected further in which a formula still changes."""

JUMP = 1e-6
"""The change within a 10¹²th of a step from which a formula jumps, as a share of its range."""

LENGTH, MOTION = Message("the rod's length"), Message("the motion")
"""The names of the formulas that may jump."""

STARTS = 1e-12
"""The tolerance of a motion's start, as a share, or in m or rad."""


Times = Callable[[Values], Array]
"""Returns the times at which formulas are evaluated [s]."""

Check = Callable[[Formula, Values], Message | None]
"""Says what is wrong with a formula."""


def conditions(level: Level) -> Iterator[Condition]:
    """Yield the conditions on the formulas in the time."""
    formulas = list(_formulas(level))
    times = partial(_times, level, max(min(MOST, SHARED // max(len(formulas), 1)), FEW))
    lost = _once(partial(_lost, times))
    jumps, displaced = _once(partial(_jumps, times, MOTION)), _once(_displaced)
    for path, formula in formulas:
        yield Condition(path, _names(formula, level), partial(lost, formula), 50)
    for name, joint in level.joints.items():
        if isinstance(joint, Rod) and joint.length and "t" in joint.length.names:
            path, names = ("joints", name, "length"), _names(joint.length, level)
            yield Condition(path, names, partial(_gone, joint.length, times), 50)
            yield Condition(path, names, partial(_jumps, times, LENGTH, joint.length), 1000)
    for path, formula in _motions(level):
        names = _names(formula, level)
        yield Condition(path, names, partial(displaced, formula), 50)
        yield Condition(path, names, partial(jumps, formula), 1000)


def _once(check: Check) -> Check:
    """Return the same check of a formula, made once for equal formulas and values of a level."""
    known: dict[tuple[object, ...], Message | None] = {}

    def checked(formula: Formula, values: Values) -> Message | None:
        key: tuple[object, ...] = (formula, *values.values())
        if key not in known:
            known[key] = check(formula, values)
        return known[key]

    return checked


def _names(formula: Formula, level: Level) -> frozenset[str]:
    return (formula.names | level.duration.names) - {formula.variable}


def _formulas(level: Level) -> Iterator[tuple[Path, Formula]]:
    for part in ("effects", "joints"):
        for path, formula in expressions(getattr(level, part), (part,)):
            if isinstance(formula, Formula) and formula.variable == "t":
                yield path, formula
    yield from _motions(level)


def _motions(level: Level) -> Iterator[tuple[Path, Formula]]:
    """Yield the formulas of kinematic bodies' motions, with their paths."""
    for name, body in level.bodies.items():
        if body.motion:
            path = ("bodies", name, "motion")
            for axis, along in enumerate(body.motion.displacement):
                yield (*path, "displacement", axis), along
            yield (*path, "turn"), body.motion.turn


def _times(level: Level, most: int, values: Values) -> Array:
    duration, stepping = level.duration(values), level.stepping
    steps = stepping.steps(min(duration, most / stepping.rate))
    return np.linspace(0.0, duration, steps + 1)


def _lost(at: Times, formula: Formula, values: Values) -> Message | None:
    """Say when a formula first has no value, or too large a value."""
    times = at(values)
    try:
        found = formula.over(values, times)
    except ExpressionError as error:
        return error.message
    shown = brief(str(formula.source))
    if (lost := ~np.isfinite(found)).any():
        return Message(
            "'{shown}' has no finite value at t = {t:.3g} s", shown=shown, t=times[lost.argmax()]
        )
    first = (np.abs(found) > formula.most).argmax()
    if beyond := formula.range_fault(float(found[first])):
        return Message(
            "'{shown}' is {found:g} {unit} at t = {t:.3g} s, {beyond}",
            shown=shown,
            found=found[first],
            unit=formula.unit,
            t=times[first],
            beyond=beyond,
        )
    return None


def _gone(length: Formula, at: Times, values: Values) -> Message | None:
    """Say when the length of a rod is no longer positive."""
    times = at(values)
    long = length.over(values, times)
    if not np.isfinite(long).all() or not (gone := long <= 0).any():
        return None  # values that are not finite have a condition of their own
    first = gone.argmax()
    return Message(
        "the rod is {long:.3g} m long at t = {t:.3g} s", long=long[first], t=times[first]
    )


def _displaced(formula: Formula, values: Values) -> Message | None:
    """Say that a motion does not begin at its body's position, or not at a finite velocity."""
    at_start = np.zeros(())
    start, speed = (f.at(values, {"t": at_start}) for f in (formula, formula.slope("t")))
    if abs(start) > STARTS * (1 + np.abs(formula.over(values, at_start + 1))):
        return Message(
            "is {start:.3g} {unit} at the start, but must be 0, since it is relative to the start",
            start=start,
            unit=formula.unit,
        )
    if not np.isfinite(speed):
        return Message("has no finite velocity at the start")
    return None


def _jumps(at: Times, what: Message, formula: Formula, values: Values) -> Message | None:
    """Say when a length or a motion jumps."""
    times = at(values)
    over = formula.over(values, times)
    if not np.isfinite(over).all() or "t" not in formula.names:
        return None
    start, end, at_start, at_end = times[:-1], times[1:], over[:-1], over[1:]
    least = JUMP * np.abs(over).max()
    for halving in range(HALVINGS):
        middle = (start + end) / 2
        half = formula.over(values, middle)
        later = np.abs(at_end - half) > np.abs(half - at_start)
        start, end = np.where(later, middle, start), np.where(later, end, middle)
        at_start, at_end = np.where(later, half, at_start), np.where(later, at_end, half)
        if halving >= SMOOTH:
            left = np.abs(at_end - at_start) > least
            start, end, at_start, at_end = start[left], end[left], at_start[left], at_end[left]
            if not len(start):
                return None
    jump = np.abs(at_end - at_start)
    far, t = jump.max(), end[jump.argmax()]
    return Message(
        "{what} jumps by {far:.3g} {unit} at t = {t:.3g} s; it must change gradually",
        what=what,
        far=far,
        unit=formula.unit,
        t=t,
    )
