"""Every registered command, of the sandbox and of its validation."""

from inspect import getmembers, isfunction
from types import ModuleType

import pytest
import typer
from typer.testing import CliRunner

from sandbox.cli import commands as playing
from sandbox.cli.commands import levels, runs, window_and_pictures
from validation import cli as validating

REGISTERS = [playing, validating]
COMMANDS = {
    (register, str(command.name)): command.callback
    for register in REGISTERS
    for command in register.app.registered_commands
}
NOT_COMMANDS = {"uncollected", "of_levels", "command", "validation"}

every_command = pytest.mark.parametrize(
    ("register", "name"), COMMANDS, ids=[name for _, name in COMMANDS]
)


def purpose(register: ModuleType, name: str) -> str:
    """Return the first line of a command's docstring."""
    return (COMMANDS[register, name].__doc__ or "").splitlines()[0]


def invoke(register: ModuleType, *arguments: str) -> tuple[int, str]:
    """Return the exit status and the output."""
    assert isinstance(register.app, typer.Typer)
    result = CliRunner().invoke(register.app, arguments)
    assert result.exception is None or isinstance(result.exception, SystemExit)
    return result.exit_code, result.output


@pytest.mark.parametrize("module", [levels, window_and_pictures, runs, validating])
def test_every_function_that_declares_a_command_is_registered(module: ModuleType) -> None:
    functions = getmembers(module, isfunction)
    own = {name for name, function in functions if function.__module__ == module.__name__}

    register = validating if module is validating else playing
    known = {name for where, name in COMMANDS if where is register}
    forgotten = {name.rstrip("_") for name in own - NOT_COMMANDS} - known
    place = "COMMANDS, sandbox/cli/commands/__init__.py" if register is playing else module.__file__
    assert not forgotten, f"add {forgotten} to {place}"


@every_command
def test_a_command_is_listed_in_the_help_with_what_it_does(register: ModuleType, name: str) -> None:
    status, said = invoke(register, "--help")

    assert status == 0
    (line,) = (line for line in said.splitlines() if line.startswith(f"  {name} "))
    assert purpose(register, name).startswith(line.split(maxsplit=1)[1].removesuffix("..."))


@every_command
def test_a_command_explains_itself(register: ModuleType, name: str) -> None:
    status, said = invoke(register, name, "--help")

    assert status == 0
    assert "Usage:" in said
    assert " ".join(purpose(register, name).split()) in " ".join(said.split())
    undocumented = [line for line in said.splitlines() if line.strip().startswith("--")]
    assert all(len(line.split()) > 1 for line in undocumented)


@every_command
def test_an_option_that_does_not_exist_is_wrong_usage(register: ModuleType, name: str) -> None:
    status, said = invoke(register, name, "--no-such-option")

    assert status == 2
    assert "--no-such-option" in said


@pytest.mark.parametrize("register", REGISTERS, ids=lambda register: register.__name__)
def test_a_command_that_does_not_exist_is_wrong_usage(register: ModuleType) -> None:
    status, said = invoke(register, "no-such-command")

    assert status == 2
    assert "no-such-command" in said
