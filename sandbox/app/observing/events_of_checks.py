"""The events of a run so far at which its checks measure, with the measured values."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from sandbox.app.words import formatting
from sandbox.app.words.level_translation import Say, title
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
from sandbox.model.shapes import XY
from sandbox.physics.measuring.grading import Result
from sandbox.physics.measuring.interpolation_between_steps import value_at
from sandbox.physics.measuring.recording import Trace

MOST = 3
"""The largest number of quantities that are written beside an event."""


@dataclass(slots=True)
class Milestone:
    """An event that has happened to a body."""

    body: str
    """The body."""
    place: XY
    """The position of its centre [m]."""
    measured: list[tuple[Check, str]]
    """The checks at the event, each with its measured value as text."""
    passed: bool
    """Whether all checks at the event passed."""

    def texts(self, words: Say) -> list[str]:
        """Return a line for each measured value; `words` translates the level's texts."""
        return [f"{title(check, words)} {value}" for check, value in self.measured]


def needed(level: Level) -> Iterator[str]:
    """Yield the quantities that give the positions of a level's events."""
    for check in level.checks:
        if body := _body(level, check.at):
            yield from _position(body)


def milestones(results: Iterable[Result], trace: Trace) -> tuple[Milestone, ...]:
    """Return the events so far in chronological order, from the results of a run's checks."""
    found: dict[tuple[str, float], Milestone] = {}
    for result in results:
        body = _body(trace.level, result.check.at)
        if body is None or result.t is None or result.measured is None:
            continue
        key = body, result.t
        if key not in found:
            x, y = (value_at(trace.t, trace.columns[name], result.t) for name in _position(body))
            found[key] = Milestone(body, (x, y), [], passed=True)
        event = found[key]
        event.passed = event.passed and result.verdict == "passed"
        if len(event.measured) < MOST:
            value = formatting.quantity(result.measured, result.unit, 3)
            event.measured.append((result.check, value))
    return tuple(found[key] for key in sorted(found, key=lambda key: key[1]))


def _body(level: Level, at: Instant | None) -> str | None:
    """Return the body that an event happens to; of two, the first dynamic one; None if none."""
    match at:
        case ApexEvent(body=body) | LandingEvent(body=body):
            return body
        case ContactEvent(bodies=bodies) | SeparationEvent(bodies=bodies):
            return next((body for body in bodies if level.bodies[body].type == "dynamic"), None)
        case CrossingEvent(quantity=quantity):
            subject = quantity.partition(".")[0]
            return subject if subject in level.bodies else None
        case _:
            return None


def _position(body: str) -> tuple[str, str]:
    return f"{body}.position.x", f"{body}.position.y"
