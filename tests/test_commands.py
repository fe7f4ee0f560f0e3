"""Every registered command, of the sandbox and of its validation."""

from pathlib import Path
from types import ModuleType

import pytest
import typer
from typer.testing import CliRunner

from sandbox.cli import commands as playing
from validation import cli as validating

REGISTERS = [playing, validating]
COMMANDS = [(register, module) for register in REGISTERS for module in register.COMMANDS]
NOT_COMMANDS = {"__init__", "options"}

every_command = pytest.mark.parametrize(
    ("register", "module"), COMMANDS, ids=[module.__name__ for _, module in COMMANDS]
)


def called(module: ModuleType) -> str:
    return module.__name__.rpartition(".")[2]


def invoke(register: ModuleType, *arguments: str) -> tuple[int, str]:
    """Return the exit status and the output."""
    assert isinstance(register.app, typer.Typer)
    result = CliRunner().invoke(register.app, arguments)
    assert result.exception is None or isinstance(result.exception, SystemExit)
    return result.exit_code, result.output


@pytest.mark.parametrize("register", REGISTERS, ids=lambda register: register.__name__)
def test_every_module_of_commands_is_registered(register: ModuleType) -> None:
    assert register.__file__ is not None
    modules = {path.stem for path in Path(register.__file__).parent.glob("*.py")} - NOT_COMMANDS

    forgotten = modules - {called(module) for module in register.COMMANDS}
    assert not forgotten, f"name {forgotten} in COMMANDS, {register.__file__}"


@every_command
def test_a_command_is_listed_in_the_help_with_what_it_does(
    register: ModuleType, module: ModuleType
) -> None:
    status, said = invoke(register, "--help")

    assert status == 0
    first = module.command.__doc__.splitlines()[0]
    (line,) = (line for line in said.splitlines() if line.startswith(f"  {called(module)} "))
    assert first.startswith(line.split(maxsplit=1)[1].removesuffix("..."))


@every_command
def test_a_command_explains_itself(register: ModuleType, module: ModuleType) -> None:
    status, said = invoke(register, called(module), "--help")

    assert status == 0
    assert "Usage:" in said
    assert " ".join(module.command.__doc__.splitlines()[0].split()) in " ".join(said.split())
    undocumented = [line for line in said.splitlines() if line.strip().startswith("--")]
    assert all(len(line.split()) > 1 for line in undocumented)


@every_command
def test_an_option_that_does_not_exist_is_wrong_usage(
    register: ModuleType, module: ModuleType
) -> None:
    status, said = invoke(register, called(module), "--no-such-option")

    assert status == 2
    assert "--no-such-option" in said


@pytest.mark.parametrize("register", REGISTERS, ids=lambda register: register.__name__)
def test_a_command_that_does_not_exist_is_wrong_usage(register: ModuleType) -> None:
    status, said = invoke(register, "no-such-command")

    assert status == 2
    assert "no-such-command" in said
