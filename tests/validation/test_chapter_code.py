"""The chapter's code prints what the chapter says, and the sandbox agrees with it at every step."""

import numpy as np
import pytest

from sandbox.model import level_catalog
from sandbox.model.loading import load
from sandbox.physics.measuring.grading import grade
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.run import simulate
from validation.formulas import kinematics, textbook_code

THETA, OMEGA, ENERGY = "needle.angle", "needle.angular_velocity", "system.energy"


def record(name: str, *quantities: str) -> Trace:
    return simulate(load(level_catalog.find(name)), record=quantities or None)


@pytest.mark.sweep
def test_the_listings_print_these_figures() -> None:
    printed = {name: round(value, 4) for name, value in textbook_code.figures().items()}

    assert printed == {
        "range": 63.6396,
        "peak height": 15.9276,
        "Euler E drift": 22.3705,
        "Symplectic E drift": -0.0079,
        "range without NumPy": 63.6396,
        "peak without NumPy": 15.9276,
        "theta after 50 s": -0.4854,
        "omega after 50 s": 0.3455,
    }


def test_the_listing_stops_short_of_the_range_that_the_sandbox_finds() -> None:
    """Its last sample is 0.4 of a step before the landing: 63.64 m of 63.71 m."""
    results = {result.check.label: result for result in grade(record("kinematics/projectile"))}
    x = textbook_code.figures()["range"]

    assert results["range"].measured == pytest.approx(63.7105, abs=1e-4)
    assert results["apex"].measured == pytest.approx(15.9276, abs=1e-4)
    assert 0 < kinematics.projectile_range(25, np.pi / 4, 9.81) - x < 25 * np.sqrt(0.5) * 0.01


@pytest.mark.sweep
def test_plain_euler_in_the_sandbox_is_the_chapters_bit_for_bit() -> None:
    """It passes the top, 22.37 J up, where a different last digit would grow."""
    columns = record("lagrange/euler-pendulum", THETA, OMEGA, ENERGY).columns
    theta, omega = textbook_code.run(textbook_code.step_euler)

    assert np.array_equal(columns[THETA], theta)
    assert np.array_equal(columns[OMEGA], omega)
    assert columns[ENERGY][-1] - columns[ENERGY][0] == pytest.approx(22.3705, abs=5e-5)


@pytest.mark.sweep
def test_symplectic_euler_in_the_sandbox_is_the_chapters_begun_with_a_drift() -> None:
    """The chapter kicks, then drifts; pymunk drifts, then kicks: one chain with another start."""
    columns = record("lagrange/symplectic-pendulum", THETA, OMEGA).columns
    kick = 9.81 * np.sin(textbook_code.START) * textbook_code.DT
    theta, omega = textbook_code.run(textbook_code.step_symplectic, omega=kick)

    assert np.abs(columns[THETA] - theta).max() < 1e-12
    assert np.abs(columns[OMEGA][:-1] - omega[1:]).max() < 1e-12


@pytest.mark.parametrize("step", [textbook_code.step_euler, textbook_code.step_symplectic])
def test_plain_euler_leaks_energy_and_symplectic_euler_keeps_it(step: textbook_code.Step) -> None:
    """For ten seconds plain Euler gains in every step; the other is off by at most 1.6 %."""
    theta, omega = textbook_code.run(step)
    energy = np.array([textbook_code.energy(*state) for state in zip(theta, omega, strict=True)])

    if step is textbook_code.step_euler:
        assert (np.diff(energy[:1000]) > 0).all()
        assert energy[-1] > 10 * energy[0]
    else:
        assert np.abs(energy - energy[0]).max() < 0.02 * energy[0]
