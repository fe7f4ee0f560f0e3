"""The results of a level's checks as lines of text."""

from collections.abc import Iterable, Iterator, Sequence

from sandbox.app.words import formatting
from sandbox.cli.text_columns import aligned
from sandbox.model.expressions import Expression
from sandbox.physics.measuring.challenge_goals import attempt
from sandbox.physics.measuring.grading import Result
from sandbox.physics.measuring.recording import Trace

_HEADER = ("quantity", "measured", "expected", "error", "tolerance", "verdict")


def failed(result: Result, *, complete: bool) -> bool:
    """Whether a check failed; in a complete run also if its instant never came."""
    return result.verdict == "failed" or (complete and result.verdict == "waiting")


def lines(results: Sequence[Result], *, complete: bool) -> Iterator[str]:
    """Yield a header and one line a check, in columns."""
    rows = [_HEADER, *(_row(result, complete=complete) for result in results)]
    yield from aligned(rows)


def challenge_lines(trace: Trace) -> Iterator[str]:
    """Yield the state of the level's challenge after a run: its goals, then its stars."""
    found = attempt(trace.until(trace.level.duration(trace.values)))
    if found is None:
        return
    rows = [("goal", "measured", "asked for", "standing")]
    for outcome in found.outcomes:
        measured = _value(outcome.measured, outcome.unit)
        rows.append((outcome.goal.label, measured, formatting.bounds(outcome), outcome.standing))
    yield from aligned(rows)
    if found.changed_parameters:
        changed = ", ".join(found.changed_parameters)
        yield f"no star counts, for what is locked was changed: {changed}"
    yield f"challenge: {found.stars} of {found.possible_stars} stars"


def worst(results: Iterable[Result]) -> float | None:
    """Return the largest error as a share of its tolerance; None if nothing was measured."""
    shares = [r.error / r.check.tolerance for r in results if r.error is not None]
    return max(shares, default=None)


def _row(result: Result, *, complete: bool) -> tuple[str, ...]:
    check = result.check
    return (
        check.quantity,
        _value(result.measured, result.unit),
        _value(result.expected, result.unit),
        "-" if result.error is None else f"{result.error:.2g}",
        f"{check.tolerance:g}",
        verdict(result, complete=complete) + _occasion(result),
    )


def verdict(result: Result, *, complete: bool) -> str:
    """Return the verdict in words."""
    if result.verdict != "waiting":
        return result.verdict
    if not complete:
        return "not reached"
    if result.t is None:
        return "failed: never came"
    return (
        f"failed: came at {result.t:.4g} s, too near the end to be measured; lengthen the duration"
    )


def _value(value: float | None, unit: str) -> str:
    return "-" if value is None else f"{value:.7g} {unit}"


def _occasion(result: Result) -> str:
    """Return what distinguishes this check from others of the same quantity."""
    at = result.check.at
    when = "" if at is None else "at a time" if isinstance(at, Expression) else f"at {at.event}"
    about = ", ".join(part for part in (result.check.label, when) if part)
    return f" ({about})" if about else ""
