"""The prediction in progress: the question, the answer, and the outcome."""

from typing import TYPE_CHECKING

from sandbox.app.background_process import BackgroundTask
from sandbox.app.observing.checks_of_unfinished_run import TimeShare
from sandbox.app.pages.predict.neglected_effects import Trial, TrialProgress, trials
from sandbox.app.pages.predict.prediction_outcome import Outcome, judged
from sandbox.app.pages.predict.questions import questions, unit_of
from sandbox.app.runs.session import Session
from sandbox.app.words.language import later, say
from sandbox.app.words.typed_numbers import read
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.level import Check
from sandbox.model.translatable_message import NOTHING, Message

if TYPE_CHECKING:
    from sandbox.model.expressions import Values

FIRST = later("Type your prediction first: the run waits for it (Q).")
PUT_OFF = later("The prediction is postponed: the run can go on.")
CHANGED = later("The level has changed, and so has the question.")


class PredictionWorker(BackgroundTask):
    """Locks a run until the user has predicted its result, and then judges the prediction."""

    def __init__(self) -> None:
        super().__init__()
        self._session: Session | None = None
        self._forget()

    def _forget(self) -> None:
        self._work.cancel()
        if self._session is not None:
            self._session.locked = False
        self.question: Check | None = None
        self.predicted: float | None = None
        """The answer in SI units; None while it is awaited."""
        self.typed = ""
        """The text in the field for the answer, which pressing Play submits."""
        self.refusal: Message = NOTHING
        """The reason why the typed text is no answer; empty if there is none."""
        self.outcome: Outcome | None = None
        self.trials: list[Trial] = []
        """The results of trying effects that the level neglects."""
        self.trying: TrialProgress | None = None
        """The effect being tried; None if there is none."""
        self._tried = False
        self._values: Values = {}
        self._world: object = None  # the run that is judged
        self.news = object()

    def forget_other_sessions(self, session: Session) -> None:
        """Forget what was asked in any other session: its level need not have the quantity."""
        if session is not self._session:
            self._forget()
            self._session = session

    def ask(self, session: Session, question: Check) -> None:
        """Lock the run until the question is answered.

        A run that has given the answer by now goes back to its start, where actions by hand are
        repeated, since the prediction is for this run.
        """
        self._forget()
        self._session, self.question, self._values = session, question, session.values
        session.playing = False
        self._lock(session, question)

    def _lock(self, session: Session, question: Check) -> None:
        """Lock the run at its present step, or at its start; if it is seeking, once it arrives."""
        if session.sought is None:
            if _is_known(question, session):
                session.rewind()
            session.locked, self.news = True, object()
        self._world = session.world

    def withdraw(self) -> None:
        """Withdraw the question, and unlock the run."""
        self._forget()

    def answer(self, session: Session, typed: str) -> bool:
        """Accept a prediction and let the run continue; return whether the text is one."""
        self.news = object()
        assert self.question is not None
        try:
            unit = unit_of(self.question, session.level)
            self.predicted = read(typed, unit, session.values)
        except ExpressionError as error:
            self.refusal = error.message
            return False
        self.refusal, session.locked = NOTHING, False
        self._judge_from_now_on(session, self.question, self.predicted)
        session.playing = session.failure is None
        return True

    def _judge_from_now_on(self, session: Session, question: Check, predicted: float) -> None:
        self._world, self.outcome = session.world, None
        self._time_share: TimeShare[Outcome | None] = TimeShare(
            lambda: judged(
                question, session.trace, predicted, formula_holds=not session.world.disturbed
            ),
            None,
        )

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:  # noqa: ARG002
        """Keep the run locked, or judge it; return a message for the user, or None."""
        self.forget_other_sessions(session)
        if self.question is None:
            return None
        if session.world is not self._world and self._outdated(session):
            self._forget()
            return say(CHANGED)
        if self.predicted is None:
            return self._keep_locked(session, self.question, watched=watched)
        if session.world is not self._world:
            self._judge_from_now_on(session, self.question, self.predicted)
        self._judge(session)
        if self.outcome and self.outcome.formula is not None and watched and not self._tried:
            self._try(session)
        self._collect_results()
        return None

    def _outdated(self, session: Session) -> bool:
        current = questions(session.level, session.values)
        return session.values != self._values or self.question not in current

    def _keep_locked(self, session: Session, question: Check, *, watched: bool) -> str | None:
        """Keep the run locked while the page is shown."""
        if not watched:
            self._forget()
            return say(PUT_OFF)
        if session.locked:
            self._world = session.world
        else:
            self._lock(session, question)
        if not session.playing:
            return None
        session.playing = False
        if not self.typed.strip():
            return say(FIRST)
        self.answer(session, self.typed)
        return None

    def _judge(self, session: Session) -> None:
        before = self.outcome
        self.outcome = self._time_share(session.world.steps + 1, hurried=session.playing)
        if self.outcome != before:
            self.news = object()

    def _try(self, session: Session) -> None:
        self._tried = True
        self._work.start(trials, session.resolved, session.values, self.question)
        self.trying, self.news = TrialProgress("", 0.0), object()

    def _collect_results(self) -> None:
        """Store new results."""
        was_running = self._work.running
        for finding in self._work.results():
            self.news = object()
            if isinstance(finding, TrialProgress):
                self.trying = finding
            else:
                self.trials.append(finding)
        if was_running and not self._work.running:
            self.trying, self.news = None, object()

    def cancel(self) -> None:
        """Cancel the work."""
        super().cancel()
        self.trying = None


def _is_known(question: Check, session: Session) -> bool:
    """Whether the run has given the answer to a question, or cannot give it any more."""
    trace, stopped = session.trace, session.branched or session.failure is not None
    return stopped or trace.t[-1] < session.t or judged(question, trace, 0.0) is not None
