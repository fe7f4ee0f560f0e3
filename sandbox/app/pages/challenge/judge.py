"""The judge of challenges, which compares every run with the goals, and keeps the stars."""

from sandbox.app.files.challenge_stars import ChallengeStars
from sandbox.app.pages.page import IdleWorker
from sandbox.app.runs.session import Session
from sandbox.app.words.language import later, say


class Judge(IdleWorker):
    """Watches runs, and reports the stars that they earn."""

    def __init__(self) -> None:
        super().__init__()
        self.hints: dict[str, int] = {}
        """The number of hints shown, by the title of the level."""
        self._progress = ChallengeStars()
        self._told: object = None  # the last attempt that was judged

    def stars(self, session: Session) -> int:
        """Return the largest number of stars earned in the challenge of a session's level."""
        return self._progress.stars(session.original.title)

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:  # noqa: ARG002
        """Judge a finished run, and return the result; None if there is nothing to report."""
        found = session.attempt()
        if found is None or not found.complete or found is self._told:
            return None
        self._told = found
        title, before = session.original.title, self.stars(session)
        if not found.stars:
            return None
        if session.repeats:
            message = later("{stars} of {most} stars; a run from a file earns none of them")
            return say(message, stars=found.stars, most=found.possible_stars)
        message = later("{stars} of {most} stars")
        if 0 < before < found.stars:
            message = later("{stars} of {most} stars, more than before")
        message = say(message, stars=found.stars, most=found.possible_stars)
        lost = self._progress.earn(title, found.stars)
        self.news = object()
        return f"{message}; {lost}" if lost else message

    def hint(self, session: Session) -> None:
        """Show another hint."""
        title = session.original.title
        self.hints[title] = self.hints.get(title, 0) + 1
        self.news = object()
