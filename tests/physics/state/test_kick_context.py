"""Kicks: everything that acts in one knows its time, its length, and what follows it."""

import pytest

from sandbox.physics.state.kick_context import Clock, Kick


def test_time_is_counted_in_steps() -> None:
    """0.1 s ten times is not 1 s in floats, but ten steps of 0.1 s are."""
    clock = Clock(0.1)
    kick = Kick(clock, 0, 0.1, 0.1)
    clock.steps = 10

    assert kick.t == 1.0
    assert kick.until == 1.1


def test_a_kick_within_a_step_acts_between_two() -> None:
    kick = Kick(Clock(0.5, steps=3), 0.25, 0.125, 0.25, ends=0.5)

    assert kick.t == 3.25 * 0.5
    assert kick.until == 3.75 * 0.5


def test_nobody_changes_what_is_handed_on() -> None:
    kick = Kick(Clock(0.1), 0, 0.1, 0.1)

    with pytest.raises(AttributeError):
        kick.length = 0.2  # type: ignore[misc]
