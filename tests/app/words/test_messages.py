"""Messages from below the window, errors above all, are said in its language."""

import ast
import pickle
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import sandbox
from sandbox.app.translatable_texts import has_words
from sandbox.app.words import language
from sandbox.cli.update_translations import said_in
from sandbox.model.errors import LevelError
from sandbox.model.loading import parse
from sandbox.model.translatable_message import Message
from sandbox.physics.state.simulation_errors import SimulationError, way_out

MAKERS = {"Message", "word"}
"""What makes a message, of which a catalogue has the template."""

OURS = re.compile("(Sandbox|Level|Expression|Simulation)Error").search
"""Finds the errors that have a message."""


def calls() -> Iterator[tuple[str, ast.Call]]:
    """Yield where messages are made that the window may show: errors accept no others."""
    for path in said_in(Path(sandbox.__file__).parent):
        if path.parts[-2:] not in {("model", "translatable_message.py"), ("model", "errors.py")}:
            for node in ast.walk(ast.parse(path.read_text("utf-8"))):
                if isinstance(node, ast.Call) and makes_a_message(node):
                    yield f"{path.name}:{node.lineno}", node


def makes_a_message(call: ast.Call) -> bool:
    """Whether a call makes a message, or an error with one."""
    match call:
        case ast.Call(func=ast.Name(id="Message")):
            return True
        case ast.Call(func=ast.Name(id=name), args=[ast.Constant(value=str()), *_]):
            return name.endswith("Error")
    return False


def bare(value: ast.AST) -> Iterator[str]:
    """Yield the texts of a value that are in no message."""
    if isinstance(value, ast.Call) and ast.unparse(value.func) in MAKERS:
        return
    if isinstance(value, ast.Constant) and isinstance(value.value, str) and has_words(value.value):
        yield value.value
    inner = (child for child in ast.iter_child_nodes(value) if not isinstance(value, ast.Subscript))
    for child in inner:
        yield from bare(child)


def test_every_message_has_its_template_in_the_sources_where_catalogues_are_made_from() -> None:
    found = list(calls())
    strange = [where for where, call in found if not isinstance(call.args[0], ast.Constant)]

    assert len(found) > 500
    assert strange == []


def test_no_value_of_a_message_is_english() -> None:
    """A value in a translated sentence must be a message itself, or come from the level."""
    found = [
        f"{where}: {said}"
        for where, call in calls()
        for keyword in call.keywords
        if keyword.arg != "last"  # a key, as it stands in files
        for said in bare(keyword.value)
    ]

    assert found == []


def test_what_is_looked_for_in_the_sources_is_found() -> None:
    code = 'Message("{a} {b}", a=x or "none", b=f"in {y[\'key\']} of {Message(\'z\')}")'
    call = ast.parse(code, mode="eval").body
    assert isinstance(call, ast.Call)

    assert [said for keyword in call.keywords for said in bare(keyword.value)] == [
        "none",
        "in ",
        " of ",
    ]


def handlers() -> Iterator[tuple[str, ast.ExceptHandler]]:
    """Yield where the window catches what it tells a person."""
    for path in sorted((Path(sandbox.__file__).parent / "app").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.ExceptHandler) and node.type and OURS(ast.unparse(node.type)):
                yield path.name, node


def test_no_error_is_shown_by_the_window_as_it_stands() -> None:
    """It is translated: `say(error.message)`, or as a value of another message."""
    found = list(handlers())
    shown = [
        f"{name}: {ast.unparse(node)}"
        for name, handler in found
        for node in ast.walk(handler)
        if ast.unparse(node) == f"str({handler.name})"
        or (isinstance(node, ast.FormattedValue) and ast.unparse(node.value) == handler.name)
    ]

    assert len(found) > 20
    assert shown == []


@pytest.fixture
def _german() -> Iterator[None]:
    language.use("de")
    yield
    language.use(language.ENGLISH)


@pytest.mark.usefixtures("_german")
def test_a_run_that_had_to_stop_elsewhere_is_told_in_german() -> None:
    reason = Message("the joint '{name}' has parted by {gap:.3g} m", name="rod", gap=0.0123)
    found = SimulationError("rod", 1.5, reason, hint=way_out(12345.0, 240.0))
    error = pickle.loads(pickle.dumps(found))

    assert language.say(error.message) == (
        "angehalten bei t = 1.5 s: die Verbindung „rod“ klafft um 0.0123 m auseinander;"
        " eine höhere „rate“ hilft vielleicht: 12\N{NO-BREAK SPACE}345 statt 240"
    )
    assert language.say("no film: {error}", error=error).endswith("statt 240")
    assert str(error) == (
        "stopped at t = 1.5 s: the joint 'rod' has parted by 0.0123 m;"
        " a higher 'rate' may help: 12,345, not 240"
    )


@pytest.mark.usefixtures("_german")
def test_every_mistake_of_a_level_is_told_in_german() -> None:
    text = '{"format": 1, "title": "", "duration": "2s", "effects": {"gravitee": {}}, "bodies": {}}'
    with pytest.raises(LevelError) as caught:
        parse(text)

    assert [language.say(mistake.unplaced) for mistake in caught.value.mistakes] == [
        'title: darf nicht leer sein (gefunden: "")',
        "duration: „2s“ ist keine Rechnung; ein Produkt schreibt man 2*m, nicht 2m",
        "effects.gravitee: unbekannter Effekt „gravitee“; ist „gravity“ gemeint?",
        "bodies: hat 0 Einträge, braucht aber mindestens 1",
    ]
