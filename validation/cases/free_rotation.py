"""Free rotation: a thrown box keeps its spin, for gravity has no torque about its centre."""

from collections.abc import Iterator
from functools import partial
from math import radians

from validation.case import Case, Choices
from validation.formulas import energy, kinematics, rotation

LEVEL = "rotation/thrown-box"
PARAMETERS: Choices = (
    {},
    {"speed": 20.0, "angle": 85.0, "spin": -10.0, "g": 2.0, "mass": 0.1},
    {"speed": 4.0, "angle": 30.0, "spin": 10.0, "g": 25.0, "mass": 100.0},
)
WIDTH, HEIGHT = 2.0, 0.8  # m


def cases() -> Iterator[Case]:
    """Yield the cases of free rotation."""
    for parameters in PARAMETERS:
        case = partial(Case, level=LEVEL, parameters=parameters)
        yield case(
            name="thrown box: angle at every step",
            quantity="box.angle",
            expected=lambda p, t: p["spin"] * t,
            tolerance=1e-13,
            because="a sum of equal turns; pymunk's own is as good",
        )
        yield case(
            name="thrown box: energy at every step",
            quantity="box.energy",
            expected=lambda p, _: (
                energy.kinetic_energy((p["mass"], p["speed"]))
                + rotation.rotational_energy(
                    rotation.box_moment(p["mass"], WIDTH, HEIGHT), p["spin"]
                )
            ),
            tolerance=2e-13,
            because="heights and speeds exact to rounding, and a spin that nothing changes",
            naive_misses=1e-3,
        )
        yield case(
            name="thrown box: angular momentum at every step",
            quantity="system.angular_momentum",
            # about the origin: the weight m g has the lever x
            expected=lambda p, t: (
                rotation.box_moment(p["mass"], WIDTH, HEIGHT) * p["spin"]
                - p["mass"]
                * p["g"]
                * kinematics.projectile_distance(p["speed"], radians(p["angle"]), t)
                * t
                / 2
            ),
            tolerance=2e-13,
            because="leapfrog is exact for constant acceleration",
            naive_misses=1e-4,
        )
