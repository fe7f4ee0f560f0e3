"""Bodies moved, one or many, with what hangs on them."""

from collections.abc import Collection, Mapping

from sandbox.editing.formulas import shifted
from sandbox.editing.layout import Json
from sandbox.editing.patches import put_all
from sandbox.model.expressions import Expression
from sandbox.model.level import Level
from sandbox.model.locating import Path
from sandbox.model.shapes import XY


def move(text: str, level: Level, names: Collection[str], by: XY) -> str:
    """Return a level in which bodies lie elsewhere at the start; formulas stay formulas."""
    changes: dict[Path, Json] = {}
    for name in names:
        path = ("bodies", name, "position")
        changes.update(_moved(path, level.bodies[name].position, by))
    return put_all(text, changes)


def _moved(path: Path, point: tuple[Expression, Expression], by: XY) -> Mapping[Path, Json]:
    """Return what a point becomes, coordinate by coordinate, so that the other stays as typed."""
    return {path: [shifted(c, d) for c, d in zip(point, by, strict=True)]}
