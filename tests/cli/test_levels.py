"""`list` and `check`, and the names of levels."""

from pathlib import Path

import pytest
from rich.console import Console

from sandbox.cli import list as listing
from sandbox.cli.argument_parsing import open_level
from sandbox.model import level_catalog
from tests.cli.helpers import Run, Write


@pytest.mark.usefixtures("chapters")
def test_elsewhere_than_on_a_terminal_a_level_is_one_line_with_tabs(run: Run) -> None:
    outcome = run("list")

    assert outcome == (0, "motion/fall\tFall\tgravity\tA ball falls.\n", "")


def test_the_list_names_every_level(run: Run) -> None:
    names = [line.split("\t")[0] for line in run("list").out.splitlines()]

    assert names == level_catalog.names()


def test_on_a_terminal_of_80_columns_names_are_whole(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    def terminal(*, highlight: bool) -> Console:
        return Console(width=80, force_terminal=True, color_system=None, highlight=highlight)

    monkeypatch.setattr(listing, "Console", terminal)

    lines = run("list").out.splitlines()

    assert set(level_catalog.names()) <= {line.split(" ")[0] for line in lines}
    assert max(map(len, lines)) <= 80


@pytest.mark.parametrize("text", ["", "{", "[]", '{"title": 3}', '{"title": "x", "effects": 1}'])
def test_a_level_that_cannot_be_read_does_not_spoil_the_list(
    run: Run, chapters: Path, text: str
) -> None:
    (chapters / "motion" / "bad.json").write_text(text)

    outcome = run("list")

    assert outcome.status == 0
    assert [line.split("\t")[0] for line in outcome.out.splitlines()] == [
        "motion/bad",
        "motion/fall",
    ]
    assert "'check motion/bad' says why" in outcome.out


@pytest.mark.usefixtures("chapters")
def test_a_level_may_be_named_or_be_a_file(run: Run, write: Write) -> None:
    outcome = run("check", "motion/fall", "fall", write())

    assert outcome == (0, "3 levels well formed\n", "")


def test_every_mistake_of_every_level_is_told(run: Run, write: Write) -> None:
    good = write("good.json")
    first = write("first.json", effects={"gravty": {}}, duration=0)
    second = write("second.json", title="")

    outcome = run("check", first, good, second, "nowhere/at-all")

    places = [line.partition(": ")[0] for line in outcome.err.splitlines()]
    assert outcome.status == 1
    assert sum(place.startswith(f"{first}:1:") for place in places) == 2
    assert sum(place.startswith(f"{second}:1:") for place in places) == 1
    assert places[-2] == "nowhere/at-all"
    assert places[-1] == "3 of 4 levels cannot be used"
    assert outcome.out == ""


def test_an_effect_without_strength_is_told_and_no_mistake(run: Run, write: Write) -> None:
    still = write(effects={"gravity": {"acceleration": [0, 0]}}, parameters={}, checks=[])

    outcome = run("check", still)

    assert outcome.status == 0
    assert outcome.out == "1 level well formed\n"
    assert outcome.err.startswith(
        f"{still}: effects.gravity.acceleration: 'gravity' has no strength"
    )


def sprung(stiffness: object, **rest: object) -> dict[str, object]:
    """A ball of a kilogram on a spring."""
    spring = {"type": "spring", "ends": [[0, 0], "ball"], "stiffness": stiffness}
    return {"joints": {"arm": spring}, **rest}


def test_a_spring_that_is_too_stiff_for_the_rate_is_a_mistake(run: Run, write: Write) -> None:
    stiff = write(**sprung(1e6))

    outcome = run("check", stiff)

    assert outcome.status == 1
    assert outcome.err.splitlines()[0].startswith(f"{stiff}:1:")
    assert "joints.arm: the spring 'arm' needs a 'rate' of at least 500, not 60" in outcome.err
    assert run("check", write(**sprung(1e6, stepping={"rate": 501}))).status == 0


def test_a_spring_that_a_slider_makes_too_stiff_is_a_mistake(run: Run, write: Write) -> None:
    ranges = {
        "g": {"value": 9.81, "min": 0, "max": 25},
        "k": {"value": 100, "min": 1, "max": 1e6},
    }
    outcome = run("check", write(**sprung("k", parameters=ranges)))

    assert outcome.status == 1
    assert (
        "needs a 'rate' of at least 500, not 60 when k = 1e+06; tried: at 2,000 Hz it"
        in outcome.err
    )


def test_bodies_that_overlap_at_the_start_are_a_mistake(run: Run, write: Write) -> None:
    ball = {"shape": {"type": "disc", "radius": 0.5}, "mass": 1}
    bodies = {"a": ball, "b": {**ball, "position": [0.75, 0]}}
    rest: dict[str, object] = {"bodies": bodies, "checks": [], "ghosts": {}, "parameters": {}}
    overlapping = write(**rest, effects={"contact": {}})

    outcome = run("check", overlapping)

    assert outcome.status == 1
    assert outcome.err.splitlines()[0].startswith(f"{overlapping}:1:")
    assert "bodies.a: 'a' and 'b' overlap by 0.25 m at the start; move them apart" in outcome.err
    assert run("check", write(**rest, effects={"contact": {"overlaps": True}})).status == 0


def on_a_rod(partner: dict[str, object], **rod: object) -> dict[str, object]:
    """Two discs on a rod along x, the first at 1 m/s along it; without effects."""
    ball = {"shape": {"type": "disc", "radius": 0.1}, "mass": 1}
    bodies = {"a": {**ball, "velocity": [1, 0]}, "b": {**ball, "position": [1, 0], **partner}}
    joints = {"arm": {"type": "rod", "ends": ["a", "b"], **rod}}
    rest: dict[str, object] = {"effects": {}, "checks": [], "ghosts": {}, "parameters": {}}
    return {"bodies": bodies, "joints": joints, **rest}


def test_velocities_at_the_start_that_a_joint_changes_are_told_and_no_mistake(
    run: Run, write: Write
) -> None:
    torn = write(**on_a_rod({}))

    outcome = run("check", torn)

    assert (outcome.status, outcome.out) == (0, "1 level well formed\n")
    assert outcome.err.startswith(
        f"{torn}: joints.arm: the velocities at the start violate it by 1 m/s or rad/s"
    )


@pytest.mark.parametrize(
    ("partner", "rod"), [({"velocity": [1, 2]}, {}), ({}, {"length": "1 - t/2"})]
)
def test_velocities_that_fit_a_joint_or_its_changing_length_are_not_remarked_on(
    partner: dict[str, object], rod: dict[str, object], run: Run, write: Write
) -> None:
    assert run("check", write(**on_a_rod(partner, **rod))).err == ""


def test_check_needs_a_level(run: Run) -> None:
    assert run("check").status == 2


@pytest.mark.usefixtures("chapters")
def test_a_level_of_the_catalog_is_called_by_its_whole_name(write: Write) -> None:
    path = str(write())

    assert open_level("fall")[0] == "motion/fall"
    assert open_level(path)[0] == path
