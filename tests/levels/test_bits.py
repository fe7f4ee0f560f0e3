"""States are the same bits on every machine of a kind, and almost the same on all machines."""

import json

import numpy as np
import pytest

from tests.levels.bits import FILE, LEVELS, kind, state
from tests.levels.playing import fingerprint

CLOSE = 1e-8
"""m, by which places may differ on other machines: measured are 6e-11 between five families of
processors."""

KEPT = json.loads(FILE.read_text(encoding="utf-8"))
ANEW = "if the level or the physics was meant to change, run `make bits`"


def test_all_levels_are_kept() -> None:
    assert KEPT["bits"].keys() == KEPT["places"].keys() == set(LEVELS), ANEW


@pytest.mark.parametrize("name", LEVELS)
def test_every_machine_finds_the_same_places_and_its_kind_the_same_bits(name: str) -> None:
    found = state(name)

    assert np.abs(found.position.ravel() - KEPT["places"][name]).max() <= CLOSE, ANEW
    if (here := kind()) != KEPT["kind"]:
        pytest.skip(f"bits not compared: they are of {KEPT['kind']}, and this is {here}")
    assert fingerprint(found) == KEPT["bits"][name], ANEW
