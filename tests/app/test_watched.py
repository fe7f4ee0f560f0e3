"""The app shows the sources and losses of energy, and offers a remedy for a stopped run."""

from pathlib import Path
from typing import Any

import pygame
import pytest

from sandbox.app.cards.energy import ledger
from sandbox.app.cards.text_column import TextColumn
from sandbox.app.drawing.text import Pen
from sandbox.app.runs.session import Session
from sandbox.model import level_catalog
from sandbox.model.loading import load
from sandbox.model.translatable_message import Message
from sandbox.physics.advising.remedy_trials import Advice
from tests.app.person import Person
from tests.physics.scenes import GRAVITY, box, disc, floor, level, orbit


def test_the_books_are_kept_from_the_start() -> None:
    block = box((0, 0.25), velocity=[3, 0], friction=0.5)
    session = Session(
        level(
            {"block": block, "floor": floor(friction=1)}, {**GRAVITY, "contact": {}, "friction": {}}
        )
    )
    session.book(True)
    for _ in range(30):
        session.step()

    books = session.books.balance

    assert books.loss["friction"] > 1
    assert abs(books.unexplained) < 1e-12
    assert session.books.covered == "since the start, half a step ahead"


def test_a_body_that_is_put_elsewhere_opens_new_books() -> None:
    session = Session(level({"ball": disc((0, 5))}, GRAVITY))
    session.book(True)
    session.step()
    session.grab("ball", (0, 5))
    session.drag((0, 50))
    session.release()
    session.step()

    assert abs(session.books.balance.unexplained) < 1e-9


def test_a_run_that_stopped_runs_at_the_rate_that_is_advised() -> None:
    session = Session(orbit(speed=0.05))
    session.toggle()
    session.update(10, budget=10)
    assert session.failure is not None
    rate = session.advised
    assert rate is not None

    session.rerun(rate)

    assert session.playing
    assert session.advised is None
    assert session.world.stepping.rate == rate
    session.restart()
    assert session.world.stepping.rate == rate


SPRING = """{
  "format": 1, "title": "Stiff",
  "bodies": {"bob": {"shape": {"type": "disc", "radius": 0.1}, "mass": 1, "position": [1.1, 0]}},
  "joints": {"k": {"type": "spring", "ends": [[0, 0], "bob"], "stiffness": 1e5, "length": 1}}
}"""


def test_the_window_offers_a_rate_at_which_a_refused_level_holds(
    person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, SPRING)
    panels = person.window.panels
    assert person.window.session is None
    assert panels.offer is not None
    assert panels.offer.text == "Run at 633 Hz"

    person.click(panels.offer.rect)

    assert person.session.world.stepping.rate == 633
    assert panels.offer is None


def test_the_window_offers_a_rate_for_a_run_that_stopped(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, ORBIT)
    person.press(pygame.K_SPACE, " ")
    for _ in range(300):
        person.wait()
        if person.session.failure:
            break
    person.wait()
    assert person.session.run.trying
    assert person.session.advised is None  # what has not been tried is not offered
    person.window.advising.cancel()
    person.session.add_advice(Advice(Message("tried: at 2,611 Hz it holds"), 2611.0))
    person.wait()
    offer = person.window.panels.offer
    assert offer is not None
    assert str(person.session.failure).endswith("for a step; tried: at 2,611 Hz it holds")

    person.click(offer.rect)

    assert person.session.failure is None
    assert person.session.world.stepping.rate > 60
    assert person.session.playing


ORBIT = """{
  "format": 1, "title": "Fall",
  "effects": {"attraction": [{"mu": 1}]},
  "bodies": {"planet": {"shape": {"type": "disc", "radius": 0.05}, "mass": 1, "position": [1, 0],
                        "velocity": [0, 0.05]}}
}"""


def test_the_bars_tell_what_friction_took(person: Person) -> None:
    """The card of bars has one more row than without friction."""
    heights = []
    for name in ("newton/incline", "newton/friction-brings-to-rest"):
        session = Session(load(level_catalog.find(name)))
        heights.append(ledger(Pen(), 300, session.books.balance, "").height)
        person.window.open_level(name)
        person.wait()
    person.press(pygame.K_e, "e")

    assert person.window.panels.energy == "bars"
    assert heights[1] - heights[0] == Pen().height(13) + 1


@pytest.mark.parametrize(
    ("name", "ahead"), [("kinematics/uniform-acceleration", True), ("energy/figure-eight", False)]
)
def test_bars_that_are_read_in_the_middle_of_a_drift_say_so(
    person: Person, monkeypatch: pytest.MonkeyPatch, name: str, ahead: bool
) -> None:
    """A cart of 2 J has 2.025 J half a step later; a fourth-order step is read at its end."""
    told: list[str] = []
    text = TextColumn.text

    def noted(card: TextColumn, said: str, *rest: Any, **more: Any) -> None:  # noqa: ANN401
        told.append(said)
        text(card, said, *rest, **more)

    monkeypatch.setattr(TextColumn, "text", noted)
    person.window.open_level(name)
    person.press(pygame.K_e, "e")
    books = person.session.books

    later = books.balance.kinetic / books.energies.kinetic - 1
    assert (later > 0.01) is ahead
    assert ("since the start, half a step ahead" in told) is ahead
