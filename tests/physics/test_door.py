"""Whatever happens inside, whoever asks for a level, a world or a run gets one kind of answer."""

import warnings
from collections.abc import Callable

import numpy as np
import pytest

from sandbox.model.errors import LevelError, SandboxError
from sandbox.model.loading import parse
from sandbox.model.rules import level_validation
from sandbox.physics.advising import preflight_faults as refusing
from sandbox.physics.measuring import recording
from sandbox.physics.run import build, simulate
from sandbox.physics.state.simulation_errors import BreakdownError, SimulationError
from sandbox.physics.stepping import world
from sandbox.physics.stepping.applied_forces import Forces
from sandbox.physics.stepping.step_observer import Observer
from tests.model.levels import bare, changed
from tests.physics.scenes import GRAVITY, box, disc, level

UNFORESEEN = [
    AssertionError(),
    ZeroDivisionError("complex division by zero"),
    OverflowError("int too large"),
    np.linalg.LinAlgError("Singular matrix"),
    ValueError("cannot convert float NaN to integer"),
    IndexError("list index out of range"),
    KeyError("nobody"),
    MemoryError(),
]
Fail = Callable[..., None]


@pytest.fixture(params=UNFORESEEN, ids=lambda error: type(error).__name__)
def fail(request: pytest.FixtureRequest) -> Fail:
    def failing(*_: object, **__: object) -> None:
        raise request.param

    return failing


def falling() -> world.World:
    return build(level({"ball": disc()}, GRAVITY))


def test_what_breaks_down_while_a_level_is_read_is_told(
    fail: Fail, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(level_validation, "faults", fail)

    with pytest.raises(LevelError, match="nothing can be computed with") as caught:
        parse(changed(bare()), "ball.json")

    assert str(caught.value).startswith("ball.json: ")


def test_what_breaks_down_while_a_world_is_built_is_told(
    fail: Fail, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(world, "make_scene", fail)

    with pytest.raises(BreakdownError, match="nothing can be computed with"):
        falling()


def test_what_breaks_down_while_a_rate_is_judged_is_told(
    fail: Fail, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(refusing, "make_scene", fail)

    assert isinstance(refusing.refusal(level({"ball": disc()}, GRAVITY)), BreakdownError)


@pytest.mark.parametrize(("owner", "name"), [(Forces, "_read"), (Observer, "snapshot")])
def test_what_breaks_down_in_a_step_is_told_and_ends_the_run(
    fail: Fail, monkeypatch: pytest.MonkeyPatch, owner: type, name: str
) -> None:
    made = build(level({"ball": disc()}, {"drag": {"linear": 1}}))
    monkeypatch.setattr(owner, name, fail)

    with pytest.raises(BreakdownError) as caught:
        made.advance()
    with pytest.raises(SimulationError) as again:
        made.advance()

    assert isinstance(caught.value, SandboxError)
    assert again.value is caught.value


def test_what_breaks_down_while_a_run_is_measured_is_told(
    fail: Fail, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(recording.Recorder, "_measure", fail)

    with pytest.raises(BreakdownError):
        simulate(level({"ball": disc()}, GRAVITY, duration=0.1))


@pytest.mark.parametrize("interrupt", [KeyboardInterrupt, SystemExit])
def test_who_interrupts_a_step_is_not_answered(
    monkeypatch: pytest.MonkeyPatch, interrupt: type[BaseException]
) -> None:
    made = falling()

    def interrupted(*_: object, **__: object) -> None:
        raise interrupt

    monkeypatch.setattr(Observer, "snapshot", interrupted)

    with pytest.raises(interrupt):
        made.advance()


def test_steps_that_are_none_are_a_mistake_of_whoever_asks() -> None:
    with pytest.raises(ValueError, match="must be at least 1"):
        falling().advance(0)


def test_numpy_warns_nobody_of_what_is_told_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    def careless(*_: object, **__: object) -> None:
        assert np.isinf(np.float64(1) / np.zeros(1)).all()

    made = falling()
    monkeypatch.setattr(made._watch, "check", careless)
    monkeypatch.setattr(made, "step", careless)

    with warnings.catch_warnings():
        warnings.simplefilter("error")
        made.advance()


def test_a_pair_that_cannot_be_kept_from_its_first_touch_on_is_told_as_such() -> None:
    """The tension of the new weld was not known yet: arrays of two lengths were multiplied."""
    vertices = [[0.33, 0.5], [3.73, 2], [-3.53, -1.09]]
    scene = level(
        {
            "a": box((0, -1), size=(3.03, 1)),
            "b": {"shape": {"type": "polygon", "vertices": vertices}, "mass": 0.48},
        },
        {
            "contact": {},
            "sticking": {"pairs": [{"bodies": ["b", "a"]}]},
            "force": [{"body": "b", "force": [-1e15, -0.3]}],
        },
    )
    with pytest.raises(SimulationError) as caught:
        build(scene).advance(8)

    assert not isinstance(caught.value, BreakdownError)
