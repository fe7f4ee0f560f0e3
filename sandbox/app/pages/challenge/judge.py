"""The judge of challenges: it holds every run against the goals, and keeps the stars."""

from sandbox.app.files.progress import Progress
from sandbox.app.runs.session import Session
from sandbox.app.words.language import later, say


class Judge:
    """Watches runs, and reports when one earns more stars than any before.

    Attributes
    ----------
    news
        Another object whenever stars were earned.
    hints
        How many hints were asked for, by the title of the level.
    """

    running = False

    def __init__(self) -> None:
        self.news = object()
        self.hints: dict[str, int] = {}
        self._progress = Progress()
        self._told: object = None  # the attempt that was judged last

    def stars(self, session: Session) -> int:
        """Return the most stars that the challenge of a session's level has earned."""
        return self._progress.stars(session.original.title)

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:  # noqa: ARG002
        """Judge a finished run; return its result, None if there is nothing to report."""
        found = session.attempt()
        if found is None or not found.complete or found is self._told:
            return None
        self._told = found
        title, before = session.original.title, self.stars(session)
        if not found.stars:
            return None
        message = later("{stars} of {most} stars")
        if 0 < before < found.stars:
            message = later("{stars} of {most} stars, more than before")
        message = say(message, stars=found.stars, most=found.most)
        lost = self._progress.earn(title, found.stars)
        self.news = object()
        return f"{message}; {lost}" if lost else message

    def cancel(self) -> None:
        """There is no work that could be ended."""

    def hint(self, session: Session) -> None:
        """Show one more hint."""
        title = session.original.title
        self.hints[title] = self.hints.get(title, 0) + 1
        self.news = object()
