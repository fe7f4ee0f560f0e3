"""The report is one valid page with everything in it, and says what is missing."""

import json
import os
import re
import tempfile
from collections.abc import Iterator
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner, Result

import validation.output
from sandbox.model import atomic_file_writing
from sandbox.model.errors import SandboxError
from tests.elsewhere import python
from validation.cli import app
from validation.effect_costs import comparison_with_bare_engine, cost_growth
from validation.report import command, measurements

pytestmark = pytest.mark.sweep  # the page takes half a minute to be made

LEVELS = ("newton/atwood", "kinematics/circular-motion")

HARD = ("a cradle of five, 1 in, gap 0 m", "a cradle that touches")

VOID = {"meta", "br", "hr", "img", "input", "link", "wbr"}

Attributes = list[tuple[str, str | None]]


class Page(HTMLParser):
    """The elements of a page, and its mistakes."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: Attributes) -> None:
        assert len({name for name, _ in attrs}) == len(attrs), self.get_starttag_text()
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: Attributes) -> None:
        assert "svg" in self.open, f"<{tag}/> closes itself in SVG only"
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open, f"</{tag}> closes nothing"
        assert self.open.pop() == tag, self.getpos()

    def having(self, *tags: str) -> list[dict[str, str | None]]:
        return [attributes for tag, attributes in self.elements if tag in tags]


@pytest.fixture(scope="module", autouse=True)
def _small() -> Iterator[None]:
    """Two cases, two levels, a hard case and a frontier, two numbers of bodies."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(measurements, "PHENOMENA", ("atwood", "circular_motion"))
        patch.setattr(measurements, "SAMPLE", LEVELS)
        patch.setattr(measurements, "HARD", HARD)
        patch.setattr(comparison_with_bare_engine, "QUICK", (1, 100, 200))
        patch.setattr(cost_growth, "QUICK", {"gas": (2, 9), "pile": (2, 9)})
        yield


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a report."""
    folder = tmp_path_factory.mktemp("report") / "new"
    done = write("--quick", "--figures", "--output", folder)
    assert done.exit_code == 0, done.output
    return folder


@pytest.fixture(scope="module")
def text(folder: Path) -> str:
    return (folder / "report.html").read_text(encoding="utf-8")


def write(*arguments: object) -> Result:
    return CliRunner().invoke(app, ["report", *map(str, arguments)])


def test_every_element_is_closed_and_every_name_is_given_once(text: str) -> None:
    page = Page(text)

    assert not page.open
    names = [a["id"] for _, a in page.elements if "id" in a]
    assert len(set(names)) == len(names)
    assert text.startswith("<!DOCTYPE html>")
    assert page.having("html")[0]["lang"] == "en"


def test_what_is_referred_to_is_there(text: str) -> None:
    page = Page(text)
    names = {a["id"] for _, a in page.elements if "id" in a}
    links = {a["href"] for a in page.having("a", "use")}
    links |= {f"#{name}" for name in re.findall(r"url\(#(\w+)\)", text)}

    assert links
    assert links <= {f"#{name}" for name in names}


def test_the_page_loads_nothing(text: str) -> None:
    page = Page(text)

    assert not page.having("link", "img", "iframe", "object", "embed")
    assert not [a for _, a in page.elements if {"src", "srcset", "data"} & a.keys()]
    assert "http" not in text
    assert "@import" not in text
    assert not re.search(r"url\((?!#)", text)


def test_headings_go_down_one_step_at_a_time(text: str) -> None:
    steps = [int(tag[1]) for tag, _ in Page(text).elements if re.fullmatch(r"h\d", tag)]

    assert steps[0] == 1
    assert steps.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(steps))


def test_tables_and_figures_can_be_read_aloud(text: str) -> None:
    page = Page(text)

    assert page.having("table")
    scopes = {"col", "colgroup", "row", "rowgroup"}
    assert all(a.get("scope") in scopes for a in page.having("th"))
    figures = page.having("svg")
    assert len(figures) == len(LEVELS) + 1
    assert all(a["role"] == "img" and a["aria-label"] for a in figures)


def test_text_in_figures_is_text(text: str) -> None:
    figures = "".join(re.findall(r"<svg.*?</svg>", text, re.S))

    assert "largest error of the run" in figures
    assert "leapfrog" in figures
    assert len(figures) < 20_000 * (len(LEVELS) + 1)


def test_every_part_says_what_it_found(text: str) -> None:
    assert "2 of 2" in text
    assert all(level in text for level in LEVELS)
    assert "attraction + drag + force" in text
    assert len(re.findall(r"<tr><th scope=.row.>(?:gas|pile)</th>", text)) == 4
    assert all(name in text for name in HARD)
    assert "how far beyond" in text
    assert "Of 2 requests" in text
    assert "Digits that hold" in text
    assert "8 or more" in text
    assert "This part is missing" not in text
    assert "A quick report" in text


def test_the_figures_are_kept_beside_the_page(folder: Path) -> None:
    figures = sorted(path.name for path in (folder / "figures").iterdir())

    assert "cost-newton-atwood.png" in figures
    assert "effects.svg" in figures
    for part in measurements.PARTS:
        assert json.loads((folder / f"{part.command}.json").read_text(encoding="utf-8"))


def test_a_report_is_drawn_anew_from_its_own_figures(
    folder: Path, text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def measure(_: bool) -> measurements.Content:
        pytest.fail("measured again")

    monkeypatch.setattr(
        measurements,
        "PARTS",
        [measurements.Part(p.command, measure) for p in measurements.PARTS],
    )
    done = write("--quick", "--from", folder, "--output", tmp_path)

    assert done.exit_code == 0
    stamp = re.compile(r"on [-\d]+ at [\d:]+ UTC|<svg.*?</svg>", re.S)  # the layout may shift
    again = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert stamp.sub("", again) == stamp.sub("", text)


@pytest.mark.parametrize("full_from", ["stability.json", "report.html"])
def test_what_was_measured_is_kept_if_the_disk_gets_full(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, full_from: str
) -> None:
    output, elsewhere = tmp_path / "out", tmp_path / "elsewhere"
    elsewhere.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(elsewhere))
    begun: list[str] = []

    def write_atomically(path: Path, data: str | bytes) -> None:
        begun.append(path.name)
        if full_from in begun and path.parent == output:
            raise SandboxError("cannot write {path}: no space", path=path)
        atomic_file_writing.write_atomically(path, data)

    for module in (command, validation.output):
        monkeypatch.setattr(module, "write_atomically", write_atomically)

    done = write("--quick", "--from", folder, "--output", output)

    (kept,) = elsewhere.iterdir()
    measured = begun[: begun.index(full_from) + 1]
    assert done.exit_code == 1
    assert f"{full_from}: no space; what was measured is in {kept}" in done.stderr
    assert {path.name for path in kept.iterdir()} == {*measured} - {"report.html"}
    assert {path.name for path in output.iterdir()} == {*measured} - {full_from}
    assert all((kept / name).read_bytes() == (folder / name).read_bytes() for name in measured[:2])


def test_a_file_that_cannot_be_written_is_refused_before_anything_is_measured(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def measure(_: bool) -> measurements.Content:
        pytest.fail("measured for nothing")

    monkeypatch.setattr(
        measurements,
        "PARTS",
        [measurements.Part(p.command, measure) for p in measurements.PARTS],
    )
    (tmp_path / "effects.json").mkdir()

    done = write("--quick", "--output", tmp_path)

    assert done.exit_code == 2
    assert "it is a folder" in done.stderr


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes as on Unix")
def test_a_pipe_in_the_place_of_a_part_is_not_waited_for(folder: Path, tmp_path: Path) -> None:
    source = broken(folder, tmp_path, "{}")
    (source / "cost.json").unlink()
    os.mkfifo(source / "cost.json")

    done = write("--quick", "--from", source, "--output", tmp_path / "out")

    assert done.exit_code == 1
    assert "missing: cost" in done.stderr


@pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")
def test_a_broken_link_in_the_place_of_a_part_is_told(folder: Path, tmp_path: Path) -> None:
    """It was measured anew, for minutes."""
    source = broken(folder, tmp_path, "{}")
    (source / "cost.json").unlink()
    (source / "cost.json").symlink_to("nowhere")

    done = write("--quick", "--from", source, "--output", tmp_path / "out")

    assert done.exit_code == 1
    assert "cost.json: is a link to a file that does not exist" in done.stderr


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        ("{", "cannot read"),
        ("[]", "is not what"),
        ("{}", "in another form"),
        ('{"levels": [], "requests": []}', "in another form"),
        ('{"environment": {}, "levels": [{"level": "x"}]}', "in another form"),
    ],
)
def test_a_part_that_cannot_be_read_is_told_in_its_place(
    folder: Path, tmp_path: Path, content: str, reason: str
) -> None:
    source = broken(folder, tmp_path, content)

    done = write("--quick", "--from", source, "--output", tmp_path / "out")

    assert done.exit_code == 1
    assert "missing: cost" in done.stderr
    text = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert not Page(text).open
    assert "This part is missing" in text
    assert reason in text
    assert "2 of 2" in text
    assert "Traceback" not in text + done.output


def broken(folder: Path, tmp_path: Path, content: str) -> Path:
    source = tmp_path / "source"
    source.mkdir()
    for name in ("run.json", "stability.json", "effects.json"):
        (source / name).write_bytes((folder / name).read_bytes())
    (source / "cost.json").write_text(content, encoding="utf-8")
    return source


def test_a_case_that_does_not_hold_is_named(folder: Path, tmp_path: Path) -> None:
    source = broken(folder, tmp_path, (folder / "cost.json").read_text(encoding="utf-8"))
    found: dict[str, Any] = json.loads((source / "run.json").read_text(encoding="utf-8"))
    found["cases"][0] |= {"passed": False, "name": "a <wrong> case", "error": None}
    (source / "run.json").write_text(json.dumps(found), encoding="utf-8")

    done = write("--quick", "--from", source, "--output", tmp_path / "out")

    assert done.exit_code == 1
    text = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "1 of 2" in text
    assert "a &lt;wrong&gt; case" in text
    assert not Page(text).open


def test_a_hard_case_that_fails_and_a_request_that_is_missed_are_named(
    folder: Path, tmp_path: Path
) -> None:
    cost: dict[str, Any] = json.loads((folder / "cost.json").read_text(encoding="utf-8"))
    cost["requests"][0] |= {"delivered": 0.5}
    cost["requests"][1] |= {"stepping": None, "delivered": None, "said": "it cannot be had"}
    source = broken(folder, tmp_path, json.dumps(cost))
    hard: dict[str, Any] = json.loads((source / "stability.json").read_text(encoding="utf-8"))
    hard["cases"][0] |= {"passed": False, "figure": None}
    (source / "stability.json").write_text(json.dumps(hard), encoding="utf-8")

    done = write("--quick", "--from", source, "--output", tmp_path / "out")

    assert done.exit_code == 1
    text = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "Of the hard cases there fails:" in text
    assert "0 of 1 hold" in text
    assert "5.0e-01 was delivered" in text
    assert "it cannot be had" in text


WITHOUT = """
import sys
sys.modules[{library!r}] = None
sys.argv = ["validation", "report", "--output", {output!r}]
from validation.__main__ import main
main()
"""


@pytest.mark.parametrize("library", ["jinja2", "matplotlib"])
def test_a_missing_extra_is_told_with_the_command_that_installs_it(
    library: str, tmp_path: Path
) -> None:
    code = WITHOUT.format(library=library, output=str(tmp_path))

    done = python("-c", code)

    assert done.returncode == 2
    assert library in done.stderr
    assert "pip install" in done.stderr
    assert "[report]" in done.stderr
    assert "Traceback" not in done.stderr
    assert not list(tmp_path.iterdir())


def test_a_folder_that_cannot_be_used_is_wrong_usage(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")

    for wrong in (["--output", tmp_path / "file"], ["--from", tmp_path / "no", "--output", "x"]):
        done = write("--quick", *wrong)
        assert done.exit_code == 2
        assert "cannot" in done.stderr
        assert "Traceback" not in done.output
