"""Whatever can be saved from a run, as a player saves it."""

import json
from io import BytesIO
from pathlib import Path

import numpy as np
import pygame
import pytest

from sandbox.app import film
from sandbox.app.background_process import Background
from sandbox.app.files import save_folder
from sandbox.app.pages.share.background_film import FilmWorker
from sandbox.app.pages.share.panel import KINDS, SharePage
from sandbox.app.runs import run_file
from sandbox.app.runs.session import Session
from sandbox.editing.run_as_level import as_it_stands
from sandbox.model import level_catalog
from sandbox.model.loading import load
from tests.app import scenes
from tests.app.person import Person


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The person's own folder."""
    place = tmp_path / "documents"
    monkeypatch.setattr(save_folder, "folder", lambda: place)
    return place


def page(person: Person) -> SharePage:
    person.press(pygame.K_w, "w")
    return person.page(SharePage)


def played(person: Person, level: str = "newton/atwood") -> SharePage:
    person.window.open_level(level)
    person.session.restart({"m2": 2.0})
    person.press(pygame.K_SPACE, " ")
    person.wait(0.5)
    person.press(pygame.K_SPACE, " ")
    return page(person)


@pytest.mark.sweep
@pytest.mark.parametrize("kind", KINDS, ids=[caption for caption, _, _ in KINDS])
def test_each_button_saves_a_file_with_a_name_of_its_own(
    person: Person, folder: Path, kind: tuple[str, str, object]
) -> None:
    shown = played(person)

    person.click(shown.button(kind[0]).rect)
    person.click(shown.button(kind[0]).rect)

    files = sorted(folder.iterdir())
    assert len(files) == 2
    assert all(file.name.startswith("atwood-machine ") for file in files)
    assert all(file.stat().st_size > 100 for file in files)


def test_a_picture_is_what_the_window_shows(person: Person, folder: Path) -> None:
    shown = played(person)
    before = pygame.surfarray.array3d(person.window.surface)

    person.click(shown.button("Picture").rect)

    (file,) = folder.iterdir()
    saved = pygame.surfarray.array3d(pygame.image.load(file))
    assert saved.shape == before.shape
    assert (saved == before).mean() > 0.97


def test_a_run_is_replayed_to_the_last_bit(person: Person, folder: Path) -> None:
    shown = played(person)
    steps = person.session.world.steps

    person.click(shown.button("Run").rect)

    (file,) = folder.iterdir()
    run = run_file.read(file)
    assert run.steps == steps
    assert run.parameters["m2"] == 2.0
    assert run_file.is_same(run, run_file.replay(run))


def test_a_copy_of_a_level_has_its_present_values(person: Person, folder: Path) -> None:
    shown = played(person)

    person.click(shown.button("Level").rect)

    (file,) = folder.iterdir()
    copy = load(file)
    assert copy.defaults["m2"] == 2.0
    assert copy.checks == person.session.original.checks


def test_a_copy_of_a_level_has_no_parameter_that_the_run_alone_has(
    person: Person, folder: Path
) -> None:
    shown, session = played(person), person.session
    changed = json.loads(as_it_stands(session.world, anew=False))
    changed["parameters"]["G"] = {"value": 1, "min": 0.5, "max": 2}
    body = next(body for body in changed["bodies"].values() if "mass" in body)
    body["mass"] = f"G*({body['mass']})"
    session.alter(json.dumps(changed))

    person.click(shown.button("Level").rect)

    (file,) = folder.iterdir()
    assert load(file).defaults == {**session.original.defaults, "m2": 2.0}


def test_a_folder_that_cannot_be_made_is_told(person: Person, folder: Path) -> None:
    folder.write_text("a file")
    shown = played(person)

    person.click(shown.button("Table").rect)

    assert "cannot" in person.window.banner._note


@pytest.mark.parametrize("kind", ["gif", "mp4"])
def test_a_film_shows_the_run_from_its_start_to_its_end(kind: film.Kind, tmp_path: Path) -> None:
    session = Session(load(level_catalog.find("kinematics/projectile")))
    for _ in range(30):
        session.step()

    *done, told = film.film(run_file.run_of(session), tmp_path / f"x.{kind}", kind)

    assert told == f"saved {tmp_path / f'x.{kind}'}"
    assert all(0 <= share <= 1 for share in done if isinstance(share, float))
    frames = _frames((tmp_path / f"x.{kind}").read_bytes(), kind)
    assert len(frames) == 14  # 0.5 s at 25 frames a second, from its first to its last
    assert np.abs(frames[0].astype(int) - frames[-1]).max() > 100
    assert frames[0].shape == (*film.SIZE[kind][::-1], 3)


def _frames(content: bytes, kind: film.Kind) -> list[np.ndarray]:
    import av

    with av.open(BytesIO(content), "r", format=kind) as container:
        return [frame.to_ndarray(format="rgb24") for frame in container.decode(video=0)]


def test_without_an_encoder_for_videos_a_run_can_be_a_gif(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "av", None)
    run = run_file.run_of(Session(load(level_catalog.find("newton/atwood"))))

    assert list(film.film(run, tmp_path / "x.mp4", "mp4")) == [film.LACKING]
    assert not list(tmp_path.iterdir())
    *_, told = film.film(run, tmp_path / "x.gif", "gif")
    assert told == f"saved {tmp_path / 'x.gif'}"


def test_a_film_shows_what_the_observer_sees(tmp_path: Path) -> None:
    """Seen from the ball that falls, the ball stays where it is in the picture."""
    session = Session(scenes.level())
    for _ in range(30):
        session.step()
    run, moved = run_file.run_of(session), []
    for place in (None, "ball"):
        path = tmp_path / f"{place}.gif"
        list(film.film(run, path, "gif", place))
        first, *_, last = _frames(path.read_bytes(), "gif")
        before, after = (np.argwhere(_is_red(picture)).mean(axis=0) for picture in (first, last))
        moved.append(np.abs(after - before).max())

    assert moved[0] > 30
    assert moved[1] < 2


def _is_red(picture: np.ndarray) -> np.ndarray:
    red, green, blue = picture.astype(int).transpose(2, 0, 1)
    found: np.ndarray = (red > 150) & (green < 60) & (blue < 60)
    return found


@pytest.mark.parametrize("second", ["GIF", "MP4"])
def test_a_film_that_is_being_made_is_not_given_up_for_another(
    person: Person, second: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: list[object] = []
    monkeypatch.setattr(Background, "running", property(lambda _: bool(begun)))
    monkeypatch.setattr(Background, "start", lambda _, *work: begun.append(work))
    shown = played(person)

    person.click(shown.button("GIF").rect)
    person.click(shown.button(second).rect)

    assert len(begun) == 1
    assert person.window.banner.is_showing("one film at a time: the next when this one is saved")


def test_how_far_a_film_is_has_its_place_on_the_page(
    person: Person, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = played(person)
    free = shown._state.relative_rect.copy()

    monkeypatch.setattr(Background, "running", True)
    shown.update()

    assert shown._state.relative_rect == free


def test_where_a_film_was_saved_stays_on_the_page(person: Person) -> None:
    """It was told for five seconds, which are over when somebody looks up after a long film."""
    shown = played(person)
    before = pygame.surfarray.array3d(shown._drawn())

    person.window.workers.of(FilmWorker).message = "saved projectile.gif"

    assert not np.array_equal(before, pygame.surfarray.array3d(shown._drawn()))


def test_a_long_path_of_a_film_is_shown_in_full(person: Person) -> None:
    """The page ended after its first line."""
    person.resize((900, 600))
    shown = played(person)

    work = person.window.workers.of(FilmWorker)
    work.message, work.news = "saved " + "a long name " * 12, object()
    person.wait()

    contents = shown._sheet.container.scrollable_container.rect
    assert contents.height >= shown._state.relative_rect.bottom
