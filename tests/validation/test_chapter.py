"""The map from the document to the levels leaves out no level, and names none that is not there."""

from sandbox.model import catalog
from validation.chapter import PAGE, PARTS, page


def test_every_level_plays_a_part_of_the_document() -> None:
    assert {name for part in PARTS for name in part.levels} == set(catalog.textbook())


def test_parts_have_names_of_their_own() -> None:
    assert len({(part.section, part.text) for part in PARTS}) == len(PARTS)


def test_the_page_in_the_docs_is_the_map_as_it_is() -> None:
    assert PAGE.read_text(encoding="utf-8") == page()
