"""Makes the JSON Schema of the experiment format.

`python -m sandbox.experiments.write_json_schema` writes it to `experiments`.
"""

import json
import sys
from pathlib import Path

from sandbox import program
from sandbox.experiments import catalog
from sandbox.experiments.experiment_file import Experiment
from sandbox.model import write_json_schema as levels
from sandbox.model.atomic_file_writing import generate, write_atomically
from sandbox.model.level_catalog import sources


def text() -> str:
    """Return the content of the schema file."""
    return json.dumps(levels.of(Experiment), indent=2, ensure_ascii=False) + "\n"


def write() -> Path:
    """Write the schema beside the experiments, atomically, and return its path.

    Raises `SandboxError` if the package is installed, with the schema inside it.
    """
    sources()
    target = catalog.root() / catalog.SCHEMA
    write_atomically(target, text())
    return target


if __name__ == "__main__":
    with program.started():
        sys.exit(generate(lambda: [write()]))
