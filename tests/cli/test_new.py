"""`new`: a level that runs, made from a template or from another level."""

import json
from pathlib import Path

import pytest

from sandbox.model import level_catalog, templates
from sandbox.model.level_writing import formatted
from sandbox.model.loading import load
from sandbox.model.rules.level_validation import corners
from sandbox.physics.measuring.grading import grade
from sandbox.physics.run import simulate
from tests.cli.helpers import Run, Write
from tests.sample import thinned

TEMPLATES = templates.names()


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder that commands work in."""
    place = tmp_path / "work"
    place.mkdir()
    monkeypatch.chdir(place)
    return place


@pytest.mark.sweep
@pytest.mark.parametrize("template", TEMPLATES)
def test_a_new_level_is_well_formed_and_passes_its_checks(run: Run, template: str) -> None:
    outcome = run("new", "mine", "--from", template)

    assert outcome.status == 0
    assert outcome.err == ""
    assert outcome.out.startswith("mine.json: ")
    assert run("check", "mine.json") == (0, "1 level well formed\n", "")
    assert run("format", "--check", "mine.json").status == 0
    assert run("simulate", "mine.json", "--output", "mine.csv").status == 0


@pytest.mark.parametrize("template", thinned(TEMPLATES, 3))
def test_a_template_passes_its_checks_at_the_corners_of_its_ranges(template: str) -> None:
    level = load(templates.path(template))

    for values in corners(level):
        verdicts = {result.verdict for result in grade(simulate(level, values))}
        assert verdicts <= {"passed", "not applicable"}, values


def test_the_challenge_among_the_templates_can_be_won(run: Run) -> None:
    run("new", "mine", "--from", "challenge")
    solution = ("--set", "speed=12.2", "--set", "angle=45")

    outcome = run("simulate", "mine.json", *solution, "--output", "mine.csv")

    assert "challenge: 2 of 2 stars" in outcome.out


@pytest.mark.parametrize("template", TEMPLATES)
def test_the_help_names_every_template(run: Run, template: str) -> None:
    assert template in run("new", "--help").out


def test_without_a_template_it_is_the_ground_alone(run: Run) -> None:
    assert run("new", "mine.json").status == 0

    assert list(load(Path("mine.json")).bodies) == ["ground"]


def test_a_new_level_may_begin_as_any_level(run: Run) -> None:
    shipped = level_catalog.find("newton/atwood")

    assert run("new", "mine", "--from", "newton/atwood").status == 0

    mine = Path("mine.json").read_text("utf-8")
    assert mine.splitlines()[2:] == shipped.read_text("utf-8").splitlines()[2:]


def test_a_new_level_names_the_schema_where_it_is(run: Run) -> None:
    run("new", "mine")

    named = json.loads(Path("mine.json").read_text("utf-8"))["$schema"]
    assert named == (level_catalog.root() / "level.schema.json").as_uri()


def test_beside_the_levels_that_ship_the_schema_is_named_as_there(run: Run, chapters: Path) -> None:
    path = chapters / "motion" / "mine"

    assert run("new", path, "--from", "motion/fall").status == 0

    said = path.with_suffix(".json").read_text("utf-8")
    assert json.loads(said)["$schema"] == "../level.schema.json"
    assert formatted(said) == said


@pytest.mark.parametrize("name", ["mine", "mine.json"])
def test_nothing_is_overwritten(run: Run, name: str) -> None:
    Path("mine.json").write_text("precious")

    outcome = run("new", name, "--from", "orbit")

    assert outcome == (2, "", "mine.json already exists; nothing is overwritten\n")
    assert Path("mine.json").read_text() == "precious"


def test_a_link_that_leads_nowhere_is_not_overwritten(run: Run, tmp_path: Path) -> None:
    Path("mine.json").symlink_to(tmp_path / "elsewhere.json")

    assert run("new", "mine").status == 2
    assert not (tmp_path / "elsewhere.json").exists()


def test_a_template_that_does_not_exist_is_told_with_what_was_meant(run: Run) -> None:
    outcome = run("new", "mine", "--from", "pendulm")

    assert outcome.status == 2
    assert outcome.err == (
        "--from pendulm: is neither a template nor a level; did you mean 'pendulum'?\n"
    )
    assert not Path("mine.json").exists()


@pytest.mark.parametrize("name", ["", ".json", "..", "a/", "nowhere/mine"])
def test_a_name_that_no_file_can_have_is_wrong_usage(run: Run, folder: Path, name: str) -> None:
    outcome = run("new", name)

    assert outcome.status == 2
    assert outcome.err.count("\n") == 1
    assert not list(folder.iterdir())


def test_a_name_that_is_too_long_for_a_file_is_told(run: Run, folder: Path) -> None:
    outcome = run("new", "x" * 300)

    assert outcome.status == 1
    assert "File name too long" in outcome.err
    assert not list(folder.iterdir())


def test_a_level_with_mistakes_is_nothing_to_begin_with(run: Run, write: Write) -> None:
    outcome = run("new", "mine", "--from", write(duration=0))

    assert outcome.status == 1
    assert "duration" in outcome.err
    assert not Path("mine.json").exists()
