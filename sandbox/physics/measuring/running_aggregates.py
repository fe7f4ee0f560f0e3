"""Running extremes, means and integrals of a quantity since the start of a run.

They are computed from the samples: an extreme between two samples is missed, and an integral uses
the trapezoidal rule. Both errors are of second order.
"""

from collections.abc import Callable, Mapping

import numpy as np

from sandbox.model.expressions import Array
from sandbox.model.quantities import OVER_TIME


def _integral(t: Array, y: Array) -> Array:
    found = np.zeros_like(y)
    found[1:] = np.cumsum(np.diff(t) * (y[1:] + y[:-1]) / 2)
    return found


def _mean(t: Array, y: Array) -> Array:
    """Return the integral divided by the time; at the start, the value itself."""
    passed = t - t[0]
    return np.divide(_integral(t, y), passed, out=y.astype(float), where=passed > 0)


def _amplitude(_: Array, y: Array) -> Array:
    return (np.maximum.accumulate(y) - np.minimum.accumulate(y)) / 2


_FORMS: Mapping[str, Callable[[Array, Array], Array]] = {
    "min": lambda _, y: np.minimum.accumulate(y),
    "max": lambda _, y: np.maximum.accumulate(y),
    "largest": lambda _, y: np.maximum.accumulate(np.abs(y)),
    "amplitude": _amplitude,
    "mean": _mean,
    "integral": _integral,
}
assert _FORMS.keys() == OVER_TIME.keys()


def over_time(what: str, t: Array, y: Array) -> Array:
    """Return an aggregate, one of `OVER_TIME`, of a quantity up to each time: (T,)."""
    return _FORMS[what](t, y)
