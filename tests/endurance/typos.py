"""One letter wrong in every text of every level: `python -m tests.endurance.typos`.

Every key and every text in the file of a level is tried with a letter too few, one too many and one
wrong, a letter at random each time. What comes of it must be a level, or mistakes that have a place
in the file; a body that is named wrong must be told at its own place. All processors share the
work.
"""

import gc
import json
import os
import re
import string
from collections import Counter
from collections.abc import Iterator
from itertools import islice
from random import Random
from typing import NamedTuple

import typer

from sandbox.model import level_catalog
from sandbox.model.errors import LevelError
from sandbox.model.json_positions import TOKEN, Position, position
from sandbox.model.loading import parse
from sandbox.model.rules.consistency.references_by_name import named_bodies
from sandbox.parallel_processes import spread

TOLD, HARMLESS, OTHER = "told", "harmless", "another body"
ANSWERS = (TOLD, HARMLESS, OTHER)
COLON = re.compile(r"\s*:")
BATCH = 500
"""How many typos a process tries before it reports."""

EVERY = 20
"""How many reports are told as one."""


class Typo(NamedTuple):
    """A misspelt text of a file."""

    place: Position | None
    """Where messages about it point to: at its key, if it has one; None for a key itself."""
    start: int
    end: int
    instead: str
    """With its quotes."""


class Batch(NamedTuple):
    """The part of the work that one process does at a time: some typos of one level."""

    level: str
    first: int
    part: int
    seed: int


class Report(NamedTuple):
    """The result of a batch, and each typo that was not answered."""

    seen: Counter[str]
    failed: list[str]


def wrong(text: str, random: Random) -> Iterator[str]:
    """Yield a text with a missing letter, an additional one, and a wrong one."""
    at, letter = random.randrange(len(text)), random.choice(string.ascii_lowercase)
    yield text[:at] + text[at + 1 :]
    yield text[:at] + letter + text[at:]
    yield text[:at] + letter + text[at + 1 :]


def typos(text: str, random: Random) -> Iterator[Typo]:
    """Yield the texts of a level that may be misspelt."""
    key: int | None = None  # where the key stands whose value comes next
    for match in TOKEN.finditer(text):
        start, end = match.span()
        of_key = COLON.match(text, end) is not None
        place = None if of_key else position(text, start if key is None else key)
        key = start if of_key else None
        said = json.loads(match[0]) if match[0].startswith('"') else ""
        for instead in wrong(said, random) if said else ():
            yield Typo(place, start, end, json.dumps(instead, ensure_ascii=False))


def _answered(text: str, body: Position | None) -> str:
    """Return the result for a level in which a body may be misspelt at a place."""
    try:
        parse(text)
    except LevelError as error:
        if error.__cause__ is not None:
            return "not foreseen"
        if any(mistake.line is None for mistake in error.mistakes[:-1]):
            return "told nowhere"
        there = not body or body in {(mistake.line, mistake.column) for mistake in error.mistakes}
        return TOLD if there else "told elsewhere"
    except Exception as error:  # noqa: BLE001 (that is what is looked for)
        return type(error).__name__
    return OTHER if body else HARMLESS


def _chosen(level: str, text: str, part: int, seed: int) -> Iterator[Typo]:
    return islice(typos(text, Random(f"{seed}-{level}")), 0, None, part)


def _bodies(text: str) -> set[Position]:
    """Return where the text of a level names bodies."""
    level = parse(text)
    places = (level.location(path).split(":") for path, _ in named_bodies(level))
    return {(int(line), int(column)) for _, line, column, *_ in places}


def attempt(batch: Batch) -> Report:
    """Try some typos of a level."""
    level, first, part, seed = batch
    text, report = level_catalog.find(level).read_text(encoding="utf-8"), Report(Counter(), [])
    bodies = _bodies(text)
    gc.freeze()  # what is there by now is not looked through again for what is lost
    for typo in islice(_chosen(level, text, part, seed), first, first + BATCH):
        misspelt = text[: typo.start] + typo.instead + text[typo.end :]
        outcome = _answered(misspelt, typo.place if typo.place in bodies else None)
        report.seen[outcome] += 1
        if outcome not in ANSWERS:
            said = f"{text[typo.start : typo.end]} as {typo.instead}"
            report.failed.append(f"{level}: character {typo.start}: {said}: {outcome}")
    return report


def _batches(part: int, seed: int) -> Iterator[Batch]:
    """Yield everything to be tried, the largest levels last: each of their typos takes long."""
    texts = {
        name: level_catalog.find(name).read_text(encoding="utf-8") for name in level_catalog.names()
    }
    for level, text in sorted(texts.items(), key=lambda item: len(item[1])):
        for first in range(0, sum(1 for _ in _chosen(level, text, part, seed)), BATCH):
            yield Batch(level, first, part, seed)


def main(part: int = 1, seed: int = 0, jobs: int = 0) -> None:
    """Try every level, or only some of its places at equal distances, and report the results."""
    seen, failed = Counter[str](), 0
    done = spread(attempt, _batches(part, seed), jobs or os.cpu_count() or 1)
    for number, (_, report) in enumerate(done, 1):
        seen += report.seen
        failed += len(report.failed)
        for each in report.failed:
            typer.echo(each, err=True)
        if number % EVERY == 0:
            typer.echo(f"{seen.total():,} tried so far")
    told = ", ".join(f"{count:,} {kind}" for kind, count in sorted(seen.items()))
    typer.echo(f"{seen.total():,} typos: {told}")
    raise typer.Exit(failed > 0)


if __name__ == "__main__":
    typer.run(main)
