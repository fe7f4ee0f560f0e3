"""The page of the accuracy: the cost of another digit."""

from sandbox.app.pages.page import Desk, Page, PageCommand, imported


def _measure(desk: Desk) -> None:
    from sandbox.app.pages.accuracy.background_study import BackgroundStudy

    desk.worker(BackgroundStudy).measure_or_cancel(desk.session)


PAGE = Page(
    name="accuracy",
    caption="Accuracy",
    key="a",
    text="accuracy: what the next digit costs",
    panel=imported("sandbox.app.pages.accuracy.panel", "AccuracyPage"),
    worker=imported("sandbox.app.pages.accuracy.background_study", "BackgroundStudy"),
    commands=(PageCommand("measure", "A", "start or stop measuring error and cost", _measure),),
)
