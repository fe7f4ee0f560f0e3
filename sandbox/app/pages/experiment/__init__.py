"""The page of experiments: a result of the run as a function of a parameter."""

from sandbox.app.pages.page import Page, imported

PAGE = Page(
    name="experiment",
    caption="Experiment",
    key="y",
    text="experiment: a measure over all values of a parameter",
    panel=imported("sandbox.app.pages.experiment.panel", "ExperimentPage"),
    worker=imported("sandbox.app.pages.experiment.parameter_curve", "CurveWorker"),
)
