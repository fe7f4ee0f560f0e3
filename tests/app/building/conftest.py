"""Somebody at the Build page."""

import pytest

from tests.app.building.builder import Builder
from tests.app.person import Person


@pytest.fixture
def builder(person: Person) -> Builder:
    person.window.open_level("newton/atwood")
    person.wait()
    return Builder(person)
