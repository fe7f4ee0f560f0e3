"""The page of the report: measurements put into templates."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from math import floor, isfinite, log10

from markupsafe import Markup
from matplotlib.figure import Figure

from sandbox.model.errors import SandboxError
from sandbox.physics.accuracy.trusted_digits import MOST_DIGITS
from sandbox.reporting import html_pages, plot_style
from sandbox.reporting.html_pages import inline
from validation.cost_of_accuracy import report as cost_report
from validation.cost_of_accuracy import work_precision_diagram as cost_figure
from validation.cost_of_accuracy.report import TARGETS, cost_to_reach, next_digit
from validation.cost_of_accuracy.scheme_and_rate_sweep import NAIVE, Sweep
from validation.effect_costs import cost_by_body_count_figure
from validation.effect_costs.command import rows
from validation.effect_costs.comparison_with_bare_engine import EffectCost, LevelCost
from validation.effect_costs.cost_growth import Growth
from validation.report import measurements
from validation.report.digest.case_outcomes import Cases, cases, chosen, share
from validation.report.digest.costs import Costs, Requests, costs, hooks
from validation.report.digest.grouping_by_chapter import by_chapter
from validation.report.digest.hard_cases import HardCases, hard_cases
from validation.stability import report as stability_report

SHOWN = 4
"""The number of diagrams that are visible at first; the others are folded away."""

LARGE = 1e4
"""The least ratio that is shown as a power of ten."""


@dataclass(slots=True)
class Report:
    """The content of a page; a part that is None was not measured."""

    quick: bool
    cases: Cases | None = None
    costs: Costs | None = None
    requests: Requests | None = None
    hard: HardCases | None = None
    levels: list[LevelCost] | None = None
    effects: list[EffectCost] = field(default_factory=list)
    growths: list[Growth] = field(default_factory=list)
    failures: dict[str, str] = field(default_factory=dict)
    """The reasons why parts are missing, by command."""
    environments: dict[str, Mapping[str, str]] = field(default_factory=dict)
    """The environments in which parts were measured, by command."""
    figures: dict[str, Figure] = field(default_factory=dict)
    """All figures, by file name."""

    @property
    def passed(self) -> bool:
        """Whether every part was measured, and every case holds."""
        failed = [part.failed for part in (self.cases, self.hard) if part is not None]
        return not self.failures and not any(failed)


def report(contents: Mapping[str, measurements.Content | SandboxError], *, quick: bool) -> Report:
    """Return a report of the measurements, or of the errors in their place, by command."""
    found = Report(quick=quick)
    for command, content in contents.items():
        try:
            if isinstance(content, SandboxError):
                raise content
            environment = measurements.environment(content)
            _ADDED[command](found, content)
            found.environments[command] = environment
        except SandboxError as error:
            found.failures[command] = str(error)
    return found


def _add_cases(found: Report, content: measurements.Content) -> None:
    found.cases = cases(measurements.outcomes(content))


def _add_costs(found: Report, content: measurements.Content) -> None:
    found.costs = costs(measurements.sweeps(content))
    found.requests = Requests(tuple(measurements.requests(content)))
    for sweep, _, _ in found.costs.rows:
        found.figures[figure_name(sweep.level)] = cost_figure.diagram(sweep)


def _add_hard_cases(found: Report, content: measurements.Content) -> None:
    found.hard = hard_cases(measurements.hard_cases(content))


def _add_effects(found: Report, content: measurements.Content) -> None:
    found.levels = measurements.level_costs(content)
    found.effects = measurements.effect_costs(content)
    found.growths = measurements.growths(content)
    if found.effects:
        found.figures["effects"] = cost_by_body_count_figure.diagram(found.effects)


_ADDED: Mapping[str, Callable[[Report, measurements.Content], None]] = {
    "run": _add_cases,
    "cost": _add_costs,
    "stability": _add_hard_cases,
    "effects": _add_effects,
}


def figure_name(level: str) -> str:
    """Return the file name of a level's diagram."""
    return "cost-" + level.replace("/", "-")


def html(found: Report) -> str:
    """Return the page."""
    templates = html_pages.environment("validation.report")
    templates.filters.update(
        sci=scientific,
        number=number,
        target=target,
        micro=micro,
        percent=percent,
        rows=rows,
        foldable=foldable,
        cost=cost,
        figure=stability_report.number,
        further=stability_report.further,
        ratio=cost_report.times,
        times=times,
        share=share,
        chosen=chosen,
        groupby_chapter=lambda pairs: by_chapter(pairs, lambda pair: pair[0]),
    )
    page = templates.get_template("report.html")
    return page.render(
        report=found,
        hooks=hooks(found.levels or []),
        diagrams=_diagrams(found),
        effects_figure=_effects_figure(found),
        shown=SHOWN,
        targets=TARGETS,
        reach=_reach,
        next_digit=next_digit,
        most_digits=MOST_DIGITS,
        order=cost_report.order_in_words,
        environments=_environments(found.environments),
        now=datetime.now(UTC),
    )


def foldable(level: str) -> Markup:
    """Return a level's name that may break after its chapter."""
    return Markup("/<wbr>").join(level.split("/"))


def scientific(value: float | None) -> str:
    """Return an error with two digits; in words if there is none."""
    if value is None or value != value:
        return "–"
    if not value:
        return "0"
    return f"{value:.1e}" if isfinite(value) else "∞"


def number(value: float) -> str:
    """Return a measured value with seven digits."""
    return f"{value:.7g}" if isfinite(value) else "–"


def percent(part: float) -> str:
    """Return a share in percent."""
    return f"{100 * part:.3g} %" if isfinite(part) else "∞"


def target(error: float) -> str:
    """Return a requested accuracy, such as 1e-3."""
    return f"{error:.0e}".replace("e-0", "e-")


def micro(seconds: float) -> str:
    """Return a time in µs, with its significant decimals."""
    if not isfinite(seconds):
        return "–"
    time = seconds * 1e6
    decimals = 2 if abs(time) < 10 else 1 if abs(time) < 100 else 0
    return f"{time:,.{decimals}f} µs".replace("-", "−")


def times(ratio: float) -> str:
    """Return a ratio as in prose: 12 times, 3.4 × 10⁹ times."""
    if ratio < LARGE:
        return f"{cost_report.two_digits(ratio)} times"
    exponent = floor(log10(ratio))
    return f"{ratio / 10**exponent:.1f} × 10{plot_style.superscript(exponent)} times"


def cost(seconds: float | None) -> str:
    """Return the cost of a second of the scene in ms."""
    return (
        "–" if seconds is None or not isfinite(seconds) else cost_report.two_digits(seconds * 1e3)
    )


def _reach(sweep: Sweep, target: float) -> float | None:
    return cost_to_reach([p for p in sweep.points if p.scheme != NAIVE], target)


def _diagrams(found: Report) -> list[tuple[Sweep, Markup]]:
    """Return the diagrams, starting with those that are always visible."""
    rows = found.costs.rows if found.costs else ()
    first = measurements.SAMPLE[:SHOWN]
    sweeps = sorted((sweep for sweep, _, _ in rows), key=lambda sweep: sweep.level not in first)
    return [
        (sweep, inline(found.figures[figure_name(sweep.level)], _title(sweep))) for sweep in sweeps
    ]


def _title(sweep: Sweep) -> str:
    """Return a description of a diagram."""
    ran = [p for p in sweep.points if isfinite(p.error)]
    least = {
        scheme: min(p.error for p in ran if p.scheme == scheme)
        for scheme in dict.fromkeys(p.scheme for p in ran)
    }
    errors = ", ".join(f"{scheme} {error:.1e}" for scheme, error in least.items())
    return f"{sweep.level}: error against computing time. Least error of each scheme: {errors}."


def _effects_figure(found: Report) -> Markup | None:
    if "effects" not in found.figures:
        return None
    slopes = ", ".join(
        f"{cost.effect} {cost.exponent:.2f}" for cost in found.effects if cost.exponent is not None
    )
    return inline(
        found.figures["effects"],
        f"Time of a step over the number of bodies, for each effect. Fitted exponents: {slopes}.",
    )


def _environments(
    environments: Mapping[str, Mapping[str, str]],
) -> Iterable[tuple[str, Mapping[str, str]]]:
    """Return each environment once, with the commands that ran in it."""
    found: list[tuple[list[str], Mapping[str, str]]] = []
    for command, environment in environments.items():
        same = next((commands for commands, other in found if other == environment), None)
        if same is None:
            found.append(([command], environment))
        else:
            same.append(command)
    return [(", ".join(commands), environment) for commands, environment in found]
