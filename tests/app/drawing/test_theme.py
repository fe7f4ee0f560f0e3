"""The themes: every colour is defined in one place, and texts contrast with their background."""

import ast
import json
import re
from importlib.resources import files
from pathlib import Path
from typing import Any

import pygame
import pytest

from sandbox.app.drawing import theme
from sandbox.app.drawing.theme import NAMES, Color, Name
from sandbox.app.files import preferences
from sandbox.app.window import Window
from tests.app.person import Person
from tests.app.scenes import falling

APP = Path(str(files("sandbox.app")))
MODULES = sorted(APP.rglob("*.py"))
GROUNDS = ("stage", "panel")
INKS = (
    "text", "dim", "strong", "accent", "notice", "passed", "failed", "waiting", "ghost", "arrow",
    "across", "upwards", "acceleration", "resultant", "kinetic", "potential", "total",
)  # fmt: skip
SEVERAL = ("forces", "lanes", "bodies")


def luminance(color: Color) -> float:
    """Return how bright a colour is, from 0 to 1, as WCAG 2 defines it."""
    shares = (part / 255 for part in color)
    red, green, blue = (s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4 for s in shares)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(a: Color, b: Color) -> float:
    """Return the contrast of two colours: from 1 for equal ones to 21 (WCAG 2)."""
    dark, bright = sorted((luminance(a), luminance(b)))
    return (bright + 0.05) / (dark + 0.05)


def least(name: Name) -> float:
    """Return the contrast that a text needs: WCAG 2's AA, or AAA in the high-contrast theme."""
    return 7.0 if name == "contrast" else 4.5


def told(name: Name) -> dict[str, Any]:
    """Return a theme as its file declares it."""
    return dict(json.loads((APP / "themes" / f"{name}.json").read_text(encoding="utf-8")))


@pytest.mark.parametrize("name", NAMES)
def test_each_theme_declares_each_colour_that_the_module_promises(name: Name) -> None:
    promised = {key.lower() for key in theme.__annotations__ if key.isupper()} - {"names", "dark"}
    dark = theme.palette("dark")
    palette = theme.palette(name)

    assert promised <= set(palette) == set(dark)
    assert palette["acting"].keys() == dark["acting"].keys()
    assert [len(palette[key]) for key in SEVERAL] == [len(dark[key]) for key in SEVERAL]


@pytest.mark.parametrize("name", NAMES)
def test_whatever_is_written_in_is_told_from_the_ground_it_is_written_on(name: Name) -> None:
    palette = theme.palette(name)
    inks = {ink: palette[ink] for ink in INKS} | dict(palette["acting"])
    inks |= {f"{key} {i}": each for key in SEVERAL for i, each in enumerate(palette[key])}

    weak = [
        (ink, ground)
        for ink, color in inks.items()
        for ground in GROUNDS
        if contrast(color, palette[ground]) < least(name)
    ]

    assert weak == []


@pytest.mark.parametrize("name", NAMES)
def test_the_captions_of_widgets_are_told_from_the_widgets(name: Name) -> None:
    look = json.loads((APP / "themes" / "widgets.json").read_text(encoding="utf-8"))
    defaults, palette = look["defaults"]["colours"], theme.palette(name)
    weak = []
    for part, each in look.items():
        colours = {**defaults, **each.get("colours", {})}
        for state in ("normal", "hovered", "selected", "active"):
            text, ground = colours[f"{state}_text"], colours[f"{state}_bg"]
            drawn = "slider" not in part and "bar" not in part  # those have no captions
            if drawn and contrast(palette[text], palette[ground]) < least(name):
                weak.append((part, state, text, ground))

    assert weak == []


def test_contrast_is_that_of_wcag() -> None:
    assert contrast((0, 0, 0), (255, 255, 255)) == pytest.approx(21)
    assert contrast((119, 119, 119), (255, 255, 255)) == pytest.approx(4.48, abs=0.005)


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(APP)))
def test_no_module_has_a_colour_of_its_own(path: Path) -> None:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    several = {
        id(n.value)
        for n in ast.walk(tree)
        if isinstance(n, ast.Assign) and (isinstance(n.targets[0], ast.Tuple) or _lengths(n.value))
    }
    texts = [n.value for n in ast.walk(tree) if isinstance(n, ast.Constant)]

    assert [t for t in texts if isinstance(t, str) and re.fullmatch("#[0-9a-fA-F]{6,8}", t)] == []
    assert [ast.unparse(n) for n in ast.walk(tree) if _is_a_color(n) and id(n) not in several] == []


def _lengths(value: ast.AST) -> bool:
    """Whether a constant of four numbers is none of opaque colours, which have three."""
    return isinstance(value, ast.Tuple) and len(value.elts) == 4


def _is_a_color(node: ast.AST) -> bool:
    """Whether a node is three or four numbers that can be a colour, or names one."""
    if isinstance(node, ast.Call):
        called = ast.unparse(node.func)
        named = any(isinstance(a, ast.Constant) and isinstance(a.value, str) for a in node.args[:1])
        return called == "pygame.Color" or (called.endswith(".fill") and named)
    if not isinstance(node, ast.Tuple) or len(node.elts) not in (3, 4):
        return False
    values = [e.value for e in node.elts if isinstance(e, ast.Constant)]
    numbers = [v for v in values if isinstance(v, int) and not isinstance(v, bool) and 0 <= v < 256]
    return len(numbers) == len(node.elts) and max(numbers) > 40  # fewer than that are lengths


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(APP)))
def test_no_module_holds_on_to_a_colour_of_the_theme(path: Path) -> None:
    """Otherwise it would not change with the theme."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    later = {
        id(node)
        for function in ast.walk(tree)
        if isinstance(function, ast.FunctionDef | ast.Lambda)
        for part in (function.body if isinstance(function.body, list) else [function.body])
        for node in ast.walk(part)
    }
    held = [
        ast.unparse(node)
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute) and id(node) not in later
        and ast.unparse(node.value) == "theme" and node.attr.isupper() and node.attr != "NAMES"
    ]  # fmt: skip
    imported = [
        alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module == "sandbox.app.drawing.theme"
        for alias in node.names
        if alias.name.lower() in theme.palette("dark")
    ]

    assert held + imported == []


@pytest.mark.sweep
def test_the_whole_window_changes_at_once_and_back(person: Person, tmp_path: Path) -> None:
    person.open(tmp_path, falling())
    person.wait(0.1)
    places = {"panel": (1100, 200), "stage": (400, 60), "bar": (640, 797), "list": (4, 790 - 60)}
    seen: dict[str, dict[str, tuple[int, int, int]]] = {}
    for name in ("dark", "light", "contrast", "dark"):
        assert theme.used() == name
        now = {where: person.color_at(place) for where, place in places.items()}
        assert now["panel"] == now["bar"] == now["list"] == theme.palette(name)["panel"]
        assert seen.setdefault(name, now) == now
        person.press(pygame.K_t, "\x14", pygame.KMOD_LCTRL)
        person.wait(0.1)

    assert len({values["stage"] for values in seen.values()}) == 3


def test_the_bodies_and_fields_take_the_colours_of_the_theme(
    person: Person, tmp_path: Path
) -> None:
    person.open(tmp_path, falling())
    person.press(pygame.K_t, "\x14", pygame.KMOD_LCTRL)
    person.wait(0.1)
    side = person.side
    field = side.parameters.row("g").field.rect

    assert person.color_at((field.right - 6, field.y + 6)) == theme.palette("light")["stage"]


def test_a_theme_is_kept_for_the_next_window(person: Person) -> None:
    person.press(pygame.K_t, "\x14", pygame.KMOD_LCTRL)

    assert preferences.WindowPreferences().chosen.theme == "light"


@pytest.mark.parametrize("text", ["", "{", '{"theme": "pink"}', '{"size": 7}', "[]", "\0"])
def test_broken_settings_are_as_good_as_none(text: str) -> None:
    preferences.file().parent.mkdir(parents=True)
    preferences.file().write_text(text, encoding="utf-8")

    assert preferences.WindowPreferences().chosen == preferences.Preferences()


def test_settings_of_a_later_version_are_kept_as_far_as_they_are_known() -> None:
    preferences.file().parent.mkdir(parents=True)
    preferences.file().write_text('{"theme": "light", "wings": 2}', encoding="utf-8")

    assert preferences.WindowPreferences().chosen.theme == "light"


def test_settings_that_cannot_be_read_are_told_once() -> None:
    assert not preferences.WindowPreferences().complaint()  # at a first start there are none
    preferences.file().parent.mkdir(parents=True)
    preferences.file().write_text('{"theme": "lig', encoding="utf-8")
    window = Window((1280, 800))

    window.open_level("newton/atwood")
    told = window.banner._note
    window.open_level("newton/incline")

    assert "settings.json cannot be read" in told
    assert not window.banner._note
    window.close()


def test_settings_that_cannot_be_kept_are_told_and_act_all_the_same(person: Person) -> None:
    preferences.file().parent.write_text("no folder")
    person.press(pygame.K_t, "\x14", pygame.KMOD_LCTRL)

    assert theme.used() == "light"
    assert "could not be saved" in person.window.banner._note
