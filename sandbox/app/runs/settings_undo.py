"""Undo for changes of a run: parameters, effects, scheme, rate, and speed."""

from collections.abc import Mapping, Sequence
from itertools import takewhile
from math import inf
from typing import NamedTuple

from sandbox.app.runs.companion_runs import Changes, Variant
from sandbox.app.runs.session import Session
from sandbox.app.words import formatting
from sandbox.app.words.language import later, say
from sandbox.model.errors import SandboxError
from sandbox.model.level import Level

TOGETHER = 0.7  # s, within which changes of the same thing count as one, as by dragging a slider
MOST = 200
"""The largest number of changes that are kept."""
FORM, SPEED = later("effects and stepping"), "speed"


class Branch(NamedTuple):
    """A step at which a run continued with other parameters."""

    step: int
    parameters: Mapping[str, float]


class Setup(NamedTuple):
    """Everything that the user chooses in a session, without its results."""

    level: Level
    changes: Changes
    companions: Sequence[Variant]
    start_values: Mapping[str, float]
    """the parameters at the start of the run"""
    branches: Sequence[Branch]
    values: Mapping[str, float]
    """the parameters after all branches"""
    speed: float


class UndoHistory:
    """The changes that can be undone and redone.

    `follow` is called in every frame, and detects changes.
    """

    def __init__(self) -> None:
        self._of: tuple[Session, Level] | None = None
        self._now: Setup | None = None
        self._kind: frozenset[str] = frozenset()
        self._since = inf  # s since the last change
        self._past: list[Setup] = []
        self._future: list[Setup] = []

    def follow(self, session: Session, seconds: float) -> None:
        """Detect changes after some time [s]; another level starts without any."""
        before, level = self._now, session.original
        if before is None or self._of is None or not all(map(_is, self._of, (session, level))):
            self._of = session, level
            self._past, self._future = [], []
            self._set_reference(setup(session))
            return
        self._since += seconds
        if session.sought is not None:
            return  # the run is still going back
        now = setup(session)
        kind = differences(before, now)
        if kind:
            if kind != self._kind or self._since > TOGETHER:
                self._past = [*self._past, before][-MOST:]
            self._future, self._kind, self._since = [], kind, 0.0
        self._now = now

    def undo(self, session: Session) -> str:
        """Undo the last change, and return the message for it; see `redo`."""
        return self._go(
            session, self._past, self._future, later("undone: {what}"), later("nothing to undo")
        )

    def redo(self, session: Session) -> str:
        """Redo a change that was undone, and return the message for it.

        Raises `SandboxError` if that is not possible; then nothing is changed.
        """
        return self._go(
            session, self._future, self._past, later("done again: {what}"),
            later("nothing to redo"),
        )  # fmt: skip

    def _go(
        self,
        session: Session,
        come_from: list[Setup],
        go_to: list[Setup],
        message: str,
        nothing: str,
    ) -> str:
        self.follow(session, 0.0)
        if not come_from:
            return say(nothing)
        wanted, before = come_from[-1], setup(session)
        apply(session, wanted)
        come_from.pop()
        go_to.append(before)
        self._set_reference(setup(session) if session.sought is None else wanted)
        return say(message, what=_words(before, wanted))

    def _set_reference(self, now: Setup) -> None:
        """Set the reference for the next change."""
        self._now, self._kind, self._since = now, frozenset(), inf


def setup(session: Session) -> Setup:
    """Return the current choices of a session."""
    branches = [Branch(a.step, a.parameters) for a in session.all_actions if a.kind == "branch"]
    beside = [companion.variant for companion in session.companions]
    values = dict(session.values_for(session.begun_as))
    for to_come in branches:
        if to_come.step > session.world.steps:
            values |= to_come.parameters
    return Setup(
        session.begun_as, session.changes, beside, session.begun_with, branches, values,
        session.speed,
    )  # fmt: skip


def differences(before: Setup, after: Setup) -> frozenset[str]:
    """Return what the user has changed between two setups; going back in time is no change."""
    found = {SPEED} if before.speed != after.speed else set()
    if not _same_form(before, after):
        found.add(FORM)
    back = before.start_values == after.start_values and len(after.branches) < len(before.branches)
    if not back:
        names = after.values.keys() & before.values.keys()
        found |= {name for name in names if before.values[name] != after.values[name]}
    return frozenset(found)


def apply(session: Session, wanted: Setup) -> None:
    """Restore the choices of a session.

    Raises `SandboxError` if that is not possible; then nothing is changed.
    """
    now = setup(session)
    both = zip(now.branches, wanted.branches, strict=False)
    common = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], both))
    lost, gained = now.branches[common:], wanted.branches[common:]
    if not _same_form(now, wanted):
        session.play_as(wanted.level, wanted.companions, wanted.changes, wanted.values)
    elif now.start_values == wanted.start_values and (lost or gained) and len(gained) <= 1:
        if lost:
            session.go_to(lost[0].step, undone=True)
        if gained:
            _branch(session, gained[0])
    elif now.values != wanted.values:
        session.restart(wanted.values)
    session.speed = wanted.speed


def _branch(session: Session, branch: Branch) -> None:
    """Repeat a branch of the run at its step."""
    if session.sought is None:
        session.go_to(branch.step)
    if session.sought is not None:
        raise SandboxError("the run is still returning to where it branched; try again then")
    session.branch(branch.parameters)


def _same_form(a: Setup, b: Setup) -> bool:
    """Whether the same variants of the level are played, compared by identity."""
    beside = len(a.companions) == len(b.companions) and all(map(_is, a.companions, b.companions))
    return a.level is b.level and a.changes == b.changes and beside


def _is(a: object, b: object) -> bool:
    return a is b


def _words(before: Setup, after: Setup) -> str:
    """Return a description of what was undone or redone."""
    names = [name for name in after.values if after.values[name] != before.values.get(name)]
    parts = [
        say("{name} is {value}", name=name, value=formatting.setting(after.values[name]))
        for name in names
    ]
    if not _same_form(before, after):
        parts.append(say("{what} as before", what=say(FORM)))
    if after.speed != before.speed:
        parts.append(say("speed is {speed:g}×", speed=after.speed))
    return ", ".join(parts) or say("as before")
