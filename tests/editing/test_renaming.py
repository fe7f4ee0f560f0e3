"""Renaming changes every mention of a name, and nothing else."""

import pytest

from sandbox.editing.renaming import rename
from sandbox.editing.written_out_shorthand import expanded
from sandbox.model import level_catalog
from sandbox.model.errors import SandboxError
from sandbox.model.json_positions import TOKEN
from sandbox.model.loading import digest, parse, read
from tests.sample import sampled

LEVELS = [*level_catalog.textbook()[::2], *level_catalog.challenges()[::3]]


@pytest.mark.parametrize("name", sampled(LEVELS, "rename"))
@pytest.mark.parametrize("part", ["bodies", "joints", "parameters"])
def test_everything_can_be_renamed_and_back(name: str, part: str) -> None:
    text = expanded(read(level_catalog.find(name)))
    level = parse(text)
    for old in list(getattr(level, part))[:1]:
        new = rename(text, (part, old), "renamed_9")
        assert old not in getattr(parse(new), part)
        assert rename(new, (part, "renamed_9"), old) == text


def test_only_what_mentions_a_name_changes() -> None:
    text = read(level_catalog.find("newton/atwood"))
    new = rename(text, ("parameters", "m1"), "heavy")
    pairs = zip(TOKEN.findall(text), TOKEN.findall(new), strict=True)
    changed = {old for old, new in pairs if old != new}
    assert all("m1" in token for token in changed)
    assert "m1" not in parse(new).parameters
    assert digest(parse(rename(new, ("parameters", "heavy"), "m1"))) == digest(parse(text))


def test_a_name_within_another_stays() -> None:
    text = read(level_catalog.find("newton/atwood")).replace("m2", "m12")
    new = rename(text, ("parameters", "m1"), "m")
    assert "m12" in parse(new).parameters


@pytest.mark.parametrize("bad", ["", "1a", "left side", "right", "string", "a" * 32, "system"])
def test_what_is_no_name_or_taken_is_refused(bad: str) -> None:
    text = read(level_catalog.find("newton/atwood"))
    with pytest.raises(SandboxError):
        rename(text, ("bodies", "left"), bad)


@pytest.mark.parametrize("bad", ["t", "pi", "sqrt", "m2"])
def test_a_parameter_cannot_be_called_what_formulas_know(bad: str) -> None:
    text = read(level_catalog.find("newton/atwood"))
    with pytest.raises(SandboxError, match="taken"):
        rename(text, ("parameters", "m1"), bad)


def test_what_is_not_there_is_not_renamed() -> None:
    with pytest.raises(SandboxError, match=r"bodies\.middle"):
        rename(read(level_catalog.find("newton/atwood")), ("bodies", "middle"), "new")
