"""A run waits for a prediction, and then prediction, formula and run are compared."""

from collections.abc import Sequence
from math import pi
from pathlib import Path
from typing import Any

import pygame
import pytest

from sandbox.app.cards.checks import TOUCHED
from sandbox.app.cards.text_column import TextColumn
from sandbox.app.drawing.text import Pen
from sandbox.app.drawing.theme import Color
from sandbox.app.pages.predict import card, neglected_effects
from sandbox.app.pages.predict.panel import PredictPage
from sandbox.app.pages.predict.prediction_in_progress import PredictionWorker
from sandbox.app.pages.predict.prediction_outcome import Outcome, judged
from sandbox.app.pages.predict.questions import questions, when
from sandbox.app.runs import run_player
from sandbox.app.runs.session import Session
from sandbox.app.words.formatting import seconds
from sandbox.app.words.language import say
from sandbox.app.words.typed_numbers import read
from sandbox.model.expression_compiler import ExpressionError
from sandbox.model.expressions import Expression
from sandbox.model.levels_with_changed_effects import Variation
from sandbox.physics.run import simulate
from tests.app import scenes
from tests.app.person import Person, until

AT_ONE = {"quantity": "ball.speed", "formula": "g*t", "tolerance": 1e-9, "at": 1.0}


def predicting(person: Person) -> PredictionWorker:
    return person.window.workers.of(PredictionWorker)


def until_tried(person: Person) -> None:
    """Watch until the run is over and all effects have been tried."""
    until(person, lambda: not person.session.playing and not predicting(person).running)


def answer(person: Person, typed: str) -> None:
    person.type(typed)
    person.press(pygame.K_RETURN)


@pytest.fixture
def asked(person: Person, tmp_path: Path) -> Person:
    """A person who is asked for the speed of a ball half way down."""
    person.open(tmp_path, scenes.falling())
    person.press(pygame.K_SPACE, " ")
    person.wait(0.2)
    person.press(pygame.K_q, "q")
    person.click(person.page(PredictPage).button.rect)
    return person


@pytest.fixture
def written(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Everything that is written on cards from now on."""
    texts: list[str] = []
    text, columns = TextColumn.text, TextColumn.columns

    def paragraph(card: TextColumn, told: str, *rest: Any, **more: Any) -> None:  # noqa: ANN401
        texts.append(told)
        text(card, told, *rest, **more)

    def row(card: TextColumn, cells: Sequence[tuple[str, Color]], size: int) -> None:
        texts.extend(told for told, _ in cells)
        columns(card, cells, size)

    monkeypatch.setattr(TextColumn, "text", paragraph)
    monkeypatch.setattr(TextColumn, "columns", row)
    return texts


@pytest.mark.sweep
def test_a_number_that_is_typed_beside_the_field_answers_the_question(asked: Person) -> None:
    """Digits open pages, and + and - change the speed, but not while a question is open."""
    page = asked.page(PredictPage)
    asked.window.panels.manager.set_focus_set(None)

    asked.type("-4.905")
    assert asked.page(PredictPage).field.get_text() == "-4.905"
    asked.press(pygame.K_RETURN)
    asked.wait(0.5)

    assert asked.page(PredictPage) is page
    assert page._predicting.predicted == pytest.approx(-4.905)
    asked.press(pygame.K_0, "0")
    assert asked.window.panels.page == "settings page"


def test_play_submits_the_number_that_is_typed(asked: Person) -> None:
    """It said "Type your prediction first" beside the number that had been typed."""
    page = asked.page(PredictPage)
    asked.type("-4.9")

    asked.click(asked.window.panels.controls.button("play").rect)

    assert page._predicting.predicted == pytest.approx(-4.9)
    assert asked.session.playing


@pytest.mark.sweep
def test_play_does_not_submit_what_is_no_number(asked: Person) -> None:
    asked.type("7 apples")

    asked.click(asked.window.panels.controls.button("play").rect)

    assert asked.page(PredictPage)._predicting.predicted is None
    assert asked.page(PredictPage)._predicting.refusal
    assert not asked.session.playing


def test_a_run_stands_where_it_is_until_something_is_predicted(asked: Person) -> None:
    present = asked.session.world.steps
    assert present > 0
    assert asked.window.panels.typing

    asked.press(pygame.K_ESCAPE)
    asked.press(pygame.K_SPACE, " ")
    asked.wait(0.2)
    assert asked.session.world.steps == present
    assert not asked.session.playing
    asked.press(pygame.K_RIGHT)
    assert asked.session.world.steps == present
    asked.session.go_to(30)
    asked.wait(0.2)
    assert asked.session.world.steps == present

    asked.press(pygame.K_r, "r")

    assert asked.session.locked
    assert asked.session.world.steps == 0


def test_the_time_at_which_a_run_waits_is_told(asked: Person, written: list[str]) -> None:
    asked.page(PredictPage).update()
    assert f"The run waits at t = {seconds(asked.session.t)}." in written

    written.clear()
    asked.session.restart()
    asked.page(PredictPage).update()
    assert not [text for text in written if "waits" in text]


@pytest.mark.parametrize("seconds", [1.0, 0.0], ids=["at-once", "in-later-frames"])
def test_after_going_back_the_rest_of_the_run_is_predicted(
    asked: Person, seconds: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    answer(asked, "5")
    until_tried(asked)
    assert asked.session.at_end
    asked.click(asked.page(PredictPage).button.rect)
    with monkeypatch.context() as slow:
        slow.setattr(run_player, "AT_ONCE", seconds)
        slow.setattr(run_player, "ON_THE_WAY", seconds)
        asked.session.go_to(21)
        asked.click(asked.page(PredictPage).button.rect)
        assert (asked.session.sought is None) == asked.session.locked == bool(seconds)
    asked.wait()

    assert asked.session.locked

    assert asked.session.world.steps == 21
    assert asked.session.later is not None
    answer(asked, "5.2")
    until_tried(asked)
    outcome = predicting(asked).outcome
    assert outcome is not None
    assert outcome.predicted == 5.2
    assert outcome.simulated == pytest.approx(5, rel=1e-9)


def test_a_run_that_has_branched_goes_back_to_its_start(asked: Person) -> None:
    """No check is graded after a branch, so the answer would never come."""
    asked.click(asked.page(PredictPage).button.rect)
    asked.session.branch({"g": 4})

    asked.click(asked.page(PredictPage).button.rect)

    assert asked.session.locked
    assert asked.session.world.steps == 0
    answer(asked, "2")
    until_tried(asked)
    outcome = predicting(asked).outcome
    assert outcome is not None
    assert outcome.t is not None
    assert outcome.simulated == pytest.approx(4 * outcome.t)


def test_a_number_lets_it_run_and_is_held_against_formula_and_run(asked: Person) -> None:
    answer(asked, "5.2")
    assert asked.session.playing

    until_tried(asked)

    outcome = predicting(asked).outcome
    assert outcome is not None
    assert outcome.predicted == 5.2
    assert outcome.formula == pytest.approx(5)
    assert outcome.simulated == pytest.approx(5, rel=1e-9)
    assert outcome.difference(5.2) == pytest.approx(0.04)
    assert outcome.verdict == "within 5 %"
    assert asked.session.at_end


def test_which_neglected_effect_would_explain_a_difference_is_told(
    asked: Person, written: list[str]
) -> None:
    answer(asked, "4.5")

    until_tried(asked)

    dragged = simulate(scenes.level(effects=DRAGGED)).columns["ball.speed"][30]
    found = {trial.label: trial for trial in predicting(asked).trials}
    assert found["with drag (linear 0.1)"].after == pytest.approx(dragged, rel=1e-6)
    assert found["with drag (linear 0.1)"].before == pytest.approx(5)
    explained = (5 - dragged) / 0.5
    assert f"accounts for {100 * explained:.0f} % of your difference" in written
    assert not predicting(asked).running
    assert predicting(asked).trying is None


DRAGGED = {"gravity": {"acceleration": [0, "-g"]}, "drag": {"linear": 0.1}}


def test_neither_formula_nor_value_is_told_before_the_prediction(
    person: Person, tmp_path: Path, written: list[str]
) -> None:
    person.open(tmp_path, scenes.falling())
    person.press(pygame.K_SPACE, " ")
    while person.session.playing:
        person.wait()
    person.press(pygame.K_q, "q")
    written.clear()

    person.click(person.page(PredictPage).button.rect)
    person.wait(0.2)
    told = " ".join([*written, *person.page(PredictPage)._names()])
    assert "half way" in told
    assert "g*t" not in told
    assert "5.0000 m/s" not in told
    answer(person, "1")
    until_tried(person)

    assert "5.0000 m/s" in written


@pytest.mark.parametrize("typed", ["", "nonsense", "5 kg", "2,5", "1/0", "g*", "5 5", "[1]"])
def test_nonsense_is_refused_and_the_run_goes_on_waiting(asked: Person, typed: str) -> None:
    present = asked.session.world.steps
    answer(asked, typed)
    asked.wait(0.1)

    assert predicting(asked).refusal
    assert asked.session.locked
    assert asked.session.world.steps == present
    assert asked.window.panels.typing


@pytest.mark.sweep
def test_after_nonsense_a_number_is_taken(asked: Person) -> None:
    answer(asked, "abc")
    for _ in "abc":
        asked.press(pygame.K_BACKSPACE)
    answer(asked, "g/2 m/s")
    until_tried(asked)

    outcome = predicting(asked).outcome
    assert outcome is not None
    assert outcome.verdict == "within 1 %"


@pytest.mark.parametrize(
    ("typed", "unit", "value"),
    [
        ("2*9.81", "m/s", 19.62),
        ("3.2 m/s", "m/s", 3.2),
        ("-3.2m/s", "m/s", -3.2),
        ("36 km/h", "m/s", 10),
        ("45 deg", "rad", pi / 4),
        ("45°", "rad", pi / 4),
        ("45*deg", "rad", pi / 4),
        ("pi/4", "rad", pi / 4),
        ("30 deg/s", "rad/s", pi / 6),
        ("9.81 m/s^2", "m/s²", 9.81),
        ("9.81 m/s**2", "m/s²", 9.81),
        ("2 kg*m/s", "kg·m/s", 2),
        ("2 kg m / s", "kg·m/s", 2),
        ("sqrt(2*m) m", "m", 2),
        ("2*m", "m", 4),
        ("150 cm", "m", 1.5),
        ("1e3 mm", "m", 1),
        ("5", "", 5),
        ("12 000.5 kg", "kg", 12000.5),
        ("2 .5 kg", "kg", 2.5),
        ("2.\n5", "kg", 2.5),
    ],
)
def test_a_number_may_have_its_unit_or_another_of_its_kind(
    typed: str, unit: str, value: float
) -> None:
    assert read(typed, unit, {"m": 2}) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    ("typed", "unit", "said"),
    [
        ("5 kg", "m/s", "'kg' is not a unit of this quantity: m/s or cm/s or km/h"),
        ("5 kg", "", "a number without a unit"),
        ("v0", "m/s", "'v0' is not known here; the parameters are m"),
        ("2,5", "m", "a decimal point is written ., not a comma"),
        ("  ", "m", "type a number first"),
        ("1/0", "m", "divides by zero"),
        ("5 m m", "m", "is not"),
        ("1 00", "m", "is not"),
        ("1 0000", "m", "is not"),
    ],
)
def test_what_is_no_answer_is_told_why(typed: str, unit: str, said: str) -> None:
    with pytest.raises(ExpressionError) as refused:
        read(typed, unit, {"m": 2})

    assert said in str(refused.value)


@pytest.mark.parametrize(
    ("predicted", "verdict"),
    [(10, "within 1 %"), (9.901, "within 1 %"), (10.4, "within 5 %"), (8.1, "within 20 %"),
     (12.1, "off"), (-10, "off")],
)  # fmt: skip
def test_a_verdict_says_how_close_a_prediction_was(predicted: float, verdict: str) -> None:
    level = scenes.level(checks=[AT_ONE])
    (question,) = questions(level, level.defaults)

    outcome = judged(question, simulate(level), predicted)

    assert outcome is not None
    assert outcome.verdict == verdict


def test_where_zero_is_expected_the_size_of_the_quantity_in_the_run_counts() -> None:
    ground = {"quantity": "ball.position.y", "formula": "5 - g*t**2/2", "tolerance": 1e-9, "at": 1}
    level = scenes.level(checks=[ground])
    (question,) = questions(level, level.defaults)

    outcome = judged(question, simulate(level), 0.2)

    assert outcome is not None
    assert outcome.scale == pytest.approx(5)
    assert outcome.verdict == "within 5 %"


def test_where_all_is_zero_the_difference_is_absolute() -> None:
    still = {"quantity": "ball.position.x", "formula": "0", "tolerance": 1e-9, "at": 1}
    level = scenes.level(checks=[still])
    (question,) = questions(level, level.defaults)

    outcome = judged(question, simulate(level), 0.5)

    assert outcome is not None
    assert outcome.scale is None
    assert outcome.verdict == "off"


def test_without_an_instant_the_end_of_the_run_is_asked_for() -> None:
    level = scenes.level(checks=[{key: AT_ONE[key] for key in AT_ONE if key != "at"}])
    (question,) = questions(level, level.defaults)

    outcome = judged(question, simulate(level), 10)

    assert when(question.at) == "at t = 1 s"
    assert outcome is not None
    assert outcome.simulated == pytest.approx(10)


def test_of_the_time_of_a_question_no_more_digits_are_told_than_matter() -> None:
    assert when(Expression(1.596376979305701)) == "at t = 1.5964 s"
    assert when(Expression("2*pi")) == "at t = 2*pi s"


def test_checks_that_do_not_apply_are_not_asked() -> None:
    level = scenes.level(checks=[{**AT_ONE, "valid_if": "g < 5"}])

    assert questions(level, level.defaults) == ()
    assert len(questions(level, {**level.defaults, "g": 2})) == 1


def test_a_level_without_checks_says_that_there_is_nothing_to_predict(
    person: Person, tmp_path: Path, written: list[str]
) -> None:
    person.open(tmp_path, scenes.falling(checks=[]))
    person.press(pygame.K_q, "q")

    assert not person.page(PredictPage).button.visible
    assert not person.page(PredictPage).list.visible
    assert card.NOTHING in written
    person.press(pygame.K_SPACE, " ")
    person.wait(0.2)
    assert person.session.world.steps > 0


def test_who_leaves_the_page_has_a_free_run_again(asked: Person) -> None:
    asked.press(pygame.K_ESCAPE)
    asked.press(pygame.K_o, "o")
    asked.press(pygame.K_SPACE, " ")
    asked.wait(0.2)

    assert not asked.session.locked
    assert asked.session.world.steps > 0
    assert predicting(asked).question is None


def test_the_button_puts_a_prediction_off(asked: Person) -> None:
    asked.click(asked.page(PredictPage).button.rect)

    assert not asked.session.locked
    assert asked.page(PredictPage).list.visible
    assert not asked.page(PredictPage).field.visible


def test_another_can_be_predicted_afterwards(asked: Person) -> None:
    answer(asked, "5")
    until_tried(asked)
    asked.click(asked.page(PredictPage).button.rect)
    asked.click(asked.page(PredictPage).button.rect)

    assert asked.session.locked
    assert asked.session.world.steps == 0
    assert predicting(asked).predicted is None


def test_a_change_of_a_parameter_ends_a_prediction(asked: Person) -> None:
    answer(asked, "5")
    asked.session.restart({"g": 2})
    asked.wait()

    assert predicting(asked).question is None
    assert not asked.session.locked


def test_a_prediction_holds_for_the_same_run_again(asked: Person) -> None:
    answer(asked, "5")
    until_tried(asked)
    before = predicting(asked).outcome
    asked.press(pygame.K_r, "r")
    assert predicting(asked).outcome is None
    asked.press(pygame.K_SPACE, " ")
    until_tried(asked)

    assert predicting(asked).outcome == before


@pytest.mark.sweep
def test_a_prediction_ends_with_its_level(asked: Person, tmp_path: Path) -> None:
    asked.open(tmp_path, scenes.falling(title="Another"))

    assert predicting(asked).question is None
    assert not asked.session.locked


def test_a_prediction_ends_with_its_level_if_the_next_has_no_such_quantity(asked: Person) -> None:
    """The page was laid out for the question of the level before, and the window ended."""
    asked.window.open_level("momentum/cradle")
    asked.wait(0.1)

    assert predicting(asked).question is None
    assert asked.page(PredictPage).list.item_list


def test_what_a_hand_did_before_or_while_it_is_asked_belongs_to_the_run(
    asked: Person, written: list[str]
) -> None:
    asked.session.restart()
    asked.session.grab("ball", (0, 5))
    asked.session.drag((1, 6))
    asked.session.release()
    assert asked.session.world.disturbed

    answer(asked, "5")
    until_tried(asked)

    outcome = predicting(asked).outcome
    assert outcome is not None
    assert outcome.formula is None
    # it fell from y = 6 at 10 m/s² for half a second
    assert outcome.simulated == pytest.approx(5)
    assert asked.session.world.snapshot.position[0].tolist() == pytest.approx([1, 1])
    assert say(TOUCHED) in written
    assert not predicting(asked).trials


def test_two_balls_that_were_lifted_are_still_when_the_last_ones_way_is_predicted(
    person: Person, written: list[str]
) -> None:
    person.window.open_level("momentum/cradle")
    person.wait()
    for ball in ("ball2", "ball1"):
        row = list(person.session.level.bodies).index(ball)
        x, y = person.session.world.snapshot.position[row]
        person.drag(person.on_screen((x, y)), person.on_screen((x - 0.5, y + 0.4)))
    lifted = person.session.world.snapshot.position[:2].copy()
    person.press(pygame.K_SPACE, " ")
    until(person, lambda: person.session.at_end)
    done = list(person.session.all_actions)

    person.press(pygame.K_q, "q")
    person.click(person.page(PredictPage).button.rect)

    assert person.session.world.steps == 0
    assert (person.session.world.snapshot.position[:2] == lifted).all()
    tip = person.page(PredictPage).button.tool_tip_text
    assert tip == "let the run go on without a prediction"  # that of Predict stayed
    answer(person, "1")
    assert person.session.playing
    person.wait(0.1)
    assert list(person.session.all_actions) == done
    until_tried(person)
    outcome = predicting(person).outcome
    assert outcome is not None
    assert outcome.formula is None
    assert outcome.t is not None
    assert outcome.simulated > 1.0  # m/s; when the two met again in the air the last one hung still
    assert f"at {outcome.t:.2f} s" in written


def test_what_is_impossible_is_left_out_of_what_is_tried() -> None:
    level = scenes.level(checks=[AT_ONE])
    (question,) = questions(level, level.defaults)

    found = list(neglected_effects.trials(level, level.defaults, question))

    told = [each.label for each in found if isinstance(each, neglected_effects.Trial)]
    assert any("drag" in text for text in told)
    assert not any("friction" in text for text in told)  # which needs contact


def test_an_effect_that_delays_an_instant_for_ever_is_told(pen: Pen, written: list[str]) -> None:
    outcome = Outcome(5.0, 5.0, 5.0, "m", 5.0)
    trial = neglected_effects.Trial((Variation("drag", settings={}),), 5.0, None)

    card.result(pen, 280, Session(scenes.level()), outcome, [trial], None)

    assert "then that never happens" in written
