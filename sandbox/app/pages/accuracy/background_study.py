"""The study of the run's accuracy: the results so far, and the work in progress."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from sandbox.app.background_process import BackgroundTask, Work
from sandbox.app.pages.effects import switching_effects
from sandbox.app.runs.session import Session
from sandbox.app.words import formatting
from sandbox.app.words.language import say
from sandbox.model.errors import SandboxError
from sandbox.model.translatable_message import NOTHING, Message
from sandbox.physics.accuracy import error_causes_and_costs
from sandbox.physics.accuracy.error_causes_and_costs import (
    CurrentSetting,
    ErrorBudget,
    Failed,
    Progress,
    WorkPrecisionPoint,
)
from sandbox.physics.accuracy.requested_accuracy import BUDGET, Setting
from sandbox.physics.accuracy.trusted_digits import Trust, least_known

if TYPE_CHECKING:
    from sandbox.physics.accuracy.candidate_settings import Offer

PATIENCE = 0.5  # s without a change before the work starts


CANCELLED = Message("the search for a setting has been cancelled")


class BackgroundStudy(BackgroundTask):
    """Studies a session in the background."""

    def __init__(self) -> None:
        super().__init__()
        self._scene: tuple[object, ...] = ()
        self._level: object = None
        self.target: float | None = None
        """The requested accuracy; None if none is."""
        self._sought: object = None  # the world for which a setting was searched
        self._offer: Offer | None = None
        self._forget()

    def _forget(self) -> None:
        self.points: list[WorkPrecisionPoint] = []
        """The errors and costs of other settings."""
        self.failure: Message = NOTHING
        """The reason why the work failed; empty if it did not."""
        self._forget_run()

    def _forget_run(self) -> None:
        self._waited, self._measured = 0.0, False
        self._asked = self._trust_sought = False
        self.here: CurrentSetting | None = None
        """The error and cost of the present setting; None while unknown."""
        self._splits: dict[int, ErrorBudget] = {}
        self._trust: dict[str, Trust] = {}
        self.progress: Progress | None = None
        """The progress of the work; None if there is none."""
        self.news = object()

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:
        """Study a session's run, and apply a setting that was found.

        Return its message; None if there is none. The study starts only while the page is open.
        """
        self._follow_scene(session, seconds, watched=watched)
        setting = self._collect_results()
        return None if setting is None else _play_with(session, setting)

    def _follow_scene(self, session: Session, seconds: float, *, watched: bool) -> None:
        """Discard results for another scene, and start the study of this one after a pause."""
        before, self._scene = self._scene, self._scene_of(session)
        if before != self._scene:  # comparing identical objects takes no time
            self._work.cancel()
            self._level = session.level
            self.target = session.level.stepping.accuracy
            self._forget()
        elif session.level is not self._level:
            self._work.cancel()
            self._level = session.level
            self._forget_run()
            offer, stepping = self._offer, session.world.stepping
            if offer and offer.stepping == stepping:
                self.here = CurrentSetting(stepping.scheme, stepping.rate, offer.error, offer.cost)
        self._waited += seconds
        if self._waited < PATIENCE or self.running:
            return
        if session.waiting and not session.failure:
            self._search_setting(session)
        elif watched and not (session.waiting or self._measured):
            self.measure(session)
        elif self._asked and not (session.waiting or self._trust_sought or self._trust):
            self._trust_sought = True
            self._start(error_causes_and_costs.split, session.resolved, session.values)

    def _search_setting(self, session: Session) -> None:
        """Search for the setting that a session waits for; give up if a search has failed."""
        if self._sought is session.world:
            session.give_up(self.failure or CANCELLED)
        else:
            self._sought = session.world
            self.seek(session, session.level.stepping.accuracy or 0.0, BUDGET)

    @staticmethod
    def _scene_of(session: Session) -> tuple[object, ...]:
        return session.original, session.changes, tuple(session.values.items())

    def measure(self, session: Session) -> None:
        """Start computing the missing results."""
        self._measured = True
        work = error_causes_and_costs.split if self.points else error_causes_and_costs.study
        self._start(work, session.resolved, session.values)

    def measure_or_cancel(self, session: Session) -> None:
        """Cancel the work if there is some, else start it."""
        if self.running:
            self.cancel()
        else:
            self.measure(session)

    def seek(
        self, session: Session, target: float, seconds: float = error_causes_and_costs.SEARCH
    ) -> None:
        """Start searching the cheapest setting that reaches an accuracy, for a limited time [s]."""
        self.target = target
        self._start(error_causes_and_costs.seek, session.resolved, session.values, target, seconds)

    def _start(self, work: Work, *arguments: object) -> None:
        self.failure, self.progress = NOTHING, Progress(0.0, "starting")
        self.news = object()
        self._work.start(work, *arguments)

    def cancel(self) -> None:
        """Cancel the work; it starts again on request, or when the session changes."""
        super().cancel()
        self._measured, self.progress = True, None

    def _collect_results(self) -> Setting | None:
        """Store new results, and return a setting that was found; None if there is none."""
        was_running, found = self._work.running, None
        for finding in self._work.results():
            self.news = object()
            if isinstance(finding, Setting):
                found = finding
                self._offer = finding.for_playing
            else:
                self._take(finding)
        if was_running and not self._work.running:
            self.progress, self.news = None, object()
            if not (found or self.here or self.failure):
                self.failure = Message("that took too long")
        return found

    def _take(self, finding: object) -> None:
        match finding:
            case Progress():
                self.progress = finding
            case CurrentSetting():
                self.here = finding
            case WorkPrecisionPoint():
                self.points.append(finding)
            case ErrorBudget():
                self._splits[finding.check] = finding
            case Trust():
                self._trust[finding.quantity] = finding
            case Failed(reason=reason):
                self.failure = reason

    def splits(self, session: Session) -> Mapping[int, ErrorBudget]:
        """Return the parts of the errors of the checks of the present run, by index."""
        return self._splits if self._is_current(session) else {}

    def trust(self, session: Session) -> Mapping[str, Trust]:
        """Return the accuracy of the quantities of the present run, by name."""
        return self._trust if self._is_current(session) and not session.world.disturbed else {}

    def ask_for_trust(self) -> None:
        """Let the accuracy of the quantities be found out, if nothing is known of it yet."""
        self._asked = True

    def least_known(self, session: Session) -> Trust | None:
        """Return the least accurate place; None if none is known."""
        return least_known(self.trust(session).values())

    def _is_current(self, session: Session) -> bool:
        """Return whether the results are for the present run."""
        return session.level is self._level and self._scene_of(session) == self._scene


def _play_with(session: Session, setting: Setting) -> str:
    """Play with a setting that was found, and return the message."""
    try:
        if session.waiting:
            session.settle(setting)
        else:
            switching_effects.play_with_stepping(session, setting.for_playing.stepping)
    except SandboxError as error:
        return say(error.message)
    return formatting.offered_setting(setting)
