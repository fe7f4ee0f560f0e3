"""Measures of a run: each gives one number, or none if its instant does not occur.

    ball.position.x@end           at the end of the run, or where `until` has ended it
    ball.position.x@1.5           at a time [s], which may be a formula of the parameters
    t@landing, t@apex(ball)       at an event: landing(BODY, HEIGHT), apex(BODY),
                                  contact(A, B, NTH), separation(A, B, NTH),
                                  crossing(QUANTITY, VALUE, up|down|either)
    t@until                       at the first step where `until` holds; no number if it never does
    max(ball.speed)               an extreme, mean or integral over the run
    error(range)                  the error of one of the level's checks, by its label or number

A quantity may be replaced by arithmetic over several.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from sandbox.experiments.observables import Observable
from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import SandboxError, brief
from sandbox.model.expressions import Expression
from sandbox.model.level import (
    ApexEvent,
    Check,
    ContactEvent,
    CrossingEvent,
    Instant,
    LandingEvent,
    Level,
    SeparationEvent,
)
from sandbox.model.measuring_instants import MOST_MEETINGS
from sandbox.model.named_constants import let_use
from sandbox.model.quantities import OVER_TIME, quantity
from sandbox.model.translatable_message import Message
from sandbox.physics.measuring.grading import (
    applies,
    grade_check,
    least_scale,
    relative_error,
    samples,
)
from sandbox.physics.measuring.interpolation_between_steps import value_at
from sandbox.physics.measuring.recording import Trace, needed_at
from sandbox.physics.measuring.running_aggregates import over_time

Place = Literal["end", "until"]

_CALL = re.compile(r"([a-z]+)\((.*)\)", re.DOTALL)
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
_EVENTS = ("end", "until", "landing", "apex", "contact", "separation", "crossing")


class MeasureError(SandboxError):
    """A text that is no measure; the message is fit to be shown."""


@dataclass(frozen=True, slots=True)
class Measure:
    """A number that is measured of each run."""

    text: str
    """The text of the measure, which is also the name of its column."""
    of: Observable | None
    """The measured quantity; None for the error of a check."""
    at: Instant | Place | None
    """The instant, an event or a time; None with a reduction."""
    reduction: str
    """The reduction over the whole run; empty at an instant, `error` for a check."""
    check: Check | None
    """The check whose closed form predicts the number; None if there is none."""

    @property
    def unit(self) -> str:
        """Its SI unit; empty if it has none, or none is known."""
        unit = self.of.unit if self.of else ""
        return "·".join(part for part in (unit, OVER_TIME.get(self.reduction, "")) if part)

    @property
    def quantities(self) -> list[str]:
        """The quantities that must be recorded for it."""
        if self.of is None:
            assert self.check
            return needed_at(self.check.quantity, self.check.at)
        events = [] if isinstance(self.at, str | None) else needed_at("t", self.at)
        return list(dict.fromkeys(["t", *self.of.quantities, *events]))

    def measured(self, trace: Trace, until: float | None) -> tuple[float, float | None] | None:
        """Return the number and the time of its instant [s], if any; None if that never occurs.

        `until` is the time at which the condition ended the run [s]; None if it did not.
        """
        if self.reduction == "error":
            assert self.check
            found_error = grade_check(self.check, trace).error
            return None if found_error is None else (found_error, None)
        assert self.of
        column = self.of.over(trace.columns, trace.t, trace.values)
        if self.reduction:
            return float(over_time(self.reduction, trace.t, column)[-1]), None
        if self.at == "end":
            return float(column[-1]), float(trace.t[-1])
        if self.at == "until":
            if until is None:
                return None
            return value_at(trace.t, column, until, smooth=trace.smooth), until
        whole = replace(trace, columns={**trace.columns, self.text: column})
        found = samples(whole, self.text, self.at)
        return None if found is None else (float(found[1][0]), float(found[0][0]))

    def expected(self, trace: Trace, t: float | None) -> float | None:
        """Return the value of the closed form at a time [s]; None where it does not apply."""
        if self.check is None or self.of is None or t is None:
            return None
        if not applies(self.check, trace.values):
            return None
        value = float(self.check.formula.over(trace.values, np.array([t]))[0])
        return value if np.isfinite(value) else None

    def error(self, measured: float, expected: float, trace: Trace) -> float:
        """Return the error of a measured number, as the check defines it."""
        assert self.check
        least = least_scale(self.check, trace.values)
        return relative_error(np.array([measured]), np.array([expected]), least)[0]


def parse(text: str, level: Level, *, until: bool) -> Measure:
    """Return the measure that a text describes; with `until`, a condition that ends the runs.

    Raises `MeasureError` if the level has no such quantity, event or check.
    """
    text = text.strip()
    try:
        call = _CALL.fullmatch(text)
        if call and call[1] == "error":
            return Measure(text, None, None, "error", _check(call[2], level))
        if call and call[1] in OVER_TIME and _closes_last(text):
            return Measure(text, Observable.of(call[2], level), None, call[1], None)
        name, at, where = text.rpartition("@")
        if not at:
            raise MeasureError(
                "'{text}' does not say when: QUANTITY@end, QUANTITY@TIME, QUANTITY@landing and"
                " so on, or one of {over_time} of (QUANTITY), or error(CHECK)",
                text=brief(text),
                over_time=", ".join(OVER_TIME),
            )
        of, instant = Observable.of(name, level), _instant(where.strip(), level)
    except SandboxError as error:
        raise MeasureError(error.message) from error
    if instant == "until" and not until:
        raise MeasureError("'until' is measured, but no condition 'until' is given")
    return Measure(text, of, instant, "", _closed_form(of, instant, level))


def _closes_last(text: str) -> bool:
    """Whether the bracket that opens first closes last."""
    depth = 0
    for i, character in enumerate(text):
        depth += {"(": 1, ")": -1}.get(character, 0)
        if character == ")" and not depth:
            return i == len(text) - 1
    return False


def _closed_form(of: Observable, at: Instant | Place, level: Level) -> Check | None:
    """Return the check that predicts a quantity at an instant, or at every step."""
    same = [check for check in level.checks if check.quantity == of.text]
    exact = next((check for check in same if check.at is not None and check.at == at), None)
    return exact or next((check for check in same if check.at is None), None)


def _check(text: str, level: Level) -> Check:
    """Return the check with a number, from 1, or a label."""
    text = text.strip()
    if text.isdecimal() and 1 <= int(text) <= len(level.checks):
        return level.checks[int(text) - 1]
    for check in level.checks:
        if check.label == text:
            return check
    if not level.checks:
        raise MeasureError("the level states no checks, so there is no error")
    hint = suggestion(text, [check.label or check.quantity for check in level.checks])
    raise MeasureError(
        "'{text}' is none of the level's checks, 1 to {count}{hint}",
        text=brief(text),
        count=len(level.checks),
        hint=hint,
    )


def _instant(text: str, level: Level) -> Instant | Place:
    if text == "end":
        return "end"
    if text == "until":
        return "until"
    call = _CALL.fullmatch(text)
    name, inside = (call[1], call[2]) if call else (text, "")
    arguments = [part.strip() for part in inside.split(",")] if inside.strip() else []
    match name, arguments:
        case "landing", [*body] if len(body) < 3:
            height = body[1] if len(body) > 1 else 0
            return LandingEvent.model_validate(
                {"event": "landing", "body": _body(body[:1], level, text), "height": height}
            )
        case "apex", [*body] if len(body) < 2:
            return ApexEvent(event="apex", body=_body(body, level, text))
        case "contact" | "separation", [a, b, *nth] if len(nth) < 2:
            pair = (_body([a], level, text), _body([b], level, text))
            return _meeting(name, pair, nth, text)
        case "crossing", [of, *rest] if len(rest) < 3:
            return _crossing(of, rest, level)
    if name in _EVENTS:
        raise MeasureError("'{text}' cannot be read: {how}", text=brief(text), how=_HOW[name])
    return _time(text, level)


_HOW: Mapping[str, str] = {
    "end": "end",
    "until": "until",
    "landing": Message("landing, landing(BODY) or landing(BODY, HEIGHT)"),
    "apex": Message("apex or apex(BODY)"),
    "contact": Message("contact(BODY, BODY) or contact(BODY, BODY, 2) for the second"),
    "separation": Message("separation(BODY, BODY) or separation(BODY, BODY, 2) for the second"),
    "crossing": Message(
        "crossing(QUANTITY), crossing(QUANTITY, VALUE) or crossing(QUANTITY, VALUE, up)"
    ),
}


def _meeting(
    name: str, pair: tuple[str, str], nth: list[str], text: str
) -> ContactEvent | SeparationEvent:
    count = nth[0] if nth else "1"
    if not (count.isdecimal() and 1 <= int(count) <= MOST_MEETINGS):
        raise MeasureError("'{text}' counts from 1 to {most}", text=brief(text), most=MOST_MEETINGS)
    if name == "contact":
        return ContactEvent(event="contact", bodies=pair, nth=int(count))
    return SeparationEvent(event="separation", bodies=pair, nth=int(count))


def _crossing(of: str, rest: list[str], level: Level) -> CrossingEvent:
    name = quantity(of, level).name
    direction = rest[1] if len(rest) > 1 else "either"
    if direction not in ("up", "down", "either"):
        hint = suggestion(direction, ("up", "down", "either"))
        raise MeasureError(
            "'{direction}' is not a direction{hint}", direction=brief(direction), hint=hint
        )
    value = _over_parameters(rest[0], level).source if rest else 0
    return CrossingEvent.model_validate(
        {"event": "crossing", "quantity": name, "value": value, "direction": direction}
    )


def _time(text: str, level: Level) -> Expression:
    if re.fullmatch(r"[a-z]+", text) and text not in {*level.parameters, *level.constants}:
        hint = suggestion(text, {*_EVENTS, *level.parameters})
        raise MeasureError(
            "'{text}' is neither a time nor an event{hint}", text=brief(text), hint=hint
        )
    return _over_parameters(text, level)


def _over_parameters(text: str, level: Level) -> Expression:
    found = Expression(float(text) if _NUMBER.fullmatch(text) else text)
    let_use([found], level.constants)
    if unknown := next(iter(sorted(found.names - set(level.parameters))), None):
        hint = suggestion(unknown, level.parameters)
        raise MeasureError(
            "'{unknown}' is not a parameter of the level{hint}", unknown=brief(unknown), hint=hint
        )
    return found


def _body(arguments: list[str], level: Level, text: str) -> str:
    """Return the body of an event: the only one that moves, if none is named."""
    if arguments:
        if arguments[0] not in level.bodies:
            hint = suggestion(arguments[0], level.bodies)
            raise MeasureError(
                "the level has no body '{given}'{hint}", given=brief(arguments[0]), hint=hint
            )
        return arguments[0]
    moving = [name for name, body in level.bodies.items() if body.type == "dynamic"]
    if len(moving) != 1:
        raise MeasureError(
            "'{text}' must say which body: {text}({body})",
            text=text,
            body=moving[0] if moving else "...",
        )
    return moving[0]
