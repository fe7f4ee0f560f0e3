"""The share of a core that a level needs, and the results of random requests for accuracy."""

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from validation import cli, step_processor_time
from validation.random_accuracy_requests import Trial, complaints, summary, trial
from validation.step_processor_time import Pace


def test_the_json_has_the_fields_that_scripts_rely_on(tmp_path: Path) -> None:
    file = tmp_path / "pace.json"
    result = CliRunner().invoke(cli.app, ["pace", "kinematics/free-fall", "--json", str(file)])

    assert result.exit_code == 0
    [level] = json.loads(file.read_text())["levels"]
    assert set(level) == {"level", "rate", "step_seconds", "load", "reference_load"}
    assert level["level"] == "kinematics/free-fall"
    assert level["load"] == pytest.approx(level["rate"] * level["step_seconds"])
    assert 0 < level["load"] < 0.5


def test_half_of_a_core_is_enough_and_more_is_not() -> None:
    """Of the reference core: a slow or busy machine changes nothing."""
    assert Pace("a", 100.0, 9e-3, 0.9, 0.5).in_time
    assert not Pace("a", 100.0, 4e-3, 0.4, 0.6).in_time


def test_a_core_half_as_fast_leaves_the_share_of_the_reference(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """By a clock twice as fast every measurement takes twice as long, and so does the yardstick."""
    clock = iter(range(10**6))
    found = []
    for tick in (1e-3, 2e-3):
        monkeypatch.setattr(
            step_processor_time, "process_time", lambda tick=tick: next(clock) * tick
        )
        monkeypatch.setattr(step_processor_time, "yardstick", lambda tick=tick: 3 * tick)
        monkeypatch.setattr(step_processor_time, "SLICE", 50 * tick)
        monkeypatch.setattr(step_processor_time, "MOST", 1000 * tick)
        found.append(step_processor_time.pace("kinematics/free-fall"))

    slow, fast = found[1], found[0]
    assert slow.load == pytest.approx(2 * fast.load)
    assert slow.reference_load == pytest.approx(fast.reference_load)


def test_a_level_that_is_not_there_is_named() -> None:
    result = CliRunner().invoke(cli.app, ["pace", "no/such-level"])

    assert result.exit_code == 1
    assert "no/such-level" in result.output


def drawn(delivered: float, estimated: float, cheaper: str = "") -> Trial:
    return Trial(
        1, "a", {}, 1e-3, "told", estimated=estimated, delivered=delivered, cheaper=cheaper
    )


def test_what_is_delivered_told_as_it_is_and_cheap_is_no_complaint() -> None:
    trials = [drawn(9e-4, 5e-4), Trial(2, "b", {}, 1e-9, "cannot be had", refused=True)]

    assert complaints(trials) == []
    assert "1 refused, 1 compared; of these 1 delivered, 1 with the stated error" in summary(trials)


@pytest.mark.parametrize(
    "bad", [drawn(2e-3, 2e-3), drawn(9e-4, 4e-4), drawn(9e-4, 9e-4, "leapfrog at 15 Hz")]
)
def test_what_is_not_is_one(bad: Trial) -> None:
    assert complaints([bad])


@pytest.mark.sweep
@pytest.mark.parametrize("seed", [1, 15])
def test_a_trial_is_the_same_twice(seed: int) -> None:
    """All but its cost, which is measured."""
    first, second = trial(seed), trial(seed)

    assert (first.values, first.target) == (second.values, second.target)
    assert (first.estimated, first.delivered) == (second.estimated, second.delivered)
    assert first.kept
    assert first.honest
