"""The site has every page and every level, and its links stay on it."""

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

from sandbox.model import level_catalog

ROOT = Path(__file__).resolve().parents[1]
NAV = re.findall(r"[\w/-]+\.md", (ROOT / "mkdocs.yml").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def site() -> ModuleType:
    """The hooks, which MkDocs loads by their path as well."""
    spec = importlib.util.spec_from_file_location("hooks_of_the_site", ROOT / "docs" / "site.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_document_is_in_the_navigation(site: ModuleType) -> None:
    pages = {path.relative_to(ROOT / "docs").as_posix() for path in ROOT.glob("docs/**/*.md")}

    assert sorted(NAV) == sorted({*pages, *site.FROM_ROOT, "gallery.md"})


@pytest.mark.sweep
def test_the_gallery_shows_every_level_once(site: ModuleType) -> None:
    pictures = re.findall(r"\]\(gallery/(.+)\.png\)", site.gallery())

    assert pictures == level_catalog.names()


def test_each_step_of_the_tutorial_stands_above_its_picture(site: ModuleType) -> None:
    page = "tutorial/first-level.md"
    shown = site.illustrated(page, (ROOT / "docs" / page).read_text(encoding="utf-8"))

    assert len(site.pictures_of(page)) == 6
    for picture in site.pictures_of(page):
        assert re.search(rf"```\n\n!\[[^\]]+\]\(\.\./{picture}\)", shown), picture


@pytest.mark.parametrize(
    ("page", "link", "on_the_site"),
    [
        ("CONTRIBUTING.md", "docs/how-to/add-a-case.md", "how-to/add-a-case.md"),
        ("index.md", "../CONTRIBUTING.md", "CONTRIBUTING.md"),
        ("reference/chapter.md", "../../levels/newton/atwood.json", "../gallery.md#newton-atwood"),
        ("how-to/recipes.md", "write-a-level.md#joints", "write-a-level.md#joints"),
        ("how-to/recipes.md", "https://www.pymunk.org", "https://www.pymunk.org"),
        ("how-to/recipes.md", "#joints", "#joints"),
    ],
)
def test_links_out_of_the_documents_lead_to_pages_of_the_site(
    site: ModuleType, page: str, link: str, on_the_site: str
) -> None:
    assert site.inside(page, f"see [this]({link})") == f"see [this]({on_the_site})"
