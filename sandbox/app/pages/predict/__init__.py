"""The page of predictions: the user predicts a result before the run continues."""

from sandbox.app.pages.page import Page, imported

PAGE = Page(
    name="predict",
    caption="Predict",
    key="q",
    text="predict a number, run, and see what explains a difference",
    panel=imported("sandbox.app.pages.predict.panel", "PredictPage"),
    worker=imported("sandbox.app.pages.predict.prediction_in_progress", "PredictionWorker"),
)
