"""The map from the chapter to the levels omits no level, and names none that does not exist."""

from pathlib import Path

import pytest

from sandbox.model import level_catalog
from validation import textbook_coverage
from validation.textbook_coverage import PAGE, PARTS, main, page, parts


def test_every_level_plays_a_part_of_the_document() -> None:
    assert {name for part in parts() for name in part.levels} == set(level_catalog.textbook())


def test_a_level_that_no_part_names_is_a_part_by_its_reference(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(
        textbook_coverage, "PARTS", [p for p in PARTS if "newton/incline" not in p.levels]
    )
    (found,) = (part for part in parts() if "newton/incline" in part.levels)

    assert found == ("4. Newton's laws", "block on an incline", ("newton/incline",))


def test_parts_have_names_of_their_own() -> None:
    assert len({(part.section, part.text) for part in PARTS}) == len(PARTS)


def test_the_page_in_the_docs_is_the_map_as_it_is() -> None:
    written = (level_catalog.sources() / PAGE).read_text(encoding="utf-8")
    assert written == page(), "run 'make docs'"


def test_an_installed_package_writes_no_map(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(
        level_catalog, "__file__", str(tmp_path / "sandbox" / "model" / "catalog.py")
    )

    assert main() == 2
    assert "is written in a checkout of the project" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
