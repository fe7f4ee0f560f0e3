"""A measure against a varied parameter: the curve chosen for each level, and the runs for it."""

from typing import NamedTuple

from sandbox.app.background_process import BackgroundTask
from sandbox.app.pages.experiment.background_parameter_sweep import (
    COUNT,
    Point,
    SamplingRefusal,
    count_values,
    sample,
)
from sandbox.app.pages.graph.chosen_quantities import offered
from sandbox.app.runs.session import Session
from sandbox.experiments import suggested_measures
from sandbox.model.translatable_message import NOTHING, Message

PATIENCE = 0.5  # s without a change before the runs start


class CurveChoice(NamedTuple):
    """The varied parameter, and the measure."""

    parameter: str
    measure: str


class CurveWorker(BackgroundTask):
    """Runs a level for values of a parameter, in the background."""

    def __init__(self) -> None:
        super().__init__()
        self._chosen: dict[str, CurveChoice] = {}
        self._scene: object = None
        self._measures: tuple[object, list[str]] | None = None  # of the last level
        self._forget()

    def _forget(self) -> None:
        self.points: list[Point] = []
        """The points so far, in the order of the parameter."""
        self.failure: Message = NOTHING
        """The reason why there are no more runs; empty if there is none."""
        self._waited, self._begun, self._count = 0.0, False, COUNT
        self.news = object()

    @property
    def share(self) -> float:
        """The share of the curve that is computed."""
        return len(self.points) / self._count

    def chosen(self, session: Session) -> CurveChoice | None:
        """Return the chosen curve, at first a suggested one; None without parameters."""
        level = session.level
        if not level.parameters:
            return None
        found = self._chosen.get(session.original.title)
        if self._measures is None or self._measures[0] is not level:
            self._measures = level, measures(session)
        offered = self._measures[1]
        if found and found.parameter in level.parameters and found.measure in offered:
            return found
        return CurveChoice(next(iter(level.parameters)), offered[0])

    def choose(
        self, session: Session, parameter: str | None = None, measure: str | None = None
    ) -> None:
        """Choose another curve."""
        now = self.chosen(session)
        if now is not None:
            found = CurveChoice(parameter or now.parameter, measure or now.measure)
            self._chosen[session.original.title] = found
            self.news = object()

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:
        """Start the runs of the chosen curve while the page is open, and store their results."""
        chosen = self.chosen(session)
        scene = _scene(session, chosen)
        if scene != self._scene:
            self._work.cancel()
            self._forget()
        self._scene = scene  # comparing identical objects takes no time
        self._waited += seconds
        if watched and chosen and not (self._begun or session.waiting) and self._waited > PATIENCE:
            self._begun = True
            self._count = count_values(session.resolved, chosen.parameter)
            self._work.start(sample, session.resolved, session.values, *chosen)
            self.news = object()
        self._collect_results()
        return None

    def _collect_results(self) -> None:
        """Store new results."""
        was_running = self._work.running
        for finding in self._work.results():
            self.news = object()
            if isinstance(finding, SamplingRefusal):
                self.failure = finding.reason
            else:
                self.points.append(finding)
                self.points.sort()
        if was_running and not self._work.running:
            self.news = object()
            if self.points and self.share < 1:
                self.failure = Message("more would take too long: try it with 'sandbox experiment'")


def measures(session: Session) -> list[str]:
    """Return the measures offered for a run."""
    return suggested_measures.measures(session.original, offered(session.level))


def _scene(session: Session, chosen: CurveChoice | None) -> object:
    """Return everything on which the curve depends, without the value of the varied parameter."""
    varied = chosen.parameter if chosen else ""
    rest = tuple((name, value) for name, value in session.values.items() if name != varied)
    return session.original, session.changes, session.world.stepping, rest, chosen
