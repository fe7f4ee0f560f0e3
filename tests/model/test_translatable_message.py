"""Messages: English texts that can be translated later, and elsewhere."""

import copy
import pickle
from collections.abc import Iterator

import pytest

from sandbox.model.errors import LevelError, SandboxError
from sandbox.model.loading import parse
from sandbox.model.translatable_message import NOTHING, Message, both, either, joined, word
from sandbox.physics.state.simulation_errors import SimulationError


def test_a_message_is_its_english_text() -> None:
    message = Message("'{name}' is {value:g} {unit}", name="m", value=2.50, unit="kg")

    assert message == "'m' is 2.5 kg"
    assert str(message) == f"{message}" == "'m' is 2.5 kg"
    assert (message.template, message.values["value"]) == ("'{name}' is {value:g} {unit}", 2.5)


def test_braces_are_braces_where_there_are_no_values() -> None:
    assert Message("must be an object, {...}") == "must be an object, {...}"


def test_a_message_without_words_is_false() -> None:
    assert not NOTHING
    assert not joined([], "; ")


def test_names_are_listed_as_messages() -> None:
    assert either(["a", "b", "c"]) == "a or b or c"
    assert both(["a"]) == "a"
    assert both([Message("its checks"), Message("what is recorded")]) == (
        "its checks and what is recorded"
    )
    assert joined([Message("{n} m", n=1), word("wire")], " × ") == "1 m × wire"


@pytest.mark.parametrize("elsewhere", [lambda m: pickle.loads(pickle.dumps(m)), copy.deepcopy])
def test_a_message_keeps_its_parts_on_the_way_to_another_process(elsewhere: object) -> None:
    assert callable(elsewhere)
    inner = Message("the spring '{name}'", name="s")
    message = elsewhere(Message("{cause} needs a 'rate' of {least:,}", cause=inner, least=9))

    assert message == "the spring 's' needs a 'rate' of 9"
    assert message.template == "{cause} needs a 'rate' of {least:,}"
    assert message.values["cause"].values == {"name": "s"}


def _raised() -> Iterator[SandboxError]:
    yield SimulationError("s", 1.5, Message("'{name}' parted", name="s"), hint=Message("wait"))
    yield SandboxError(Message("the file {path} is gone", path="a"))
    try:
        parse('{"format": 2, "titel": 1}')
    except LevelError as error:
        yield error


@pytest.mark.parametrize("error", list(_raised()), ids=lambda error: type(error).__name__)
def test_an_error_keeps_its_message_on_the_way_to_another_process(error: SandboxError) -> None:
    there = pickle.loads(pickle.dumps(error))

    assert str(there) == str(error) == error.message
    assert there.message.template == error.message.template
    assert there.message.values.keys() == error.message.values.keys()
