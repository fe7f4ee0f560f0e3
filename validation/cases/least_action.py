"""The action of the true way, and of ways that stray from it."""

from collections.abc import Iterator

from sandbox.model.expressions import Expression
from validation.case import SECOND_ORDER, Case, Choices, Expected
from validation.formulas import lagrange

ACROSS = 6.0  # m/s
THROWS: Choices = ({}, {"v": 6.0, "a": 1.2, "m": 0.5}, {"v": 9.0, "a": 0.4, "m": 2.0})
WAYS = {"true": (0, 0), "above": (1, 1), "below": (-1, 1), "twice": (1, 2), "thrice": (1, 3)}
"""On which side each body strays, and in how many waves."""

LANDING = Expression("2*v/9.81")


def cases() -> Iterator[Case]:
    """Yield the cases of least action."""
    for parameters in THROWS:
        for body, (side, waves) in WAYS.items():
            yield Case(
                name=f"least action: that of '{body}' at every step",
                level="lagrange/least-action",
                parameters=parameters,
                quantity=f"{body}.action",
                expected=_action(side, waves),
                tolerance=1e-4,
                order=SECOND_ORDER,
                because="trapezoids over a way of second order",
                naive_misses=1e-3,
            )
        yield Case(
            name="least action: how much more the one above has",
            level="lagrange/least-action",
            parameters=parameters,
            quantity="above.action",
            at=LANDING,
            expected=lambda p, _: (
                lagrange.action_of_throw(LANDING(p), p["m"], (ACROSS, p["v"]), 9.81, 0.0, 1)
                + lagrange.more_action(p["m"], p["a"], 1, LANDING(p))
            ),
            tolerance=1e-4,
            because="as at every step; to the third order of a nothing else is left",
        )


def _action(side: int, waves: int) -> Expected:
    return lambda p, t: lagrange.action_of_throw(
        t, p["m"], (ACROSS, p["v"]), 9.81, side * p["a"], waves
    )
