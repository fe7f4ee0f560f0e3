"""What is packed has all that it tells of."""

import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def test_the_sources_that_are_packed_hold_every_document_and_the_makefile() -> None:
    told = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    packed = set(told["tool"]["hatch"]["build"]["targets"]["sdist"]["include"])
    documents = {path.name for path in ROOT.glob("*.md")}

    assert documents | {"Makefile", "LICENSE"} <= packed
    assert all((ROOT / name).exists() for name in packed)
