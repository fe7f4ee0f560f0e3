"""The search for what helps a run that had to stop, in the background."""

from sandbox.app.background import Background
from sandbox.app.runs.session import Session
from sandbox.model.message import NOTHING, Message
from sandbox.physics.advising import remedies
from sandbox.physics.advising.remedies import Advice
from sandbox.physics.state.errors import BreakdownError, SimulationError


class Advising:
    """Has remedies tried for the run that is shown, once it has stopped."""

    def __init__(self) -> None:
        self._work = Background()
        self._failure: object = None  # what was last looked into

    @property
    def running(self) -> bool:
        """Whether something is being tried."""
        return self._work.running

    def follow(self, session: Session) -> None:
        """Start a search when a run has stopped; pass its results to the session."""
        failure = session.failure
        if failure is not self._failure:
            self._failure = failure
            self.cancel()
            if session.run.advice is not None:
                return
            if isinstance(failure, SimulationError) and not isinstance(failure, BreakdownError):
                session.run.trying = True
                world = session.world
                scene = session.level, session.values, world.stepping, session.duration
                self._work.start(remedies.findings, failure, *scene)
        if not session.run.trying:
            return
        found = Advice(NOTHING)
        for finding in self._work.found():
            found = finding
        if not (found.text or self._work.running):  # it has ended without any
            session.take(Advice(Message("no remedy is known")))
        elif found.text:
            session.take(found)

    def cancel(self) -> None:
        """End the work."""
        self._work.cancel()
