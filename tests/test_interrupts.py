"""An exception in a callback of pymunk is printed and lost: Ctrl-C has to wait until it is over."""

import signal
from collections.abc import Iterator
from inspect import currentframe

import pymunk
import pytest

from sandbox import interrupts


@pytest.fixture(autouse=True)
def _handler() -> Iterator[None]:
    before = signal.getsignal(signal.SIGINT)
    interrupts.install()
    yield
    signal.signal(signal.SIGINT, before)


def test_ctrl_c_exits_with_the_status_of_shells() -> None:
    with pytest.raises(SystemExit) as exit_:
        signal.raise_signal(signal.SIGINT)

    assert exit_.value.code == 130


def test_ctrl_c_in_a_callback_exits_once_it_is_over() -> None:
    finished: list[bool] = []

    with pytest.raises(SystemExit):
        run_interrupted(finished)

    assert finished == [True]


def run_interrupted(finished: list[bool]) -> None:
    """Take a step that is interrupted in a callback, and go on for ever."""
    space, body = pymunk.Space(), pymunk.Body(1, 1)
    motor = pymunk.SimpleMotor(space.static_body, body, 0)

    def interrupted(_constraint: pymunk.Constraint, _space: pymunk.Space) -> None:
        signal.raise_signal(signal.SIGINT)
        finished.append(interrupts.within_callback(currentframe()))

    motor.pre_solve = interrupted
    space.add(body, motor)
    space.step(0.01)
    while True:
        assert not interrupts.within_callback(currentframe())
