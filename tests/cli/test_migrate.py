"""`migrate`: the versions of the level format."""

import pytest

from tests.cli.helpers import Run, Write


def test_the_only_version_is_the_newest(run: Run, write: Write) -> None:
    path = write()
    before = path.read_bytes()

    outcome = run("migrate", path, "newton/atwood")

    assert outcome.status == 0
    assert outcome.out.splitlines() == [
        f"{path}: format 1, the newest; nothing to do",
        "newton/atwood: format 1, the newest; nothing to do",
    ]
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    ("version", "rule"),
    [
        (2, "is not known: the newest version here is 1; a newer sandbox may know it (found 2)"),
        (0, "must be a whole number from 1; the newest is 1 (found 0)"),
        (True, "must be a whole number from 1; the newest is 1 (found true)"),
        ("1", "must be a whole number from 1; the newest is 1"),
    ],
)
def test_a_version_that_does_not_exist_is_refused(
    run: Run, write: Write, version: object, rule: str
) -> None:
    path = write(format=version)

    outcome = run("migrate", path)

    assert outcome == (1, "", f"{path}:1:2: format: {rule}\n1 of 1 level cannot be migrated\n")


@pytest.mark.parametrize(
    ("said", "rule"),
    [
        ("{}", "has no 'format', the version of the format: \"format\": 1"),
        ("[]", "is no level, which is an object, {...}"),
        ("", "is empty"),
    ],
)
def test_a_file_without_a_version_is_refused(run: Run, write: Write, said: str, rule: str) -> None:
    path = write()
    path.write_text(said)

    outcome = run("migrate", path)

    assert outcome == (1, "", f"{path}: {rule}\n1 of 1 level cannot be migrated\n")
