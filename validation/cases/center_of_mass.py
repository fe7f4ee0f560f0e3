"""The centre of mass of bodies that collide: it goes on as if nothing happened."""

from collections.abc import Iterator
from functools import partial

from sandbox.model.expressions import Values
from validation.case import Case, Choices
from validation.formulas import energy, momentum

LEVEL = "momentum/center-of-mass"
PARAMETERS: Choices = (
    {},
    {"e": 0.0, "m1": 10.0, "m2": 0.1, "m3": 10.0},
    {"e": 1.0, "m1": 0.1, "m2": 10.0, "m3": 0.1, "v1": 4.0, "v3": -3.0},
    {"e": 1.0},
    {"v1": 1.0, "v3": -0.5},
)


def cases() -> Iterator[Case]:
    """Yield the cases of the centre of mass."""
    for parameters in PARAMETERS:
        case = partial(Case, level=LEVEL, parameters=parameters)
        yield case(
            name="centre of mass: place at every step",
            quantity="system.center.x",
            expected=lambda p, t: momentum.center_of_mass(_carts(p), t),
            tolerance=2e-13,
            because="every impulse acts on two bodies alike, to rounding; pymunk's own as well",
        )
        yield case(
            name="centre of mass: momentum at every step",
            quantity="system.momentum.x",
            expected=lambda p, _: sum(m * v for m, _, v in _carts(p)),
            tolerance=2e-14,
            because="every impulse acts on two bodies alike, to rounding; pymunk's own as well",
        )
        if parameters.get("e") == 1:
            yield Case(
                name="centre of mass: kinetic energy at every step",
                level=LEVEL,
                parameters=parameters,
                quantity="system.kinetic_energy",
                expected=lambda p, _: energy.kinetic_energy(*((m, v) for m, _, v in _carts(p))),
                tolerance=2e-14,
                because="one contact at a time: the solver's first sweep is exact",
            )


def _carts(p: Values) -> list[tuple[float, float, float]]:
    """Return each cart's mass [kg], and its position [m] and velocity [m/s] at the start."""
    return [(p["m1"], -2.5, p["v1"]), (p["m2"], 0.0, 0.0), (p["m3"], 2.0, p["v3"])]
