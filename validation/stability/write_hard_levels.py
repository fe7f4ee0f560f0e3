"""Writes the hard cases that are computed as levels.

Run it with `python -m validation.stability.write_hard_levels`.
"""

from sandbox.model.atomic_file_access import write_atomically
from sandbox.model.level_catalog import root
from sandbox.model.level_writing import text
from sandbox.model.loading import parse
from validation.stability.families import all_levels

FOLDER = root() / "hard"


def write() -> None:
    """Write every level after checking that it is well formed."""
    FOLDER.mkdir(exist_ok=True)
    for name, make in all_levels().items():
        said = text(make())
        parse(said, name)
        write_atomically(FOLDER / f"{name}.json", said)


if __name__ == "__main__":
    write()
