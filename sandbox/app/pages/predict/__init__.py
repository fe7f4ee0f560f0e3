"""The page of predictions: the user predicts a result before the run continues."""

from sandbox.app.pages.page import Page
from sandbox.app.pages.predict.panel import PredictPage
from sandbox.app.pages.predict.prediction_in_progress import PredictionWorker

PAGE = Page(
    name="predict",
    caption="Predict",
    key="q",
    text="predict a number, run, and see what explains a difference",
    panel=PredictPage,
    worker=PredictionWorker,
)
