"""A saved run is repeated, and reaches the same state to the last bit."""

from pathlib import Path

import pytest

from sandbox.app.runs import run_file
from sandbox.app.runs.session import Session
from sandbox.app.runs.user_interventions import Action
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.level import Stepping
from sandbox.model.levels_with_changed_effects import without
from sandbox.model.loading import load
from tests.app.scenes import opened

LEVELS = level_catalog.names()[::15]


def pulled(session: Session) -> None:
    """Pull a body for some steps, as while time runs, and release it."""
    body = next(n for n, b in session.level.bodies.items() if b.type == "dynamic")
    row = list(session.level.bodies).index(body)
    x, y = session.world.snapshot.position[row].tolist()
    session.playing = True
    session.grab(body, (x, y))
    for i in range(10):
        session.drag((x + 0.01 * i, y + 0.02 * i))
        session._advance()
    session.release()
    session.playing = False


@pytest.mark.parametrize("name", LEVELS)
def test_a_run_from_a_file_is_the_same_to_the_last_bit(name: str, tmp_path: Path) -> None:
    session = opened(name, 40)
    run_file.save(run_file.run_of(session), tmp_path / "run.json")

    run = run_file.read(tmp_path / "run.json")

    assert run == run_file.run_of(session)
    assert run_file.is_same(run, run_file.replay(run))


def test_what_a_hand_did_is_done_again(tmp_path: Path) -> None:
    session = opened("newton/atwood", 40)
    pulled(session)
    for _ in range(20):
        session.step()
    run = run_file.run_of(session)
    run_file.save(run, tmp_path / "run.json")

    again = run_file.replay(run_file.read(tmp_path / "run.json"))

    assert run_file.is_same(run, again)
    assert again.world.disturbed
    untouched = run.model_copy(update={"actions": ()})
    assert not run_file.is_same(run, run_file.replay(untouched))


def test_parameters_and_changed_effects_belong_to_the_run() -> None:
    level = load(level_catalog.find("newton/projectile-with-drag"))
    session = Session(level)
    session.restart({"speed": 17})
    session.play_as(without(level, "drag")[0])
    for _ in range(20):
        session.step()
    run = run_file.run_of(session)

    assert "drag" not in run.level["effects"]
    assert run_file.is_same(run, run_file.replay(run))


RUN = b'{"format": 1, "level": {}, "parameters": {}, "state": "", %s}'


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"", "is not the file of a run"),
        (
            b'{"format": 1, "level": {}, "parameters": {"\\u0000": ""}, "state": "", "steps": 0}',
            r"parameters.\x00: ",
        ),
        (b"{}", "format: 'format' is missing"),
        (b"[]", "the file: must be an object, {"),
        (b'{"format": 2}', "format: must be 1"),
        (b'{"format": 1,\n "level": }', "2:11: is not JSON: "),
        (RUN % b'"steps": 1000000000000', "steps: must be at most 1e+07"),
        (RUN % b'"steps": 1, "actions": [{"kind": "drag"}]', "actions.0.step: 'step' is missing"),
        (
            RUN % b'"steps": 1, "actions": [{"step": 100000000, "kind": "release"}]',
            "actions.0.step: must be at most 1e+07",
        ),
        (RUN % b'"steps": 1, "acts": []', "unknown key 'acts'; did you mean 'actions'?"),
        (b"\xff", "is not the file of a run"),
    ],
)
def test_another_file_is_refused_with_what_is_wrong(
    content: bytes, told: str, tmp_path: Path
) -> None:
    path = tmp_path / "run.json"
    path.write_bytes(content)

    with pytest.raises(SandboxError) as refused:
        run_file.read(path)
    assert told in str(refused.value)
    assert str(path) in str(refused.value)


@pytest.mark.parametrize("kind", ["grab", "place"])
def test_a_body_that_is_not_there_cannot_be_moved(kind: str) -> None:
    run = run_file.run_of(Session(load(level_catalog.find("newton/atwood"))))
    moved = Action.model_validate({"step": 0, "kind": kind, "body": "nobody"})

    with pytest.raises(SandboxError, match="there is no body 'nobody' to move"):
        run_file.replay(run.model_copy(update={"actions": (moved,), "steps": 1}))


def test_a_level_that_asks_for_an_accuracy_is_saved_with_the_rate_it_was_played_at() -> None:
    asked = load(level_catalog.find("kinematics/projectile"))
    asked = asked.model_copy(update={"stepping": Stepping(accuracy=1e-6)})
    session = Session(asked)
    for _ in range(10):
        session.step()
    run = run_file.run_of(session)

    assert "accuracy" not in run.level.get("stepping", {})
    assert run_file.is_same(run, run_file.replay(run))


def test_a_level_that_is_not_well_formed_is_refused() -> None:
    run = run_file.run_of(opened("newton/atwood", 1))
    wrong = run.model_copy(update={"level": {**run.level, "gravity": 1}})

    with pytest.raises(SandboxError, match="gravity"):
        run_file.replay(wrong)
