"""Every level has cases, and they can fail.

`python -m validation run` holds them all to their bounds; here only a sample is run.
"""

from dataclasses import replace
from functools import cache

import pytest

from sandbox.model import level_catalog
from sandbox.model.joints import is_exact
from sandbox.model.loading import choose, load
from validation.case import Case, Outcome, naive, run, textbook
from validation.cases import all_cases

CASES = list(all_cases())

SAMPLE = ("kinematics/projectile", "newton/atwood", "newton/incline")


def ident(case: Case) -> str:
    chosen = ",".join(f"{name}={value:g}" for name, value in case.parameters.items())
    return f"{case.name} ({chosen})"


@cache
def outcomes(level: str) -> dict[str, Outcome]:
    """Return the results of a level's cases, which share their runs."""
    cases = [case for case in CASES if case.level == level]
    return {ident(case): outcome for case, outcome in zip(cases, run(cases), strict=True)}


sampled = [case for case in CASES if case.level in SAMPLE]


def test_cases_have_names_of_their_own() -> None:
    names = [(ident(case), case.level) for case in CASES]
    assert len(set(names)) == len(names)


def test_every_level_has_a_case() -> None:
    missing = set(level_catalog.textbook()) - {case.level for case in CASES}
    assert not missing, f"add a case of each to a table in validation/cases: {sorted(missing)}"


@pytest.mark.parametrize("name", level_catalog.textbook())
def test_every_end_of_every_range_is_in_a_case(name: str) -> None:
    cases = [case.parameters for case in CASES if case.level == name]
    for parameter, range_ in textbook(name).parameters.items():
        taken = {chosen.get(parameter, range_.value) for chosen in cases}
        missing = {range_.min, range_.max} - taken
        assert not missing, f"no case in validation/cases has {parameter} at {sorted(missing)}"


@pytest.mark.parametrize("name", level_catalog.textbook())
def test_parameters_lie_in_the_levels_ranges(name: str) -> None:
    level = textbook(name)
    for case in CASES:
        if case.level == name:
            assert choose(level, case.parameters).keys() == level.parameters.keys(), ident(case)
            assert case.because, ident(case)


@pytest.mark.parametrize("case", sampled, ids=ident)
def test_a_case_of_the_sample_holds(case: Case) -> None:
    outcome = outcomes(case.level)[ident(case)]

    assert outcome.error <= outcome.tolerance
    assert outcome.passed
    assert outcome.step_seconds > 0


@pytest.mark.parametrize(
    ("claim", "level", "least"),
    [
        ("projectile: height", "kinematics/projectile", 1e-3),
        ("Atwood: displacement", "newton/atwood", 1e-3),
        ("incline: displacement", "newton/incline", 1e-3),
    ],
)
def test_naive_pymunk_misses(claim: str, level: str, least: float) -> None:
    """Measured: 1.1e-3 to 5e-1 (projectile), 1e-2 (Atwood), 7e-3 to 2e-2 (incline)."""
    errors = [
        outcome.naive_error for name, outcome in outcomes(level).items() if name.startswith(claim)
    ]

    assert errors
    assert min(errors) > least


def test_a_formula_that_is_wrong_by_one_percent_would_fail() -> None:
    """Errors are relative to the largest expected value, so this one would be 1e-2."""
    assert [ident(case) for case in CASES if not case.tolerance <= 1e-3] == []


def test_what_pymunk_must_miss_is_no_less_than_the_bound() -> None:
    idle = [case for case in CASES if (case.naive_misses or case.tolerance) < case.tolerance]
    assert [ident(case) for case in idle] == []


def test_a_wrong_closed_form_fails() -> None:
    case = next(case for case in CASES if case.name == "Atwood: tension at every step")
    wrong = replace(case, expected=lambda p, _: p["m1"] * p["g"])

    (outcome,) = run([wrong])

    assert not outcome.passed
    assert outcome.error > 0.1


def test_a_case_that_naive_pymunk_meets_cannot_claim_otherwise() -> None:
    case = next(case for case in CASES if case.name == "projectile: distance at every step")

    (outcome,) = run([replace(case, naive_misses=1e-3)])

    assert outcome.error <= outcome.tolerance
    assert not outcome.passed


def test_naive_means_stock_pymunk_at_the_levels_rate() -> None:
    level = load(level_catalog.find("energy/circular-orbit"))
    stepping = naive(level).stepping

    assert stepping.scheme == "symplectic-euler"
    assert stepping.rate == level.stepping.rate
    assert stepping.iterations == 10


@pytest.mark.parametrize(
    ("name", "own"),
    [
        ("lagrange/large-pendulum", True),
        ("momentum/cradle", True),
        ("newton/atwood", False),
        ("rotation/skater", False),
        ("momentum/ballistic-pendulum", False),
    ],
)
def test_naive_means_pymunks_own_joints_where_it_has_all_of_them(name: str, own: bool) -> None:
    joints = naive(load(level_catalog.find(name))).joints.values()

    assert all(is_exact(joint) != own for joint in joints)


def test_a_run_that_stops_fails_its_case_alone() -> None:
    """After 1.7 s the lighter weight of the Atwood machine has been pulled up to the peg."""
    case = next(case for case in CASES if case.name == "Atwood: tension at every step")

    stopped, held = run([replace(case, duration=10.0), case])

    assert not stopped.passed
    assert held.passed
