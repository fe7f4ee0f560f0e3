"""What is raised in a callback is printed and lost: Ctrl-C has to wait until it is over."""

import signal
import sys
import time
from collections.abc import Iterator
from inspect import currentframe

import pymunk
import pytest

from sandbox import interrupts, program, standard_streams
from sandbox.cli import main
from sandbox.model.errors import SandboxError

PATIENCE = 60.0  # s


@pytest.fixture(autouse=True)
def _handler(hangups: None) -> Iterator[None]:  # noqa: ARG001 (it comes first)
    before = [signal.getsignal(number) for number in interrupts.SIGNALS]
    hook = sys.unraisablehook
    interrupts.install()
    yield
    for number, handler in zip(interrupts.SIGNALS, before, strict=True):
        signal.signal(number, handler)
    sys.unraisablehook = hook
    interrupts._asked.clear()


def test_ctrl_c_within_a_class_statement_exits_as_well() -> None:
    """Python turns whatever is raised there into another error."""

    class Named:
        def __set_name__(self, owner: type, name: str) -> None:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(SystemExit) as exit_, standard_streams.standard():
        type("Made", (), {"named": Named()})

    assert exit_.value.code == interrupts.INTERRUPTED


def test_a_signal_that_became_an_error_of_a_library_exits_as_well(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Pydantic does that while it makes a class for a model."""
    monkeypatch.setattr(standard_streams, "install", lambda: None)

    def built() -> None:
        try:
            signal.raise_signal(signal.SIGTERM)
        except SystemExit:
            raise ValueError("Error building a validator") from None

    with pytest.raises(SystemExit) as exit_, program.started():
        built()

    assert exit_.value.code == interrupts.ENDED


@pytest.mark.parametrize(("name", "status"), [("SIGINT", 130), ("SIGTERM", 143), ("SIGHUP", 129)])
def test_each_signal_exits_with_the_status_of_shells(name: str, status: int) -> None:
    if not hasattr(signal, name):
        pytest.skip("there is no such signal here")

    with pytest.raises(SystemExit) as exit_:
        signal.raise_signal(signal.Signals[name])

    assert exit_.value.code == status


@pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="there is no such signal here")
def test_a_closed_terminal_does_not_end_what_was_to_outlive_it() -> None:
    """As `nohup` asks for."""
    signal.signal(signal.SIGHUP, signal.SIG_IGN)

    interrupts.install()

    signal.raise_signal(signal.SIGHUP)
    assert signal.getsignal(signal.SIGHUP) == signal.SIG_IGN


def test_ctrl_c_in_a_callback_exits_once_it_is_over() -> None:
    finished: list[bool] = []

    with pytest.raises(SystemExit):
        run_interrupted(finished)

    assert finished == [True]


def run_interrupted(finished: list[bool]) -> None:
    """Take a step that is interrupted in a callback, and wait."""
    space, body = pymunk.Space(), pymunk.Body(1, 1)
    motor = pymunk.SimpleMotor(space.static_body, body, 0)

    def interrupted(_constraint: pymunk.Constraint, _space: pymunk.Space) -> None:
        signal.raise_signal(signal.SIGINT)
        finished.append(interrupts.within_callback(currentframe()))

    motor.pre_solve = interrupted
    space.add(body, motor)
    space.step(0.01)
    assert not interrupts.within_callback(currentframe())
    wait()


class Freed:
    """Something that is freed just when a signal comes."""

    def __init__(self, number: signal.Signals) -> None:
        self._number = number

    def __del__(self) -> None:
        signal.raise_signal(self._number)


@pytest.mark.parametrize("number", interrupts.SIGNALS)
def test_a_signal_while_something_is_freed_exits_after_it(number: signal.Signals) -> None:
    """What pymunk frees, it frees in Python, and there an exception is lost, too."""
    with pytest.raises(SystemExit) as exit_:
        interrupted_in_freeing(number)

    assert exit_.value.code == interrupts.STATUS + number


def interrupted_in_freeing(number: signal.Signals) -> None:
    freed = Freed(number)
    del freed
    wait()


def wait() -> None:
    """Let time pass until something is raised, but not for ever."""
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        time.sleep(0.001)


def test_what_else_is_lost_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    class Faulty:
        def __del__(self) -> None:
            raise ValueError("it was lost")

    faulty = Faulty()
    del faulty

    assert "it was lost" in capsys.readouterr().err


def test_ctrl_c_that_became_a_mistake_of_a_level_exits_as_well(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Pydantic turns it into an error of its own while it makes a model."""

    def app() -> None:
        try:
            signal.raise_signal(signal.SIGTERM)
        except SystemExit:
            raise SandboxError("nothing can be computed") from None

    monkeypatch.setattr(main, "app", app)
    with pytest.raises(SystemExit) as exit_:
        main.main()

    assert exit_.value.code == interrupts.ENDED
    assert capsys.readouterr().err == ""
