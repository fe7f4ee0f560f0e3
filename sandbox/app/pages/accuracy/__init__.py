"""The page of the accuracy: the cost of another digit."""

from sandbox.app.pages.accuracy.background_study import Studying
from sandbox.app.pages.accuracy.panel import AccuracyPage
from sandbox.app.pages.page import Desk, Page, PageCommand


def _measure(desk: Desk) -> None:
    desk.worker(Studying).measure_or_cancel(desk.session)


PAGE = Page(
    name="accuracy",
    caption="Accuracy",
    key="a",
    text="accuracy: what the next digit costs",
    panel=AccuracyPage,
    worker=Studying,
    commands=(PageCommand("measure", "A", "start or stop measuring error and cost", _measure),),
)
