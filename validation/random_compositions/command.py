"""`python -m validation compose`."""

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

import typer
from rich.table import Table

from sandbox.model.atomic_file_writing import folder_of_files, write_atomically
from sandbox.model.errors import SandboxError
from sandbox.model.level_writing import text
from validation import output
from validation.random_compositions.invariants import Judgement, judge
from validation.random_compositions.recorded_run import Refused, run_at_advised_rate
from validation.random_compositions.seeded_scenes import Scene, scene
from validation.stability.scene_parts import Document


@dataclass(frozen=True, slots=True)
class Outcome:
    """The outcome of a scene."""

    seed: int
    family: str
    """The seed and the family of the scene."""
    bodies: int
    joints: int
    """The numbers of bodies and joints."""
    judgements: tuple[Judgement, ...]
    """The judgements; none for a scene that was refused."""
    passed: bool
    """Whether all of them hold."""
    refused: bool
    """Whether it was refused before its first step."""
    reason: str
    """Why it was refused, or why it stopped; empty if it did neither."""
    rate: float
    """The rate of its steps [Hz]."""
    seconds: float
    """The total time [s]."""

    @property
    def name(self) -> str:
        """Its name: the family and the seed."""
        return f"{self.family}-{self.seed}"

    @property
    def failed(self) -> tuple[Judgement, ...]:
        """The judgements that do not hold."""
        return tuple(judgement for judgement in self.judgements if not judgement.passed)


def measure(
    chosen: Sequence[int], json_file: Path | None, folder: Path | None, jobs: int | None
) -> bool:
    """Judge scenes, print the failures by family, and return whether all judgements hold.

    The outcomes go to the JSON file, and the levels of failed scenes to the folder, if any. By
    default there are as many processes as cores. Raises `SandboxError` if a file cannot be written.
    """
    with folder_of_files(folder) if folder else nullcontext():
        found = output.spread_in_order(judged, chosen, "Judging scenes", jobs)
        with output.written(output.content(scenes=found), json_file):
            _show(found)
        if folder:
            _save([o for o in found if o.failed], folder)
    return not any(o.failed for o in found)


def _show(found: Sequence[Outcome]) -> None:
    output.show(by_family(found))
    output.complain(complaints(found))
    refused = sum(o.refused for o in found)
    typer.echo(f"{sum(o.passed for o in found)} of {len(found)} scenes hold, {refused} refused.")


def _save(failed: Sequence[Outcome], folder: Path) -> None:
    """Write the levels of failed scenes, so that they can be played."""
    for outcome in failed:
        write_atomically(folder / f"{outcome.name}.json", text(playable(outcome)))
    typer.echo(f"{len(failed)} levels written to {folder}.")


TOLD = 20
"""The most failed scenes that are named."""


def by_family(found: Sequence[Outcome]) -> Table:
    """Return a table with a row per family: how many scenes pass, and which judgements fail."""
    table = output.table("Random compositions", "family", ("scenes", "hold", "refused"))
    table.add_column("failed judgements, of all")
    table.add_column("")
    families: dict[str, list[Outcome]] = defaultdict(list)
    for outcome in found:
        families[outcome.family].append(outcome)
    for family, members in sorted(families.items()):
        failing = ", ".join(_counted(members))
        counts = (len(members), sum(o.passed for o in members), sum(o.refused for o in members))
        table.add_row(family, *map(str, counts), failing, output.mark(passed=not failing))
    return table


def _counted(members: Sequence[Outcome]) -> Iterator[str]:
    """Yield each judgement that fails, with how often, and out of how many."""
    made = Counter(judgement.name for outcome in members for judgement in outcome.judgements)
    missed = Counter(judgement.name for outcome in members for judgement in outcome.failed)
    for name in made:
        if missed[name]:
            yield f"{name} {missed[name]}/{made[name]}"


def complaints(found: Sequence[Outcome]) -> Iterator[str]:
    """Yield the failed scenes with their judgements, at most `TOLD` of them."""
    failed = [outcome for outcome in found if outcome.failed]
    for outcome in failed[:TOLD]:
        missed = ", ".join(f"{j.name} {j.figure:.1e} of {j.bound:.1e}" for j in outcome.failed)
        yield f"{outcome.name}: {missed}"
    if len(failed) > TOLD:
        yield f"and {len(failed) - TOLD} more"


def judged(seed: int) -> Outcome:
    """Run and judge the scene of a seed."""
    return judge_scene(scene(seed))


def judge_scene(found: Scene) -> Outcome:
    """Run and judge a scene."""
    begin = perf_counter()
    rate, reason, refused = float(found.document["stepping"]["rate"]), "", False
    judgements: list[Judgement] = []
    try:
        level = found.level()
        recorded = run_at_advised_rate(found, level)
    except (SandboxError, Refused) as error:
        refused, reason = True, str(error)
    else:
        rate, reason = recorded.rate, recorded.failure
        judgements = judge(recorded)
    return Outcome(
        found.seed, found.family, len(found.document["bodies"]), len(found.document["joints"]),
        tuple(judgements), not refused and all(j.passed for j in judgements), refused, reason, rate,
        perf_counter() - begin,
    )  # fmt: skip


def playable(found: Outcome) -> Document:
    """Return the level of a scene as it was run, with what is wrong in its summary."""
    document = scene(found.seed).document
    judgements = ", ".join(f"{j.name} {j.figure:.2g} (bound {j.bound:.2g})" for j in found.failed)
    summary = f"{judgements}; {found.reason}" if found.reason else judgements
    return {**document, "summary": summary, "stepping": {"rate": found.rate}}
