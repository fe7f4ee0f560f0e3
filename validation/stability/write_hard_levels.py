"""Writes the hard cases that are computed as levels.

Run it with `python -m validation.stability.write_hard_levels`.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

from sandbox import program
from sandbox.model.atomic_file_writing import generate, write_atomically
from sandbox.model.level_catalog import HARD, root, sources
from sandbox.model.level_writing import text
from sandbox.model.loading import parse
from validation.stability.families import all_levels

FOLDER = root() / HARD


def write() -> Iterator[Path]:
    """Write every level after checking that it is well formed, and yield its path."""
    sources()
    FOLDER.mkdir(exist_ok=True)
    for name, make in all_levels().items():
        said = text(make())
        parse(said, name)
        write_atomically(FOLDER / f"{name}.json", said)
        yield FOLDER / f"{name}.json"


if __name__ == "__main__":
    with program.started():
        sys.exit(generate(write))
