"""Films, made in another process while the window continues."""

from sandbox.app.background_process import BackgroundTask
from sandbox.app.film import Kind, film
from sandbox.app.pages.share.saving import path_for
from sandbox.app.runs.run_file import run_of
from sandbox.app.runs.session import Session
from sandbox.app.words.language import say


class FilmWorker(BackgroundTask):
    """Makes one film at a time."""

    def __init__(self) -> None:
        super().__init__()
        self.done = 0.0
        """The progress of the film, from 0 to 1."""
        self.message = ""
        """The message about the last film saved; empty if there is none, or a newer one."""

    def begin(self, session: Session, kind: Kind) -> str:
        """Start a film of the run so far, and return the message.

        If another film is being made, the message says that this one must wait. Raises
        `SandboxError` if its folder cannot be made or written to.
        """
        if self.running:
            return say("one film at a time: the next when this one is saved")
        path = path_for(session, f".{kind}")
        self.done, self.message, self.news = 0.0, "", object()
        self._work.start(film, run_of(session), path, kind, session.looking.seen_from)
        return say("filming {time:.3g} s of the run ...", time=session.t)

    def follow(self, session: Session, seconds: float, *, watched: bool) -> str | None:  # noqa: ARG002
        """Update the progress, and return the message once the film is saved."""
        message = None
        for found in self._work.results():
            self.news = object()
            if isinstance(found, str):
                message = self.message = found
            else:
                self.done = found
        return message
