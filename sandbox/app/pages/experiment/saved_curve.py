"""Saving the points of a curve in the user's folder."""

import csv
from collections.abc import Sequence
from io import StringIO
from pathlib import Path

from sandbox.app.pages.experiment.background_parameter_sweep import Point
from sandbox.app.pages.experiment.parameter_curve import CurveChoice
from sandbox.app.pages.share.saving import path_for
from sandbox.app.runs.session import Session
from sandbox.model.atomic_file_writing import write_atomically
from sandbox.model.quantities import column_heading


def save(session: Session, choice: CurveChoice, points: Sequence[Point]) -> Path:
    """Save the points as a CSV file, below the values of the other parameters."""
    unit = session.level.parameters[choice.parameter].unit
    rest = (f"{k}={v!r}" for k, v in session.values.items() if k != choice.parameter)
    above = f"# level: {session.original.title}\n# set: {' '.join(rest)}\n"
    content = StringIO(newline="")
    rows = csv.writer(content, lineterminator="\n")
    heading = column_heading(choice.parameter, unit)
    rows.writerow([heading, choice.measure, "closed form", "failure"])
    rows.writerows(points)
    path = path_for(session, ".csv")
    write_atomically(path, above + content.getvalue())
    return path
