"""The levels of the catalog are found by name, by the end of it, and by path."""

from pathlib import Path

import pytest

from sandbox.model import level_catalog
from sandbox.model.errors import LevelError
from sandbox.model.loading import load
from validation.case import textbook


@pytest.fixture
def shelf(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Use a small folder of levels as the catalog, and an empty one as the current folder."""
    levels, elsewhere = tmp_path / "levels", tmp_path / "elsewhere"
    for name in ("newton/atwood", "newton/incline", "energy/incline", "deep/er/level"):
        path = levels / f"{name}.json"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("{}")
    (levels / "level.schema.json").write_text("{}")
    (levels / "newton" / "notes.txt").write_text("")
    elsewhere.mkdir()
    monkeypatch.setattr(level_catalog, "root", lambda: levels)
    monkeypatch.chdir(elsewhere)
    return levels


def test_levels_are_one_folder_deep_and_in_the_documents_order(shelf: Path) -> None:
    assert shelf.is_dir()
    assert level_catalog.names() == ["newton/atwood", "newton/incline", "energy/incline"]


@pytest.mark.usefixtures("shelf")
def test_the_hard_cases_are_listed_last_and_belong_to_no_chapter() -> None:
    hard = level_catalog.root() / "hard" / "stack.json"
    hard.parent.mkdir()
    hard.write_text("{}")

    assert level_catalog.names() == [*level_catalog.textbook(), "hard/stack"]
    assert "hard/stack" not in level_catalog.textbook()


@pytest.mark.parametrize(
    ("asked", "found"),
    [
        ("newton/atwood", "newton/atwood"),
        ("newton/atwood.json", "newton/atwood"),
        ("newton\\atwood", "newton/atwood"),
        ("atwood", "newton/atwood"),
        ("energy/incline", "energy/incline"),
    ],
)
def test_a_level_is_found_by_its_name_or_the_end_of_it(shelf: Path, asked: str, found: str) -> None:
    assert level_catalog.find(asked) == shelf / f"{found}.json"


@pytest.mark.parametrize("name", ["mine.json", "mine.txt", "sub/mine.json"])
@pytest.mark.usefixtures("shelf")
def test_a_level_is_found_by_its_path(name: str) -> None:
    path = Path(name)
    path.parent.mkdir(exist_ok=True)
    path.write_text("{}")

    assert level_catalog.find(name) == path
    assert level_catalog.find(str(path.absolute())) == path.absolute()


@pytest.mark.usefixtures("shelf")
def test_a_file_comes_before_a_level_of_the_same_name() -> None:
    Path("newton").mkdir()
    Path("newton/atwood.json").write_text("{}")

    assert level_catalog.find("newton/atwood.json") == Path("newton/atwood.json")


@pytest.mark.usefixtures("shelf")
def test_what_is_there_but_no_file_is_told_by_whoever_reads_it() -> None:
    Path("folder.json").mkdir()

    with pytest.raises(LevelError, match="is a folder, not a file"):
        load(level_catalog.find("folder.json"))


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ("newton/atwod", "did you mean 'newton/atwood'?"),
        ("atwod", "did you mean 'atwood'?"),
        ("incline", "several levels: newton/incline, energy/incline"),
        ("atwod.json", "there is no such file; did you mean 'atwood'?"),
        ("zzz", "is neither a level nor a file; known: atwood, incline"),
        ("level.schema", "neither"),
        ("er/level", "neither"),
        ("", "neither"),
        (".", "neither"),
        ("..", "neither"),
        ("/", "neither"),
        ("a\0b", "neither"),
        ("x" * 10**5, "neither"),
    ],
)
@pytest.mark.usefixtures("shelf")
def test_what_is_not_found_is_told_with_what_was_meant(asked: str, told: str) -> None:
    with pytest.raises(LevelError) as caught:
        level_catalog.find(asked)

    assert told in str(caught.value)
    assert str(caught.value).isprintable()
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize(
    ("there", "found"),
    [(["levels"], "levels"), (["sandbox/levels"], "sandbox/levels"), ([], "levels")],
    ids=["checkout", "installed", "neither"],
)
def test_the_levels_are_inside_the_package_or_beside_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, there: list[str], found: str
) -> None:
    for folder in there:
        (tmp_path / folder).mkdir(parents=True)
    monkeypatch.setattr(
        level_catalog, "__file__", str(tmp_path / "sandbox" / "model" / "catalog.py")
    )
    monkeypatch.setattr(level_catalog, "root", level_catalog.root.__wrapped__)

    assert level_catalog.root() == tmp_path / found
    assert level_catalog.names() == []


@pytest.mark.parametrize("name", level_catalog.names())
def test_every_level_of_the_project_is_found_and_well_formed(name: str) -> None:
    assert textbook(name).title


def test_levels_stand_in_the_order_that_a_file_tells_and_others_after_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("newton/atwood", "newton/rocket", "newton/incline", "energy/ramp"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / f"{name}.json").touch()
    (tmp_path / level_catalog.ORDER).write_text("energy/ramp\nnewton/rocket\nnewton/incline\n")
    monkeypatch.setattr(level_catalog, "root", lambda: tmp_path)

    assert level_catalog.names() == [
        "newton/rocket",
        "newton/incline",
        "newton/atwood",
        "energy/ramp",
    ]


def test_the_order_names_levels_that_exist_and_each_once() -> None:
    told = (level_catalog.root() / level_catalog.ORDER).read_text("utf-8").split()

    assert len(told) == len(set(told))
    assert set(told) <= set(level_catalog.names())
