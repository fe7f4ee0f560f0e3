"""The package has all files that it mentions, and names all that it needs."""

import re
import tomllib
from itertools import chain
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def test_the_sources_that_are_packed_hold_every_document_and_the_makefile() -> None:
    told = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    packed = set(told["tool"]["hatch"]["build"]["targets"]["sdist"]["include"])
    documents = {path.name for path in ROOT.glob("*.md")}

    assert documents | {"Makefile", "LICENSE"} <= packed
    assert all((ROOT / name).exists() for name in packed)


def test_the_lock_names_one_version_of_whatever_the_project_asks_for() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    asked = [*project["dependencies"], *chain(*project["optional-dependencies"].values())]
    lines = (ROOT / "requirements.lock").read_text(encoding="utf-8").splitlines()[1:]
    locked = dict(line.split("==") for line in lines)

    assert len(locked) == len(lines)
    for requirement in asked:
        found = re.match(r"[\w-]+", requirement)
        assert found
        name = found[0].lower()
        if name == project["name"]:  # one extra takes up another
            continue
        assert {name, name.replace("_", "-"), name.replace("-", "_")} & locked.keys(), name
