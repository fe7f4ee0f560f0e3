"""The steps of sliders, which are round numbers."""

from sandbox.app.words.formatting import nice
from sandbox.model.level import Parameter


def step_size(parameter: Parameter) -> float:
    """Return a round step, at most a hundredth of the parameter's range."""
    span = parameter.max - parameter.min
    return nice(span / 100) if span > 0 else 1.0


def rounded(parameter: Parameter, value: float) -> float:
    """Return a value rounded to whole steps, within the parameter's range."""
    size = step_size(parameter)
    whole = round(value / size) * size
    return float(f"{min(max(whole, parameter.min), parameter.max):.9g}")
