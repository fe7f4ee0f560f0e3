"""Saving files of a run in the user's folder."""

from collections.abc import Sequence
from datetime import datetime
from io import BytesIO
from math import inf
from pathlib import Path

import pygame

from sandbox.app.files import save_folder
from sandbox.app.runs import run_file
from sandbox.app.runs.session import Session
from sandbox.model.atomic_file_writing import make_folder, write_atomically
from sandbox.model.errors import SandboxError
from sandbox.model.level_writing import text
from sandbox.model.quantities import TIME
from sandbox.physics.measuring.csv_export import to_csv
from sandbox.physics.measuring.recording import Trace
from sandbox.physics.quantities.meter import Meter


def path_for(session: Session, suffix: str) -> Path:
    """Return an unused path, named after the level's title and the time.

    Raises `SandboxError` if the folder cannot be made or written to.
    """
    folder, title = save_folder.folder(), save_folder.stem(session.original.title)
    make_folder(folder)
    now = datetime.now().strftime("%Y-%m-%d %H.%M.%S")
    found = folder / f"{title} {now}{suffix}"
    count = 2
    while found.exists():
        found = folder / f"{title} {now} ({count}){suffix}"
        count += 1
    return found


def screenshot(session: Session) -> Path:
    """Save the window as a PNG picture."""
    path, png = path_for(session, ".png"), BytesIO()
    shown = pygame.display.get_surface()
    if shown is None:
        raise SandboxError("there is no window to take a picture of")
    pygame.image.save(shown, png, "x.png")
    write_atomically(path, png.getvalue())
    return path


def run(session: Session) -> Path:
    """Save the run so far, to be replayed."""
    path = path_for(session, run_file.SUFFIX)
    run_file.save(run_file.run_of(session), path)
    return path


def table(session: Session) -> Path:
    """Save the quantities of the checks at each step, as a CSV file."""
    path = path_for(session, ".csv")
    write_atomically(
        path, to_csv(session.trace, session.original.title, disturbed=session.world.disturbed)
    )
    return path


def graph_table(
    session: Session, names: Sequence[str], across: str = TIME.name,
    within: tuple[float, float] | None = None,
) -> Path:  # fmt: skip
    """Save quantities at every recorded instant of the run, as a CSV file.

    If an interval is given, only those instants are saved at which the horizontal quantity is
    within it.
    """
    world, path = session.world, path_for(session, ".csv")
    meter = Meter(world, list(dict.fromkeys([across, *names])))
    states = session.history.snapshots
    units = {name: quantity.unit for name, quantity in meter.quantities.items()}
    columns, (low, high) = meter(states), within or (-inf, inf)
    seen = (columns[across] >= low) & (columns[across] <= high)
    columns = {name: column[seen] for name, column in columns.items() if name != TIME.name}
    built = world.level, world.values, world.stepping
    trace = Trace(*built, states.t[seen], columns, units, meetings={}, partings={})
    write_atomically(path, to_csv(trace, session.original.title, disturbed=world.disturbed))
    return path


def level(session: Session) -> Path:
    """Save a copy of the level with the present values of its parameters."""
    document = session.original.model_dump(mode="json", by_alias=True, exclude_defaults=True)
    document.pop("$schema", None)
    for name, value in session.chosen.items():
        document["parameters"][name]["value"] = value
    path = path_for(session, ".json")
    write_atomically(path, text(document))
    return path
