"""Fitting of a level's parameters to measured data."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from sandbox.experiments.measured_data import Data
from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import SandboxError, ValueRangeError, brief
from sandbox.model.expressions import Array, Values
from sandbox.model.level import Level, Stepping
from sandbox.model.translatable_message import both
from sandbox.physics.measuring.interpolation_between_steps import value_at
from sandbox.physics.run import simulate

STEP = 1e-5
"""The finite difference of a parameter, as a share of its range."""


class FitError(SandboxError):
    """Data from which a parameter cannot be determined."""


@dataclass(frozen=True, slots=True)
class Fitted:
    """A fitted parameter."""

    name: str
    unit: str
    value: float
    uncertainty: float
    """The parameter, and its standard uncertainty, in its unit."""
    bound: bool
    """Whether it lies at an end of the level's range: then the best value is beyond it."""


@dataclass(frozen=True, slots=True)
class Fit:
    """The result of a fit."""

    parameters: tuple[Fitted, ...]
    """The p fitted parameters."""
    correlation: Array
    """(p, p), the correlation of their errors."""
    count: int
    """The number of measured values."""
    scatter: float
    """The root of the reduced χ²: about 1 if the level and the uncertainties are right. 1 if the
    uncertainties were unknown, since they are then estimated from the residuals."""
    model: Mapping[str, Array]
    """(N,) each, the values of the run at the times of the data."""


def fit(level: Level, values: Values, names: Sequence[str], data: Data, stepping: Stepping) -> Fit:
    """Find parameters by least squares.

    The uncertainties are those of the linearized problem, (Jᵀ J)⁻¹, where J is the Jacobian of the
    residuals over their uncertainties. Raises `FitError` if the data do not determine them. Raises
    `ValueRangeError` if the level has no such parameter. Raises `SimulationError` if a run had to
    stop.
    """
    from scipy.optimize import least_squares

    _check(level, names, data)
    ranges = np.array([(level.parameters[n].min, level.parameters[n].max) for n in names])
    low, width = ranges[:, 0], ranges[:, 1] - ranges[:, 0]
    has_uncertainties = bool(data.uncertainties)

    def residuals(share: Array) -> Array:
        chosen = {**values, **dict(zip(names, (low + width * share).tolist(), strict=True))}
        model = predicted(level, chosen, data, stepping)
        return np.concatenate([_residual(data, name, model[name]) for name in data.columns])

    start = np.clip((np.array([values[n] for n in names]) - low) / width, 0.01, 0.99)
    found = least_squares(
        residuals, start, bounds=(0, 1), diff_step=STEP, xtol=1e-12, ftol=1e-12, gtol=1e-12
    )
    mean_square = float(found.fun @ found.fun) / (data.count - len(names))
    covariance = _inverse_square(found.jac, names) * (1.0 if has_uncertainties else mean_square)
    deviation = np.sqrt(covariance.diagonal())
    best = low + width * found.x
    chosen = {**values, **dict(zip(names, best.tolist(), strict=True))}
    fitted = zip(names, best, deviation * width, found.active_mask, strict=True)
    parameters = tuple(
        Fitted(n, level.parameters[n].unit, float(v), float(d), bool(b)) for n, v, d, b in fitted
    )
    scatter = float(np.sqrt(mean_square)) if has_uncertainties else 1.0
    correlation = covariance / np.outer(deviation, deviation)
    model = predicted(level, chosen, data, stepping)
    return Fit(parameters, correlation, data.count, scatter, model)


def _inverse_square(jacobian: Array, names: Sequence[str]) -> Array:
    """Return (Jᵀ J)⁻¹ of the residuals' Jacobian; refuse one of less than full rank."""
    square = jacobian.T @ jacobian
    if not np.linalg.cond(square) < 1e14:
        raise FitError("the data do not determine {names}", names=both(names))
    return np.asarray(np.linalg.inv(square))


def predicted(level: Level, values: Values, data: Data, stepping: Stepping) -> dict[str, Array]:
    """Return the values of a run at the times of the data: (N,) each."""
    trace = simulate(level, values, float(data.t.max()), data.columns, stepping)
    return {
        name: np.array(
            [value_at(trace.t, trace.columns[name], t, smooth=trace.smooth) for t in data.t]
        )
        for name in data.columns
    }


def _residual(data: Data, name: str, model: Array) -> Array:
    measured = data.columns[name]
    uncertainty = data.uncertainties.get(name, np.ones_like(measured))
    residual = (model - measured) / uncertainty
    return residual[np.isfinite(measured)]


def _check(level: Level, names: Sequence[str], data: Data) -> None:
    for name in names:
        if name not in level.parameters:
            hint = suggestion(name, level.parameters, longest=20)
            raise ValueRangeError(
                "'{name}' is not a parameter of the level{hint}", name=brief(name), hint=hint
            )
    if data.count <= len(names):
        raise FitError(
            "{count} numbers were measured; {names} parameters need more",
            count=data.count,
            names=len(names),
        )
    if data.uncertainties and set(data.uncertainties) != set(data.columns):
        name = next(name for name in data.columns if name not in data.uncertainties)
        raise FitError("'{name}' has no uncertainties, but others have: all, or none", name=name)
