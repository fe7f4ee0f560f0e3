"""Searches in the background for remedies for a run that failed."""

from sandbox.app.background_process import BackgroundTask
from sandbox.app.runs.session import Session
from sandbox.model.translatable_message import NOTHING, Message
from sandbox.physics.state.simulation_errors import BlockedError, BreakdownError, SimulationError


class RemedySearch(BackgroundTask):
    """Has remedies tried for the current run, once it has failed."""

    def __init__(self) -> None:
        super().__init__()
        self._failure: object = None  # the last one that was examined

    def follow(self, session: Session) -> None:
        """Start a search when the run has failed, and pass its results to the session."""
        failure = session.failure
        if failure is not self._failure:
            self._failure = failure
            self.cancel()
            if session.run.advice is not None:
                return
            if isinstance(failure, SimulationError) and not isinstance(
                failure, BreakdownError | BlockedError
            ):
                from sandbox.physics.advising import remedy_trials

                session.run.trying = True
                world = session.world
                scene = session.level, session.values, world.stepping, session.duration
                self._work.start(remedy_trials.advice_in_background, failure, *scene)
        if not session.run.trying:
            return
        from sandbox.physics.advising.remedy_trials import Advice

        found = Advice(NOTHING)
        for finding in self._work.results():
            found = finding
        if not (found.text or self._work.running):  # the search has ended without a result
            session.add_advice(Advice(Message("no remedy is known")))
        elif found.text:
            session.add_advice(found)
