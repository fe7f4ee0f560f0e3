"""The page of experiments: a result of the run as a function of a parameter."""

from sandbox.app.pages.experiment.panel import ExperimentPage
from sandbox.app.pages.experiment.parameter_curve import CurveWorker
from sandbox.app.pages.page import Page

PAGE = Page(
    name="experiment",
    caption="Experiment",
    key="y",
    text="experiment: a measure over all values of a parameter",
    panel=ExperimentPage,
    worker=CurveWorker,
)
