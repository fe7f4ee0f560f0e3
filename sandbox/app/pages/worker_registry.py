"""The background workers of the pages."""

from collections.abc import Mapping, Sequence
from functools import cached_property

from sandbox.app.pages.page import OnStage, Page, W, Worker
from sandbox.app.runs.session import Session


class Workers:
    """The workers of a window, with its lifetime; all are made when one is first asked for."""

    def __init__(self, pages: Sequence[Page]) -> None:
        self._pages = pages
        self._made: Mapping[str, Worker] = {}

    @cached_property
    def _by_page(self) -> Mapping[str, Worker]:
        """The workers, one for each page that declares one, by the command of the page."""
        made = {page.command: page.worker() for page in self._pages if page.worker is not None}
        self._made = made
        return made

    def of(self, kind: type[W]) -> W:
        """Return the worker of a kind; `LookupError` if no page declares it."""
        for each in self._by_page.values():
            if isinstance(each, kind):
                return each
        raise LookupError(f"no page declares {kind.__name__} as its worker")

    def made(self, kind: type[W]) -> W | None:
        """Return the worker of a kind; None if no worker has been asked for yet."""
        return self.of(kind) if self._made else None

    def on_stage(self, page: str) -> OnStage | None:
        """Return the worker that handles the mouse on the stage while a page is open, or None."""
        worker = self._made.get(page)
        return worker if isinstance(worker, OnStage) else None

    @property
    def running(self) -> bool:
        """Whether a worker has something to do."""
        return any(each.running for each in self._made.values())

    @property
    def news(self) -> tuple[object, ...]:
        """The results of the workers; different objects whenever the display must change."""
        return tuple(each.news for each in self._made.values())

    def follow(self, session: Session, seconds: float, page: str) -> list[str]:
        """Let time pass [s] while a page is open, and return the messages.

        No time passes before the first picture, which needs no worker.
        """
        workers = self._by_page if seconds else self._made
        messages = (
            each.follow(session, seconds, watched=command == page)
            for command, each in workers.items()
        )
        return [text for text in messages if text is not None]

    def cancel(self) -> None:
        """Cancel all work."""
        for each in self._made.values():
            each.cancel()
