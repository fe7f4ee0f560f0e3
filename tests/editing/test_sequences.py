"""After any sequence of edits the level loads, or the mistake is named, and all can be undone."""

from collections.abc import Callable, Iterable
from contextlib import suppress

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from sandbox.editing.draft import Draft
from sandbox.editing.edits import (
    bodies,
    challenges,
    checks_and_ghosts,
    copying,
    effects,
    field_values,
    joint_creation,
    mirroring,
    moving_and_aligning,
    pendulum_angle_parameter,
    resizing,
    rope_wrapping,
    slope_angle_parameter,
)
from sandbox.editing.renaming import rename
from sandbox.editing.snapping import snap_body
from sandbox.editing.suggested_checks import suggestions, with_suggestion
from sandbox.editing.written_out_shorthand import expanded
from sandbox.model import level_catalog
from sandbox.model.effects import EFFECTS
from sandbox.model.errors import SandboxError
from sandbox.model.joints import KINDS
from sandbox.model.json_positions import Path
from sandbox.model.level import Level
from sandbox.model.level_parts import expressions
from sandbox.model.loading import read

SMALL = [
    name for name in level_catalog.textbook() if level_catalog.find(name).stat().st_size < 3000
]
FIRST = [Draft.empty().text, *(expanded(read(level_catalog.find(name))) for name in SMALL)]

NUMBER = st.floats(-5, 5).map(lambda x: round(x, 2))
POINT = st.tuples(NUMBER, NUMBER)


class Hand:
    """Makes choices in a level, as a person would."""

    def __init__(self, data: st.DataObject, level: Level) -> None:
        self.level = level
        self._data = data

    def point(self) -> tuple[float, float]:
        return self._data.draw(POINT)

    def points(self, least: int) -> list[tuple[float, float]]:
        return self._data.draw(st.lists(POINT, min_size=least, max_size=6))

    def number(self) -> float:
        return self._data.draw(NUMBER)

    def body(self) -> str:
        return self._data.draw(st.sampled_from(sorted(self.level.bodies)))

    def bodies(self) -> list[str]:
        known = st.sampled_from(sorted(self.level.bodies))
        return self._data.draw(st.lists(known, min_size=1, max_size=3, unique=True))

    def pick(self) -> joint_creation.Pick:
        names = st.sampled_from([None, *sorted(self.level.bodies)])
        return joint_creation.Pick(self.point(), self._data.draw(names))

    def word(self, words: Iterable[str]) -> str:
        return self._data.draw(st.sampled_from(sorted(words)))

    def field(self) -> Path:
        found = sorted((path for path, _ in expressions(self.level)), key=str)
        return self._data.draw(st.sampled_from(found))


def drawn(text: str, hand: Hand) -> str:
    make = hand.word(("add_disc", "add_box"))
    return getattr(bodies, make)(text, hand.level, hand.point(), hand.point()).text


def outlined(text: str, hand: Hand) -> str:
    make = hand.word(("add_polygon", "add_surface"))
    return getattr(bodies, make)(text, hand.level, hand.points(3)).text


def taken_out(text: str, hand: Hand) -> str:
    return bodies.remove_parts(text, hand.level, hand.bodies())


def moved(text: str, hand: Hand) -> str:
    return moving_and_aligning.move(text, hand.level, hand.bodies(), hand.point())


def snapped(text: str, hand: Hand) -> str:
    names = hand.bodies()
    way = snap_body(hand.level, names, hand.point(), 0.5, 0.25)
    return moving_and_aligning.move(text, hand.level, names, way.point)


def turned(text: str, hand: Hand) -> str:
    return moving_and_aligning.turn(text, hand.level, hand.bodies(), hand.number())


def aligned(text: str, hand: Hand) -> str:
    if hand.number() > 0:
        return moving_and_aligning.align(text, hand.level, hand.bodies(), "left")
    return moving_and_aligning.distribute(text, hand.level, hand.bodies(), "y")


def resized(text: str, hand: Hand) -> str:
    name = hand.body()
    if resizing.handles(hand.level, name) and hand.number() > 0:
        return resizing.drag_handle(text, hand.level, name, 0, hand.point())
    return resizing.scale(text, hand.level, name, hand.number())


def mirrored(text: str, hand: Hand) -> str:
    return mirroring.mirror(text, hand.level, hand.bodies(), "x")


def duplicated(text: str, hand: Hand) -> str:
    return copying.duplicate(text, hand.level, hand.bodies(), hand.point()).text


def joined(text: str, hand: Hand) -> str:
    picks = [hand.pick() for _ in range(3)]
    return joint_creation.add_joint(text, hand.level, hand.word(KINDS), picks).text


def declared(text: str, hand: Hand) -> str:
    effect = hand.word(EFFECTS)
    change = effects.drop if effect in hand.level.effects.declared else effects.declare
    return change(text, hand.level, effect)


def typed(text: str, hand: Hand) -> str:
    words = ("1", "-2.50", "2*pi", "x", "", "1e99", "3m", "[1, 2]", "true")
    return field_values.set_field(text, hand.field(), hand.word(words))


def made_a_parameter(text: str, hand: Hand) -> str:
    path = hand.field()
    return field_values.make_parameter(text, path, field_values.parameter_name(hand.level, path))


def renamed(text: str, hand: Hand) -> str:
    return rename(text, ("bodies", hand.body()), hand.word(("a", "b1", "some_body", "t", "")))


def checked(text: str, hand: Hand) -> str:
    found = suggestions(hand.level)
    if found:
        return with_suggestion(text, hand.level, found[0])
    return checks_and_ghosts.set_ghost(text, hand.body(), (hand.number(), "t"))


def tilted(text: str, hand: Hand) -> str:
    return slope_angle_parameter.tilt(text, hand.level, hand.body())


def swung(text: str, hand: Hand) -> str:
    hanging = [
        name
        for name in hand.level.bodies
        if pendulum_angle_parameter.peg_of(hand.level, name) is not None
    ]
    if not hanging:
        return text
    return pendulum_angle_parameter.swing(text, hand.level, hand.word(hanging))


def wrapped(text: str, hand: Hand) -> str:
    names = [hand.body() for _ in range(3)]
    return rope_wrapping.wrap(text, hand.level, list(dict.fromkeys(names))).text


def challenged(text: str, hand: Hand) -> str:
    if hand.level.challenge is not None:
        return challenges.drop_challenge(text)
    return challenges.add_challenge(text, hand.level, hand.body(), "Go.", ("across", "upwards"))


def made_round(text: str, hand: Hand) -> str:
    name = hand.body()
    if hand.level.bodies[name].shape.type not in resizing.ROUND:
        return text
    kind = hand.word(resizing.ROUND)
    return resizing.rounded(text, hand.level, name, kind).text


FAMILIES: tuple[Callable[[str, Hand], str], ...] = (
    drawn,
    outlined,
    taken_out,
    moved,
    snapped,
    turned,
    aligned,
    resized,
    mirrored,
    duplicated,
    joined,
    declared,
    typed,
    made_a_parameter,
    renamed,
    checked,
    tilted,
    swung,
    wrapped,
    challenged,
    made_round,
)


def loads_or_says_why(draft: Draft) -> bool:
    """Whether it is a level, or each of its mistakes is named at its place."""
    return draft.level is not None or all(m.path and m.line for m in draft.mistakes)


@pytest.mark.sweep
@settings(max_examples=60, suppress_health_check=list(HealthCheck))
@given(st.data())
def test_a_level_that_was_edited_loads_or_says_why_and_all_is_undone(data: st.DataObject) -> None:
    first = data.draw(st.sampled_from(FIRST))
    draft = Draft.of(first)
    for edit in data.draw(st.lists(st.sampled_from(FAMILIES), min_size=1, max_size=6)):
        if draft.level is None:
            break
        try:
            text = edit(draft.text, Hand(data, draft.level))
        except SandboxError:  # whoever edits is told
            continue
        draft.change(text, edit.__name__)
        assert loads_or_says_why(draft)
    last = draft.text
    while draft.undo() is not None:
        pass
    assert draft.text == first
    while draft.redo() is not None:
        pass
    assert draft.text == last


@pytest.mark.parametrize("edit", FAMILIES, ids=lambda edit: edit.__name__)
@settings(max_examples=6, suppress_health_check=list(HealthCheck))
@given(st.data())
def test_every_edit_begins_anywhere(edit: Callable[[str, Hand], str], data: st.DataObject) -> None:
    draft = Draft.of(data.draw(st.sampled_from(FIRST)))
    assert draft.level is not None
    with suppress(SandboxError):
        draft.change(edit(draft.text, Hand(data, draft.level)), "edit")
    assert loads_or_says_why(draft)
