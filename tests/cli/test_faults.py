"""Whatever is wrong with its files or surroundings, a command works or says why it cannot."""

import sys

import pytest

from tests.elsewhere import PATIENCE, ROOT
from tests.endurance.command_lines import LINES, LONG, unnamed
from tests.endurance.fault_trials import Trial, attempt, judged
from tests.endurance.faults import trials

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks the kernel")

EVERY = 13
"""Of so many trials one is made here; `python -m tests.endurance.faults` makes all of them."""

ALL = [
    trial
    for command, lines in LINES.items()
    if command.startswith("sandbox") and command not in LONG
    for line in lines
    for trial in trials(command, line)
]


def test_every_command_and_all_of_its_files_are_tried() -> None:
    assert not list(unnamed())


@pytest.mark.sweep
@pytest.mark.parametrize("trial", ALL[::EVERY], ids=lambda trial: trial.name)
def test_a_command_works_or_says_why_it_cannot(trial: Trial) -> None:
    plain = attempt(Trial(trial.command, trial.line, "plain", ""), ROOT, PATIENCE).outcome

    result = attempt(trial, ROOT, PATIENCE)

    assert not list(judged(trial, result, plain)), result
