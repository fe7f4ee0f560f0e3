"""`python -m validation fuzz`."""

import json
from collections import Counter
from collections.abc import Callable, Generator
from contextlib import closing
from copy import deepcopy
from dataclasses import dataclass, field
from hashlib import sha256
from itertools import count
from pathlib import Path
from random import Random
from time import monotonic
from typing import Any

import typer

from sandbox.model.atomic_file_writing import folder_of_files, write_atomically
from validation import output
from validation.fuzz.coverage_guided_levels import available, guided
from validation.fuzz.isolated_trial import Trial, Tried
from validation.fuzz.mutated_levels import places
from validation.fuzz.random_levels import drawn_level
from validation.fuzz.refused_level_repair import answered

TRIES = 120


SAMPLES = Path("out") / "fuzz"
"""The default folder of levels that fail."""


@dataclass(slots=True)
class Findings:
    """The outcomes of many levels."""

    answers: Counter[str] = field(default_factory=Counter)
    """The number of levels that were answered, by kind of answer."""
    failures: list[dict[str, Any]] = field(default_factory=list)
    """The levels that were not: the number of each, what happened, and the file of its reduced
    form."""
    guided: bool = False
    """Whether Atheris guided the search."""


def made(seed: int, number: int) -> dict[str, Any]:
    """Return a level that depends only on the seed and the number."""
    random = Random(f"{seed}-{number}")
    return drawn_level(random, changed=bool(number % 2))


def drawn(seed: int, trial: Trial) -> Generator[Tried]:
    """Yield the outcomes of random levels, endlessly."""
    for number in count():
        for data, outcome in answered(made(seed, number), trial.run):
            yield Tried(number, data, outcome)


def fuzz(
    number: int | None, seed: int, minutes: float | None, json_file: Path | None, samples: Path
) -> bool:
    """Try levels, keep those without an answer, and return whether there are none.

    Without a number, there are as many as the time allows. The findings go to the JSON file, if
    any, and the reduced forms of levels that fail to the folder of samples, made if missing. Raises
    `SandboxError` if a file cannot be written.
    """
    start = monotonic()
    found, trial = Findings(guided=available()), Trial()
    try:
        source = guided(seed, trial) if found.guided else drawn(seed, trial)
        with folder_of_files(samples), closing(source):
            try:
                for tried in source:
                    late = minutes is not None and monotonic() - start > 60 * minutes
                    if late or tried.number == number:
                        break
                    _note(tried, trial, found, samples)
            finally:  # report the findings also after an interruption
                _report(found, seed, monotonic() - start, json_file)
    finally:
        trial.close()
    return not found.failures


def _report(found: Findings, seed: int, seconds: float, json_file: Path | None) -> None:
    """Print the findings, and write them to a file if one is given."""
    answers = ", ".join(f"{times:,} {kind}" for kind, times in sorted(found.answers.items()))
    how = "led by Atheris" if found.guided else "drawn at random"
    total = f"{found.answers.total():,} levels, {how}, in {seconds:.0f} s"
    wrong = (f"{one['number']}: {one['what']} ({one['sample']})" for one in found.failures)
    content = output.content(
        seed=seed, guided=found.guided, count=found.answers.total(), seconds=seconds,
        answers=found.answers, failures=found.failures, passed=not found.failures,
    )  # fmt: skip
    with output.written(content, json_file):
        typer.echo(f"{total}: {answers or 'none'}.")
        output.complain(wrong)


def _note(tried: Tried, trial: Trial, found: Findings, samples: Path) -> None:
    """Count an outcome; if it is bad, keep the smallest level that has it."""
    number, data, outcome = tried
    found.answers[outcome.kind] += 1
    if outcome.passed:
        return
    least = shrunk(data, lambda smaller: trial.run(json.dumps(smaller)).kind == outcome.kind)
    text = json.dumps(least, indent=2) + "\n"
    sample = (
        samples / f"{outcome.kind.replace(' ', '-')}-{sha256(text.encode()).hexdigest()[:8]}.json"
    )
    write_atomically(sample, text)
    message = f"{outcome.kind}: {outcome.what}"
    found.failures.append({"number": number, "what": message, "sample": str(sample)})


def shrunk(data: dict[str, Any], wrong: Callable[[dict[str, Any]], bool]) -> dict[str, Any]:
    """Return a failing level without everything that the failure does not need.

    `wrong` tells whether another level fails in the same way.
    """
    tries, number = 0, 0
    while tries < TRIES:
        smaller = deepcopy(data)
        found = list(places(smaller))
        if number >= len(found):
            return data
        part, key = found[number]
        del part[key]
        tries += 1
        if wrong(smaller):
            data = smaller
        else:
            number += 1
    return data
