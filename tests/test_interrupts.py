"""What is raised in a callback is printed and lost: Ctrl-C has to wait until it is over."""

import signal
import sys
import time
from collections.abc import Iterator
from inspect import currentframe

import pymunk
import pytest

from sandbox import interrupts, streams

PATIENCE = 60.0  # s


@pytest.fixture(autouse=True)
def _handler() -> Iterator[None]:
    numbers = signal.SIGINT, signal.SIGTERM
    before, hook = [signal.getsignal(number) for number in numbers], sys.unraisablehook
    interrupts.install()
    yield
    for number, handler in zip(numbers, before, strict=True):
        signal.signal(number, handler)
    sys.unraisablehook = hook


def test_ctrl_c_within_a_class_statement_exits_as_well() -> None:
    """Python turns whatever is raised there into another error."""

    class Named:
        def __set_name__(self, owner: type, name: str) -> None:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(SystemExit) as exit_, streams.standard():
        type("Made", (), {"named": Named()})

    assert exit_.value.code == interrupts.INTERRUPTED


def test_ctrl_c_exits_with_the_status_of_shells() -> None:
    with pytest.raises(SystemExit) as exit_:
        signal.raise_signal(signal.SIGINT)

    assert exit_.value.code == 130


def test_a_request_to_end_exits_with_the_status_of_shells() -> None:
    with pytest.raises(SystemExit) as exit_:
        signal.raise_signal(signal.SIGTERM)

    assert exit_.value.code == 143


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
    """Something that is freed just when somebody presses Ctrl-C."""

    def __del__(self) -> None:
        signal.raise_signal(signal.SIGINT)


def test_ctrl_c_while_something_is_freed_exits_after_it() -> None:
    """What pymunk frees, it frees in Python, and there an exception is lost, too."""
    with pytest.raises(SystemExit):
        interrupted_in_freeing()


def interrupted_in_freeing() -> None:
    freed = Freed()
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
