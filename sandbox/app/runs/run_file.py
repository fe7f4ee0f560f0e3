"""Run files: a level, its parameters and the actions, which repeat the run."""

import json
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationError
from pydantic_core import ErrorDetails

from sandbox.app.runs.session import Session
from sandbox.app.runs.user_interventions import Action
from sandbox.model import parser_error_messages
from sandbox.model.atomic_file_writing import write_atomically
from sandbox.model.base import Model
from sandbox.model.errors import SandboxError, brief
from sandbox.model.file_reading import UnreadableError, read_named
from sandbox.model.level import Level
from sandbox.model.level_parts import names_in
from sandbox.model.loading import choose, parse
from sandbox.model.rules.conditions.numbers_and_shapes import MAX_STEPS
from sandbox.model.translatable_message import Message
from sandbox.physics.state.snapshot import Snapshot

SUFFIX = ".run.json"
"""The suffix of run files."""

LARGEST = 100_000_000
"""The largest run file that is read [bytes]."""


class Run(Model):
    """A run that can be repeated."""

    format: Literal[1]
    """the version of the format"""
    level: Mapping[str, Any]
    """the complete level, with the stepping of the run"""
    parameters: Mapping[str, Annotated[float, Field(strict=False, allow_inf_nan=False)]]
    """the values of the parameters at the start"""
    steps: Annotated[int, Field(ge=0, le=MAX_STEPS)]
    """the number of steps of the run"""
    actions: Annotated[tuple[Action, ...], Field(strict=False)] = ()
    """the user's actions in order, also those at later steps"""
    repeats: bool = False
    """whether it began as the run of another file"""
    state: str
    """a hash of the state after these steps"""


def run_of(session: Session) -> Run:
    """Return the run of a session so far."""
    level = session.begun_as.model_copy(update={"stepping": session.world.stepping})
    if session.changes or level.effects != session.original.effects:
        level = _scene(level)
    return Run(
        format=1,
        level=level.model_dump(mode="json", by_alias=True, exclude_defaults=True),
        parameters={name: session.begun_with[name] for name in level.parameters},
        steps=session.world.steps,
        actions=tuple(session.all_actions),
        repeats=session.repeats,
        state=fingerprint(session.world.snapshot),
    )


def _scene(level: Level) -> Level:
    """Return a level without its formulas, which do not hold with other effects."""
    view = level.view.model_copy(update={"landscape": None})
    without: dict[str, object] = {"checks": (), "ghosts": {}, "challenge": None, "view": view}
    scene = level.model_copy(update=without)
    used = names_in(scene)
    parameters = {name: p for name, p in level.parameters.items() if name in used}
    return scene.model_copy(update={"parameters": parameters})


def replay(run: Run) -> Session:
    """Repeat a run without a window, and return its session at the end.

    Raises `SandboxError` if the level is not well formed, or cannot be run.
    """
    session = session_of(run)
    session.do_again(run.actions, run.steps)
    if session.failure is not None:
        raise session.failure
    return session


def session_of(run: Run, *, patient: bool = True) -> Session:
    """Return a session at the start of a run, which repeats the user's actions at their steps.

    For `patient` see `Session`. Raises `SandboxError` if the level is not well formed, or cannot be
    built.
    """
    level = parse(json.dumps(run.level), "the level of the run")
    session = Session(level, choose(level, run.parameters), patient=patient)
    session.repeats = True
    session.do_again(run.actions, 0)
    return session


def open_run(path: Path) -> Session:
    """Return a session of a run's file that plays and does not block the window.

    Raises `SandboxError` as `read` and `session_of` do.
    """
    session = session_of(read(path), patient=False)
    session.playing = True
    return session


def is_same(run: Run, session: Session) -> bool:
    """Whether a repeated run has the recorded state, to the last bit."""
    return fingerprint(session.world.snapshot) == run.state


def save(run: Run, path: Path) -> None:
    """Write a run to a file, completely or not at all.

    Raises `SandboxError` if the file cannot be written.
    """
    write_atomically(path, file_content(run) + "\n")


def file_content(run: Run) -> str:
    """Return the content of a run's file."""
    return run.model_dump_json(indent=1, exclude_defaults=True)


def read(path: Path) -> Run:
    """Read a run from a file.

    Raises `SandboxError` if the file cannot be read, or is not a run file.
    """
    try:
        return Run.model_validate_json(read_named(path, LARGEST))
    except UnreadableError as error:
        raise SandboxError("{path}: {reason}", path=path, reason=error.message) from error
    except ValidationError as error:
        place, reason = _mistake(error.errors(include_url=False)[0])
        raise SandboxError(
            "{path} is not the file of a run: {place}: {reason}",
            path=path,
            place=place,
            reason=reason,
        ) from error


def _mistake(first: ErrorDetails) -> tuple[str, Message]:
    """Return the position and the description of a file's mistake."""
    if first["type"] == "json_invalid":
        rule, place = parser_error_messages.refused(first["ctx"]["error"])
        return ":".join(map(str, place or ())) or Message("the file"), rule
    inside = brief(".".join(str(step) for step in first["loc"]))
    return inside or Message("the file"), parser_error_messages.rule(first, Run)


def fingerprint(snapshot: Snapshot) -> str:
    """Return a hash of all positions, angles and velocities."""
    parts = (snapshot.position, snapshot.angle, snapshot.velocity, snapshot.angular_velocity)
    return sha256(b"".join(part.tobytes() for part in parts)).hexdigest()
