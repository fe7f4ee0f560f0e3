"""The report of scenes on a terminal."""

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence

from rich.table import Table

from validation import output
from validation.compose.outcome import Outcome

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
        mark = "[red]✗[/]" if failing else "[green]✓[/]"
        counts = (len(members), sum(o.passed for o in members), sum(o.refused for o in members))
        table.add_row(family, *map(str, counts), failing, mark)
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
