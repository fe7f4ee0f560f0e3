"""The table of an experiment, a row for each run, in Arrow's format."""

from typing import TYPE_CHECKING, NamedTuple

from sandbox.experiments.parameter_axes import Listed
from sandbox.experiments.plan import Plan

if TYPE_CHECKING:
    import pyarrow as pa

Cell = float | str | None

NUMBER, FAILURE = "run", "failure"
"""The names of the first and the last column."""


class Column(NamedTuple):
    """A column of measured or expected numbers."""

    name: str
    unit: str


def closed_form(measure: str) -> str:
    """Return the name of the column with a measure's closed form."""
    return f"{measure} closed form"


def error(measure: str) -> str:
    """Return the name of the column with a measure's error."""
    return f"{measure} error"


def columns(plan: Plan) -> list[Column]:
    """Return the columns of all measures, with closed forms and errors where checks exist."""
    found = []
    for measure in plan.measures:
        found.append(Column(measure.text, measure.unit))
        if measure.of is not None and measure.check is not None:
            found.append(Column(closed_form(measure.text), measure.unit))
            found.append(Column(error(measure.text), ""))
    return found


def schema(plan: Plan) -> "pa.Schema":
    """Return the names, types and units of all columns, as an Arrow schema."""
    import pyarrow as pa

    fields = [pa.field(NUMBER, pa.int64(), nullable=False)]
    for name, axis in plan.axes.items():
        words = isinstance(axis, Listed) and isinstance(axis.values[0], str)
        kind = pa.string() if words else pa.float64()
        fields.append(pa.field(name, kind, metadata=_unit(axis_unit(plan, name))))
    measured = (pa.field(c.name, pa.float64(), metadata=_unit(c.unit)) for c in columns(plan))
    return pa.schema([*fields, *measured, pa.field(FAILURE, pa.string())])


def axis_unit(plan: Plan, name: str) -> str:
    """Return the unit of an axis; empty if it has none."""
    if name in plan.level.parameters:
        return plan.level.parameters[name].unit
    return "Hz" if name == "rate" else ""


def _unit(unit: str) -> dict[str, str] | None:
    return {"unit": unit} if unit else None
