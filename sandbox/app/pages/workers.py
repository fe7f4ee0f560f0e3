"""The background workers of the pages."""

from collections.abc import Sequence

from sandbox.app.pages.page import OnStage, Page, W, Worker, worker
from sandbox.app.runs.session import Session


class Workers:
    """The workers of a window, with its lifetime."""

    def __init__(self, pages: Sequence[Page]) -> None:
        self._by_page = {page.command: page.worker() for page in pages if page.worker is not None}
        self.all: tuple[Worker, ...] = tuple(self._by_page.values())
        """The workers, one for each page that declares one."""
        self._on_stage = {
            page: worker for page, worker in self._by_page.items() if isinstance(worker, OnStage)
        }

    def of(self, kind: type[W]) -> W:
        """Return the worker of a kind; `LookupError` if no page declares it."""
        return worker(self.all, kind)

    def on_stage(self, page: str) -> OnStage | None:
        """Return the worker that handles the mouse on the stage while a page is open, or None."""
        return self._on_stage.get(page)

    @property
    def running(self) -> bool:
        """Whether a worker has something to do."""
        return any(each.running for each in self.all)

    @property
    def news(self) -> tuple[object, ...]:
        """The results of the workers; different objects whenever the display must change."""
        return tuple(each.news for each in self.all)

    def follow(self, session: Session, seconds: float, page: str) -> list[str]:
        """Let time pass [s] while a page is open, and return the messages."""
        told = (
            each.follow(session, seconds, watched=command == page)
            for command, each in self._by_page.items()
        )
        return [text for text in told if text is not None]

    def cancel(self) -> None:
        """Cancel all work."""
        for each in self.all:
            each.cancel()
