"""The race: several schemes step the same scene, each in its own world."""

from collections.abc import Iterator
from contextlib import suppress
from itertools import islice
from typing import NamedTuple

from sandbox.app.drawing import theme
from sandbox.app.drawing.theme import Color
from sandbox.app.pages.effects import switching_effects
from sandbox.app.runs.companion_runs import Variant, worst
from sandbox.app.runs.session import Session
from sandbox.app.runs.step_timer import StepTimer
from sandbox.app.words import formatting
from sandbox.app.words.language import say
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level, Scheme
from sandbox.model.translatable_message import NOTHING, Message
from sandbox.physics.run import build
from sandbox.physics.scene.usable_schemes import usable

MOST = 4
"""The largest number of schemes in a race."""


class Lane(NamedTuple):
    """The standing of one scheme."""

    scheme: Scheme
    color: Color | None
    """the colour of its outlines; None for the run that is played"""
    error: float | None
    """the largest error of its checks so far"""
    cost: float | None
    """s, the computing time for a second of simulated time"""
    failure: Message
    """the reason why it had to stop; empty if it did not"""


def racing(session: Session) -> bool:
    """Return whether there is a race."""
    return bool(session.companions) and not session.changes


def toggle(session: Session) -> None:
    """Start a race of the schemes that the level can use, or end it.

    A race that starts plays at once. Raises `SandboxError` if one of the schemes cannot run;
    nothing is changed then.
    """
    original = switching_effects.declared_with_present_stepping(session)
    ends = racing(session)
    session.play_as(original, [] if ends else rivals(original, session.chosen))
    session.playing = session.playing or not ends


def rivals(level: Level, values: Values) -> list[Variant]:
    """Return the other schemes that a level can use."""
    forms = islice(_forms(level, values), MOST - 1)
    return [
        Variant(formatting.scheme(form.stepping.scheme), form, lane)
        for form, lane in zip(forms, range(len(theme.LANES)), strict=False)
    ]


def _forms(level: Level, values: Values) -> Iterator[Level]:
    for scheme in usable(level):
        if scheme == level.stepping.scheme:
            continue
        form = switching_effects.with_scheme(level, scheme)
        with suppress(SandboxError):  # its steps may be too large
            build(form, values)
            yield form


def lanes(session: Session) -> list[Lane]:
    """Return the standings of all schemes, that of the played run first."""
    rate, scheme = session.world.stepping.rate, session.world.stepping.scheme
    own = worst(session.readings())
    failure = session.failure.message if session.failure else NOTHING
    first = Lane(scheme, None, own, _cost(session.clock, rate), failure)
    return [first, *(
        Lane(
            other.world.stepping.scheme, other.variant.color, other.worst,
            _cost(other.clock, rate), other.failure.message if other.failure else NOTHING,
        )
        for other in session.companions
    )]  # fmt: skip


def _cost(clock: StepTimer, rate: float) -> float | None:
    return None if clock.step_time is None else clock.step_time * rate


def start_or_end(session: Session) -> str:
    """Start or end the race, and return the message."""
    toggle(session)
    return "" if racing(session) else say("the race has ended")


def rows(session: Session) -> list[tuple[Color | None, str]]:
    """Return the colours of the schemes, and their names with errors; none without a race."""
    return [(lane.color, _legend(lane)) for lane in lanes(session)] if racing(session) else []


def _legend(lane: Lane) -> str:
    name = formatting.scheme(lane.scheme)
    if lane.error is None:
        return name
    return say("{scheme}: error {error}", scheme=name, error=formatting.error(lane.error))
