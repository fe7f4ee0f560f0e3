"""A glancing elastic collision of two equal smooth discs, which meet on a step."""

from collections.abc import Iterator
from math import radians

from sandbox.model.level import ContactEvent
from validation.case import Case, Choices
from validation.formulas import energy, momentum

AFTER = ContactEvent(event="contact", bodies=("first", "second"))
PARAMETERS: Choices = (
    {},
    {"angle": 0.0},
    {"angle": 60.0, "speed": 5.0, "mass": 0.1},
    {"angle": 75.0, "speed": 1.0, "mass": 10.0},
)


def cases() -> Iterator[Case]:
    """Yield the cases of the glancing collision."""
    for parameters in PARAMETERS:
        for i, body in enumerate(("first", "second")):
            for j, component in enumerate("xy"):
                yield Case(
                    name=f"glancing collision: velocity of the {body} along {component}",
                    level="momentum/glancing",
                    parameters=parameters,
                    quantity=f"{body}.velocity.{component}",
                    at=AFTER,
                    expected=lambda p, _, i=i, j=j: momentum.glancing_velocities(  # type: ignore[misc]
                        p["speed"], radians(p["angle"])
                    )[i][j],
                    # at 75° what the second gets is a fifteenth of what there is
                    tolerance=3e-12 if parameters.get("angle") == 75 else 1e-12,
                    because="they overlap by 1e-13 m when they meet, which turns the line between"
                    " their centres by 2e-13",
                )
        yield Case(
            name="glancing collision: kinetic energy at every step",
            level="momentum/glancing",
            parameters=parameters,
            quantity="system.kinetic_energy",
            expected=lambda p, _: energy.kinetic_energy((p["mass"], p["speed"])),
            tolerance=1e-12,
            because="one contact between two bodies: the solver's first sweep is exact",
        )
