"""The experiments that come with the project: one JSON file each, beside the levels."""

import os
from pathlib import Path

from sandbox.experiments.experiment_file import Experiment, read
from sandbox.experiments.plan import Plan
from sandbox.experiments.plan_validation import make
from sandbox.model import level_catalog
from sandbox.model.atomic_file_writing import without_links
from sandbox.model.did_you_mean import suggestion
from sandbox.model.errors import LevelError, brief
from sandbox.model.json_document import refuse
from sandbox.model.level_parts import Fault
from sandbox.model.loading import load

SCHEMA = "experiment.schema.json"


def root() -> Path:
    """Return the folder of the experiments: inside an installed package, else beside the levels."""
    installed = Path(__file__).resolve().parent / "shipped"
    return installed if installed.is_dir() else level_catalog.root().parent / "experiments"


def names() -> list[str]:
    """Return the names of all experiments, such as `flip-map`."""
    return sorted(path.stem for path in root().glob("*.json") if path.name != SCHEMA)


def find(experiment: str) -> Path:
    """Return the file of an experiment: a path, or one of `names`.

    Raises `LevelError` if there is none; the message suggests what was probably meant.
    """
    if experiment in names():
        return root() / f"{experiment}.json"
    path = Path(experiment)
    if not experiment.endswith(".json"):
        refuse(
            brief(experiment),
            "is not an experiment{hint}",
            hint=suggestion(experiment, names(), longest=20),
        )
    if not os.path.lexists(path):  # the reader refuses a pipe, a folder or a broken link
        refuse(brief(experiment), "there is no such file")
    return path


def open_plan(path: Path) -> Plan:
    """Return the plan of an experiment's file.

    Raises `LevelError` if it has mistakes; the error lists all of them with their places.
    """
    experiment, document = read(path)
    try:
        source, level = _level(experiment, path.parent)
    except LevelError as error:
        document.refuse(Fault(("level",), mistake.message) for mistake in error.mistakes)
    plan, faults = make(experiment, source, load(level))
    if faults:
        document.refuse(faults)
    return plan


def _level(experiment: Experiment, folder: Path) -> tuple[str, Path]:
    """Return the name and file of the level, whose path may be relative to the experiment's."""
    beside = folder / experiment.level
    path = beside if beside.is_file() else level_catalog.find(experiment.level)
    if without_links(path).parent.parent == level_catalog.root():
        return f"{path.parent.name}/{path.stem}", path
    return experiment.level, path
