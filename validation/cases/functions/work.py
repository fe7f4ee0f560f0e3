"""The functions that the tables of `work.toml` name under `own`."""

from cmath import rect
from math import pi, radians

from sandbox.model.expressions import Array, Values
from validation.case import Expected
from validation.formulas import energy


def worked(share: float, right: float) -> Expected:
    """Return the energy after a downward push by a share of φ, or by a number of right angles."""

    def expected(p: Values, _: Array) -> float:
        push = rect(p["F"], -share * radians(p["phi"]) - right * pi / 2)
        normal = p["m"] * 9.81 - push.imag
        start = energy.kinetic_energy((p["m"], 2.5))
        return start + energy.work(push - p["mu"] * normal, complex(p["d"]))

    return expected
