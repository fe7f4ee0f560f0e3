"""One letter wrong in every text of every level: `python -m tests.endurance.typos`.

Every key and every text that a level holds is tried with a letter too few, one too many and one
wrong, a letter at random each time. What comes of it must be a level, or mistakes that have a place
in the file; a body that is named wrong must be told at its own place.
"""

import json
import string
from collections import Counter
from collections.abc import Iterator
from copy import deepcopy
from itertools import islice
from random import Random
from typing import Any

import typer

from sandbox.model import catalog
from sandbox.model.consistency.mentions import named_bodies
from sandbox.model.errors import LevelError
from sandbox.model.loading import parse
from validation.fuzz.mutation import places

TOLD, HARMLESS, OTHER = "told", "harmless", "another body"
ANSWERS = (TOLD, HARMLESS, OTHER)


def wrong(text: str, random: Random) -> Iterator[str]:
    """Yield a text with a letter too few, too many, and wrong."""
    at, letter = random.randrange(len(text)), random.choice(string.ascii_lowercase)
    yield text[:at] + text[at + 1 :]
    yield text[:at] + letter + text[at:]
    yield text[:at] + letter + text[at + 1 :]


Typo = tuple[int, bool, str]
"""The number of a place, whether its key is misspelt, and what is written instead."""


def typos(data: Any, random: Random) -> Iterator[Typo]:  # noqa: ANN401 (whatever JSON holds)
    """Yield what may be misspelt in a level."""
    for number, (part, key) in enumerate(places(data)):
        for text in wrong(key, random) if isinstance(key, str) else ():
            if text not in part:
                yield number, True, text
        said = part[key]
        for text in wrong(said, random) if isinstance(said, str) and said else ():
            yield number, False, text


def misspelt(data: Any, typo: Typo) -> Any:  # noqa: ANN401 (whatever JSON holds)
    """Return the level with a typo in it."""
    number, of_key, text = typo
    made = deepcopy(data)
    part, key = next(islice(places(made), number, None))
    part[text if of_key else key] = part.pop(key) if of_key else text
    return made


def _path(data: Any, number: int) -> str:  # noqa: ANN401
    """Return the path of the place of that number."""
    left = number

    def walk(part: Any, path: tuple[str, ...]) -> str | None:  # noqa: ANN401
        nonlocal left
        keys = range(len(part)) if isinstance(part, list) else part
        for key in keys if isinstance(part, dict | list) else ():
            if left == 0:
                return ".".join((*path, str(key)))
            left -= 1
            if found := walk(part[key], (*path, str(key))):
                return found
        return None

    return walk(data, ()) or ""


def _answered(text: str, body: str) -> str:
    """Return what comes of a level in which a body may be misspelt at a path."""
    try:
        parse(text)
    except LevelError as error:
        if error.__cause__ is not None:
            return "not foreseen"
        there = not body or body in {mistake.path for mistake in error.mistakes}
        return TOLD if there else "told elsewhere"
    except Exception as error:  # noqa: BLE001 (that is what is looked for)
        return type(error).__name__
    return OTHER if body else HARMLESS


def main(part: int = 1, seed: int = 0) -> None:
    """Try every level, or each so many-th place of it, and tell what came of it."""
    seen, failed = Counter[str](), 0
    for name in catalog.names():
        text = catalog.find(name).read_text(encoding="utf-8")
        data, random = json.loads(text), Random(f"{seed}-{name}")
        bodies = {".".join(map(str, path)) for path, _ in named_bodies(parse(text))}
        for typo in islice(typos(data, random), 0, None, part):
            path = "" if typo[1] else _path(data, typo[0])
            outcome = _answered(json.dumps(misspelt(data, typo)), path if path in bodies else "")
            seen[outcome] += 1
            if outcome not in ANSWERS:
                failed += 1
                typer.echo(f"{name}: {typo}: {outcome}", err=True)
        typer.echo(f"{name}: {seen.total():,} tried so far")
    told = ", ".join(f"{count:,} {kind}" for kind, count in sorted(seen.items()))
    typer.echo(f"{seen.total():,} typos: {told}")
    raise typer.Exit(failed > 0)


if __name__ == "__main__":
    typer.run(main)
