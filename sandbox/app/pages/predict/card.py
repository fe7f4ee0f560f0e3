"""The card of a prediction: the question, the result, and explanations of the difference."""

from collections.abc import Sequence

import pygame

from sandbox.app.cards.checks import TOUCHED
from sandbox.app.cards.text_column import GAP, TextColumn
from sandbox.app.drawing import theme
from sandbox.app.drawing.text import Pen
from sandbox.app.pages.predict.neglected_effects import Trial, TrialProgress
from sandbox.app.pages.predict.prediction_outcome import LIMITS, Outcome
from sandbox.app.pages.predict.questions import when
from sandbox.app.runs.session import Session
from sandbox.app.words import formatting
from sandbox.app.words.language import later, say
from sandbox.app.words.typed_numbers import FACTORS
from sandbox.model.level import Check

NOTHING = later("This level states no closed form to predict.")
CHANGED = later(
    "The effects are changed: no formula describes this run. Reset them on the tab Effects."
)
NEVER = later("That did not happen in this run.")
NOTICED = 1e-4
"""The smallest relative change that is mentioned."""


def intro(pen: Pen, width: int, session: Session, *, possible: bool) -> pygame.Surface:
    """Draw the purpose of the page, or the reason why nothing can be predicted."""
    card = TextColumn(pen, width)
    card.heading(say("Predict, run, explain"))
    if possible:
        message = say("Choose what to predict. The run waits for your number.")
        card.text(message, 13, theme.DIM)
    else:
        card.text(say(CHANGED if session.changes else NOTHING), 14, theme.DIM)
    return card.drawn()


def question_text(
    pen: Pen, width: int, question: Check, title: str, unit: str, since: float | None
) -> pygame.Surface:
    """Draw a question by its title.

    While it is open, `since` is the time at which the run waits [s], and the possible forms of an
    answer are listed.
    """
    card = TextColumn(pen, width)
    card.heading(say("Your prediction"))
    card.text(title, 15, bold=True)
    name = f"{question.quantity} {when(question.at)}" if question.label else when(question.at)
    card.text(name, 13, theme.DIM)
    if since is not None:
        card.y += GAP
        if since:
            time = formatting.seconds(since)
            card.text(say("The run waits at t = {time}.", time=time), 12, theme.DIM)
        units = say(" or ").join([unit, *FACTORS.get(unit, {})]) or say("no unit")
        message = say("A number or a formula, such as 2*9.81; in {units}:", units=units)
        card.text(message, 12, theme.DIM)
    return card.drawn()


def refusal_text(pen: Pen, width: int, refusal: str) -> pygame.Surface:
    """Draw the reason why a typed text is no answer, or how to answer."""
    card = TextColumn(pen, width)
    if refusal:
        card.text(say(refusal), 13, theme.FAILED)
    else:
        card.text(say("Press Enter or Play to run it."), 12, theme.DIM)
    return card.drawn()


def result(
    pen: Pen, width: int, session: Session, outcome: Outcome | None, trials: Sequence[Trial],
    trying: TrialProgress | None,
) -> pygame.Surface:  # fmt: skip
    """Draw the result of a prediction, and the neglected effects that would change it."""
    card = TextColumn(pen, width)
    if outcome is None:
        over = session.failure is not None or session.world.steps >= session.end
        message = say(NEVER) if over else say("It runs …")
        card.text(message, 14, theme.NOTICE if over else theme.DIM)
    else:
        _verdict(card, outcome)
        _compared(card, outcome)
        if outcome.formula is None:
            card.y += GAP
            card.text(say(TOUCHED), 12, theme.DIM)
        else:
            _explained(card, outcome, trials, trying)
    return card.drawn()


def _verdict(card: TextColumn, outcome: Outcome) -> None:
    limit = outcome.limit
    good, far = theme.PASSED, theme.FAILED
    color = far if limit is None else good if limit <= LIMITS[1] else theme.NOTICE
    card.text(outcome.verdict, 20, color, bold=True)
    card.y += GAP


def _compared(card: TextColumn, outcome: Outcome) -> None:
    """Write the three values, and the differences of two of them from the simulated one."""
    heads = ("", say("value"), say("differs by"))
    card.columns([(head, theme.DIM) for head in heads], 12)
    rows = [
        (say("prediction"), outcome.predicted, _difference(outcome, outcome.predicted)),
        (say("formula"), outcome.formula, _difference(outcome, outcome.formula)),
        (say("simulation"), outcome.simulated, _asked_at(outcome)),
    ]
    for name, value, apart in rows:
        if value is not None:
            rounded = formatting.without_rounding(value, outcome.scale or 0.0)
            text = formatting.quantity(rounded, outcome.unit)
            card.columns([(name, theme.DIM), (text, theme.TEXT), (apart, theme.DIM)], 14)


def _asked_at(outcome: Outcome) -> str:
    """Return the time of the measurement, which can differ in a run changed by hand."""
    return "" if outcome.t is None else say("at {t}", t=formatting.seconds(outcome.t))


def _difference(outcome: Outcome, value: float | None) -> str:
    """Return the difference of a value from the simulated one; empty without a value."""
    if value is None:
        return ""
    apart = outcome.difference(value)
    if abs(apart) < 1e-9:
        return say("equal")
    far = formatting.share(apart) if outcome.scale else formatting.quantity(apart, outcome.unit, 3)
    return f"+{far}" if apart > 0 else far


def _explained(
    card: TextColumn, outcome: Outcome, trials: Sequence[Trial], trying: TrialProgress | None
) -> None:
    card.y += 8
    card.heading(say("What the level neglects"))
    if trying is not None:
        message = say("trying effects …")
        if trying.effect:
            message = say("trying {effect} …", effect=say(trying.effect))
        card.text(message, 13, theme.DIM)
    changing = [trial for trial in trials if _change(outcome, trial) > NOTICED]
    for trial in sorted(changing, key=lambda trial: -_change(outcome, trial)):
        _trial(card, outcome, trial)
    same = [trial.label for trial in trials if trial not in changing]
    if same:
        card.y += GAP
        card.text(say("No difference: {changes}.", changes="; ".join(same)), 12, theme.DIM)
    if not trials and trying is None:
        card.text(say("No other effect can be tried here."), 13, theme.DIM)


def _change(outcome: Outcome, trial: Trial) -> float:
    """Return the change of the predicted quantity by an effect, relative if possible."""
    if trial.before is None or trial.after is None:
        return 0.0 if trial.before is trial.after else float("inf")
    return abs(trial.after - trial.before) / (outcome.scale or 1.0)


def _trial(card: TextColumn, outcome: Outcome, trial: Trial) -> None:
    card.y += GAP
    card.text(trial.label, 14, bold=True)
    if trial.before is None or trial.after is None:
        card.text(say("then that never happens"), 13, indent=card.indent)
        return
    value = outcome.simulated + trial.after - trial.before
    change = _difference(outcome, value)
    card.columns(
        [(say("would make it"), theme.DIM), (formatting.quantity(value, outcome.unit), theme.TEXT),
         (change, theme.TEXT)], 13,
    )  # fmt: skip
    off = outcome.difference(outcome.predicted)
    explained = outcome.difference(value) / off if abs(off) > LIMITS[0] else 0.0
    if 0.05 <= explained < 2:  # beyond, the prediction is closer to the run without it
        message = say("accounts for {share:.0f} % of your difference", share=100 * explained)
        card.text(message, 12, theme.NOTICE, indent=card.indent)
