"""The textbook's chapter, part by part, with the levels that show each part.

`python -m validation.textbook_coverage` writes it to `docs/reference/chapter.md`.
"""

import sys
import tomllib
from pathlib import Path
from typing import NamedTuple

from sandbox import program
from sandbox.model import level_catalog
from sandbox.model.atomic_file_writing import generate, write_atomically
from sandbox.model.loading import load

PAGE = Path("docs") / "reference" / "chapter.md"
"""The page that is written, within a checkout."""


class Part(NamedTuple):
    """A set-up, example, figure or claim of the document; one without levels is still missing."""

    section: str
    text: str
    levels: tuple[str, ...] = ()


PARTS = tuple(
    Part(section, text, tuple(levels))
    for section, parts in tomllib.loads(
        Path(__file__).with_suffix(".toml").read_text(encoding="utf-8")
    ).items()
    for text, levels in parts.items()
)
"""The parts in `textbook_coverage.toml`, in their order."""


def parts() -> list[Part]:
    """Return all parts, and the references of levels that match none of them."""
    named = {name for part in PARTS for name in part.levels}
    others = (name for name in level_catalog.textbook() if name not in named)
    every = [*PARTS, *map(_by_reference, others)]
    sections = list(dict.fromkeys(part.section for part in every))
    return sorted(every, key=lambda part: sections.index(part.section))


def _by_reference(level: str) -> Part:
    section, _, text = load(level_catalog.find(level)).reference.partition(": ")
    return Part(section, text, (level,))


def page() -> str:
    """Return the map as Markdown."""
    every = parts()
    owed = sum(not part.levels for part in every)
    lines = [
        "# The chapter, part by part",
        "",
        f"{len(every) - owed} of {len(every)} parts can be played.",
        "This page is written by `make docs`.",
    ]
    section = ""
    for part in every:
        if part.section != section:
            section = part.section
            lines += ["", f"## {section}", "", "| part | levels |", "|---|---|"]
        levels = ", ".join(f"[{name}](../../levels/{name}.json)" for name in part.levels)
        lines.append(f"| {part.text} | {levels or '*still owed*'} |")
    return "\n".join(lines) + "\n"


def main() -> int:
    """Write the map, and return the exit status."""
    return generate(_write)


def _write() -> list[Path]:
    write_atomically(level_catalog.sources() / PAGE, page())
    return []


if __name__ == "__main__":
    with program.started():
        sys.exit(main())
