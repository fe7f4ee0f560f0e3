"""Every link, anchor and path in the documents leads somewhere."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGES = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")])
SOURCES = [
    path
    for folder in ("docs", "sandbox", "tests", "validation")
    for path in (ROOT / folder).rglob("*")
    if path.suffix in {".py", ".toml"}
] + [ROOT / "pyproject.toml"]
CODE = re.compile(r"^```[\s\S]*?^```$|^ {4}.*$|`[^`\n]*`", re.MULTILINE)
LINK = re.compile(r"\]\(([^)\s]+)\)")
NAMED = re.compile(r"docs/[\w./-]+\.(?:md|png|toml|py)")
IMPORT = re.compile(r"^ *(from (?:sandbox|validation)[\w.]* import [\w, ]+)$", re.MULTILINE)
FILE = re.compile(r"`([\w./-]+\.(?:py|toml))`")


def named(page: Path) -> str:
    return str(page.relative_to(ROOT))


def links(page: Path) -> list[str]:
    """Return the links of a page within the project."""
    found = LINK.findall(CODE.sub("", page.read_text(encoding="utf-8")))
    return [link for link in found if not re.match(r"[a-z]+:", link)]


def anchors(page: Path) -> set[str]:
    """Return the headings of a page as links name them: in small letters, with hyphens."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
    titles = re.findall(r"^#+ (.+)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def is_there(name: str) -> bool:
    """Whether there is a source file with this path, or with a path that ends so."""
    return any(f"/{named(path)}".endswith(f"/{name}") for path in SOURCES)


@pytest.mark.parametrize("page", PAGES, ids=named)
def test_every_link_leads_somewhere(page: Path) -> None:
    for link in links(page):
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page

        assert target.exists(), f"{named(page)}: {link} is not there"
        assert target.is_relative_to(ROOT), f"{named(page)}: {link} leads out of the project"
        assert not anchor or anchor in anchors(target), f"{named(page)}: {link}: no such heading"


def test_a_link_that_leads_nowhere_and_a_heading_that_is_not_there_are_found() -> None:
    page = ROOT / "README.md"

    assert len(links(page)) > 10
    assert not (page.parent / "docs/levels.txt").exists()
    assert "how-close-and-at-what-cost" in anchors(page)


def test_every_document_that_code_or_the_makefile_names_is_there() -> None:
    sources = [ROOT / "Makefile", ROOT / "pyproject.toml", *ROOT.glob(".ci/*")]
    for folder in ("sandbox", "validation", "tests"):
        sources += (path for path in (ROOT / folder).rglob("*.py") if path != Path(__file__))
    told = {
        (name, named(path))
        for path in sources
        for name in NAMED.findall(path.read_text(encoding="utf-8"))
    }

    assert len(told) > 5
    for name, where in told:
        assert (ROOT / name).exists(), f"{where} names {name}, which is not there"


def test_every_page_can_be_reached_from_the_readme() -> None:
    reached, ahead = set(), [ROOT / "README.md"]
    while ahead:
        page = ahead.pop()
        if page not in reached and page.suffix == ".md":
            reached.add(page)
            ahead += ((page.parent / link.partition("#")[0]).resolve() for link in links(page))

    assert {named(page) for page in PAGES} - {named(page) for page in reached} == set()


@pytest.mark.parametrize("page", PAGES, ids=named)
def test_what_a_page_imports_can_be_imported(page: Path) -> None:
    for line in IMPORT.findall(page.read_text(encoding="utf-8")):
        exec(line)


@pytest.mark.parametrize("page", PAGES, ids=named)
def test_every_source_file_that_a_page_names_is_there(page: Path) -> None:
    """In full, or relative to the folder that the page is about: `joints/make_joints.py`."""
    for name in FILE.findall(page.read_text(encoding="utf-8")):
        assert is_there(name), f"{named(page)}: {name}"


def test_every_source_file_that_the_code_names_is_there() -> None:
    found = ((path, FILE.findall(path.read_text(encoding="utf-8"))) for path in SOURCES)
    named_here = Path(__file__).name

    for path, names in found:
        gone = [name for name in names if not is_there(name) and path.name != named_here]
        assert gone == [], named(path)


def test_an_import_and_a_file_that_are_not_there_are_found() -> None:
    assert IMPORT.findall("    from sandbox.app import theme\n") == [
        "from sandbox.app import theme"
    ]
    assert FILE.findall("made in `joints/make_joints.py`") == ["joints/make_joints.py"]
    assert not is_there("contacts/curved.py")
