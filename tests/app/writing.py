"""What is written, and where."""

import pygame
import pytest

from sandbox.app.drawing.text import Pen
from sandbox.app.stage.label_placement import Labels
from sandbox.model.shapes import XY


def noted(pen: Pen, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return a list of what the pen writes from now on."""
    written: list[str] = []
    write = pen.write

    def note(text: str, size: int = 14, *more: object) -> pygame.Surface:
        written.append(text)
        return write(text, size, *more)

    monkeypatch.setattr(pen, "write", note)
    return written


def placed(monkeypatch: pytest.MonkeyPatch) -> tuple[list[pygame.Rect], list[tuple[XY, XY]]]:
    """Return lists of where words stand from now on, and of the lines that they keep off."""
    places: list[pygame.Rect] = []
    lines: list[tuple[XY, XY]] = []
    find, mark = Labels.place_for, Labels.mark

    def found(self: Labels, *told: object, **how: object) -> pygame.Rect | None:
        place = find(self, *told, **how)  # type: ignore[arg-type]
        places.extend([place] if place else [])
        return place

    def marked(self: Labels, start: XY, end: XY) -> None:
        lines.append((start, end))
        mark(self, start, end)

    monkeypatch.setattr(Labels, "place_for", found)
    monkeypatch.setattr(Labels, "mark", marked)
    return places, lines
