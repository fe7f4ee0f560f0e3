"""The cost of effects over the number of bodies, as a figure."""

from collections.abc import Sequence
from itertools import cycle

from matplotlib.figure import Figure

from sandbox.reporting import plot_style
from validation.effect_costs.comparison_with_bare_engine import EffectCost

MICRO = 1e6


def diagram(costs: Sequence[EffectCost]) -> Figure:
    """Return a log-log figure of a step's time over the number of bodies, a line per effect."""
    with plot_style.style():
        figure = Figure(figsize=(6.4, 4.4), layout="constrained")
        figure.suptitle("A step with an effect, over the number of bodies", fontsize=10)
        axes = figure.subplots()
        looks = zip(
            costs,
            *map(cycle, (plot_style.COLOURS, plot_style.MARKERS, plot_style.DASHES)),
            strict=False,
        )
        for cost, color, marker, dashes in looks:
            axes.plot(
                cost.bodies, [seconds * MICRO for seconds in cost.step_seconds],
                color=color, marker=marker, linestyle=dashes, markersize=4, linewidth=1.2,
                label=_label(cost),
            )  # fmt: skip
        plot_style.logarithmic(axes)
        axes.set(xlabel="bodies", ylabel="µs a step")
        plot_style.legend_below(figure, axes, columns=3)
    return figure


def _label(cost: EffectCost) -> str:
    return cost.effect if cost.exponent is None else f"{cost.effect}: n^{cost.exponent:.2f}"
