"""`render` and `tour`."""

from pathlib import Path

import pytest

from sandbox.cli import tour
from sandbox.cli.tour_visit import visit
from sandbox.model.errors import SandboxError
from sandbox.model.translatable_message import Message
from tests.cli.helpers import NEVER, WRONG, Run, Write, height

PNG = b"\x89PNG\r\n"


def test_a_level_is_drawn(run: Run, write: Write, tmp_path: Path) -> None:
    output = tmp_path / "out.png"

    outcome = run("render", write(), "--set", "g=2", "--at", 0.5, "--output", output)

    assert outcome.status == 0
    assert str(output) in outcome.out
    assert outcome.err == ""
    assert output.read_bytes().startswith(PNG)


def test_the_time_changes_the_picture(run: Run, write: Write, tmp_path: Path) -> None:
    pictures = []
    for at in (0, 0.5, 0.5):
        run("render", write(), "--at", at, "--output", tmp_path / "out.png")
        pictures.append((tmp_path / "out.png").read_bytes())

    assert pictures[0] != pictures[1] == pictures[2]


def test_the_race_is_drawn_over_the_level(run: Run, write: Write, tmp_path: Path) -> None:
    path = write()
    alone, raced = tmp_path / "alone.png", tmp_path / "raced.png"

    assert run("render", path, "--output", alone).status == 0
    assert run("render", path, "--race", "--output", raced).status == 0

    assert alone.read_bytes() != raced.read_bytes()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--output", "out.jpg"], "its name must end so"),
        (["--output", "missing/out.png"], "there is no folder missing"),
        (["--output", "out.png", "--at", "-1"], "--at -1: must be a finite time, at least 0"),
        (["--output", "out.png", "--at", "nan"], "--at nan"),
        (["--output", "out.png", "--set", "h=1"], "unknown parameter 'h'"),
        (["--output", "out.png", "--race", "--without", "gravity"], "--race"),
        ([], "--output"),
    ],
)
def test_wrong_usage_is_said_and_draws_nothing(
    run: Run,
    write: Write,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    options: list[str],
    message: str,
) -> None:
    path = write()
    monkeypatch.chdir(tmp_path)

    outcome = run("render", path, *options)

    assert outcome.status == 2
    assert message in outcome.err
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.usefixtures("chapters")
def test_a_tour_leaves_a_picture_a_level_and_a_page(run: Run, tmp_path: Path) -> None:
    folder = tmp_path / "new" / "tour"

    outcome = run("tour", "--output", folder)

    assert outcome.status == 0
    assert "motion/fall" in outcome.out
    assert "1 level, none failed" in outcome.out
    assert outcome.err == ""
    assert {file.name for file in folder.iterdir()} == {"index.html", "motion-fall.png"}
    assert (folder / "motion-fall.png").read_bytes().startswith(PNG)
    assert 'src="motion-fall.png"' in (folder / "index.html").read_text(encoding="utf-8")


def test_a_tour_goes_on_past_what_fails_and_says_what_did(
    run: Run, chapters: Path, write: Write, tmp_path: Path
) -> None:
    write("levels/motion/wrong.json", title="<Wrong>", checks=[height(), WRONG])
    (chapters / "motion" / "bad.json").write_text("{")

    outcome = run("tour", "--output", tmp_path / "tour")

    assert outcome.status == 1
    assert "3 levels, 2 failed" in outcome.out
    assert "bad.json:1:" in outcome.err
    assert outcome.err.count("ball.position.y") == 1
    page = (tmp_path / "tour" / "index.html").read_text(encoding="utf-8")
    assert "&lt;Wrong&gt;" in page
    assert "<Wrong>" not in page


@pytest.mark.parametrize(("check", "passed"), [(height(), True), (WRONG, False), (NEVER, False)])
@pytest.mark.usefixtures("chapters", "run")
def test_a_visit_passes_only_if_every_check_was_made_and_held(
    write: Write, tmp_path: Path, check: dict[str, object], passed: bool
) -> None:
    write("levels/motion/fall.json", checks=[check])

    assert visit("motion/fall", tmp_path).passed is passed


@pytest.mark.usefixtures("chapters")
def test_a_full_disk_does_not_lose_what_a_tour_has_found(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(path: Path, _: object) -> None:
        raise SandboxError(Message("cannot write {path}: No space left on device", path=path))

    monkeypatch.setattr(tour, "write_atomically", full)

    outcome = run("tour", "--output", tmp_path)

    assert outcome.status == 1
    assert "passed" in outcome.out
    assert "none failed" in outcome.out
    assert "No space left on device" in outcome.err


def test_a_tour_into_a_file_is_wrong_usage(run: Run, write: Write) -> None:
    path = write()

    outcome = run("tour", "--output", path)

    assert outcome == (2, "", f"cannot make the folder {path}: it is a file\n")
