"""Files of all kinds that were changed at random; `tests.endurance.files` tries many more."""

from pathlib import Path
from random import Random

import pytest

from tests.endurance.files import attempt, kinds, spoilt


@pytest.mark.sweep
def test_whatever_a_file_holds_is_taken_or_refused_in_a_sentence(tmp_path: Path) -> None:
    for name, kind in kinds(tmp_path).items():
        for number in range(200):
            random = Random(f"{name} {number}")
            content = spoilt(random, random.choice(kind.examples))

            assert attempt(kind, content) in ("taken", "refused"), (name, number)
