"""What is said over the stage: banners, the help, and why a level cannot be opened."""

from html import escape

import pygame
from pygame_gui import UIManager
from pygame_gui.core import ObjectID
from pygame_gui.elements import UIButton, UITextBox

from sandbox.app import theme
from sandbox.app.keys import BINDINGS, MOUSE
from sandbox.app.text import Pen
from sandbox.app.theme import Color

PADDING = 12  # px
OFFER = 220, 38  # px


def draw_banner(
    surface: pygame.Surface, pen: Pen, area: pygame.Rect, text: str, color: Color
) -> int:
    """Draw a note at the top of an area, and return where it ends [px]."""
    lines = pen.paragraph(text, min(area.width - 60, 640), 14, theme.TEXT)
    width = max(line.width for line in lines) + 2 * PADDING + 6
    height = sum(line.height for line in lines) + 2 * PADDING - 6
    box = pygame.Rect(0, 0, width, height)
    box.midtop = area.centerx, area.y + 14
    pygame.draw.rect(surface, theme.RAISED, box, border_radius=6)
    pygame.draw.rect(surface, color, box, 1, border_radius=6)
    surface.fill(color, (box.x + 1, box.y + 6, 3, box.height - 12))
    y = box.y + PADDING - 3
    for line in lines:
        surface.blit(line, (box.x + PADDING + 3, y))
        y += line.height
    return box.bottom


def draw_help(surface: pygame.Surface, pen: Pen, area: pygame.Rect) -> None:
    """Draw the table of keys in the middle of an area."""
    rows = [(binding.shown, binding.text) for binding in BINDINGS]
    height = min(22, (area.height - 110) // (len(rows) + len(MOUSE) + 1))
    size = 14 if height >= 20 else 12
    left = max(pen.write(key, size, theme.ACCENT, True).width for key, _ in (*rows, *MOUSE))
    right = max(pen.write(text, size).width for _, text in (*rows, *MOUSE))
    box = pygame.Rect(0, 0, left + right + 76, (len(rows) + len(MOUSE) + 1) * height + 70)
    box.center = area.center
    box.clamp_ip(surface.get_rect())
    pygame.draw.rect(surface, theme.PANEL, box, border_radius=8)
    pygame.draw.rect(surface, theme.ACCENT, box, 1, border_radius=8)
    surface.blit(pen.write("Keys and mouse", 18, bold=True), (box.x + 24, box.y + 16))
    y = box.y + 52
    for key, text in (*rows, ("", ""), *MOUSE):
        surface.blit(pen.write(key, size, theme.ACCENT, True), (box.x + 24, y))
        surface.blit(pen.write(text, size), (box.x + 24 + left + 28, y))
        y += height


def offer(manager: UIManager, stage: pygame.Rect, rate: float) -> UIButton:
    """Offer to run again at a rate at which it should hold."""
    box = pygame.Rect((0, 0), OFFER)
    box.midbottom = stage.centerx, stage.bottom - 16
    return UIButton(box, f"Run at {rate:,.0f} Hz", manager, object_id=ObjectID(class_id="@main"))


def refusal(manager: UIManager, stage: pygame.Rect, text: str) -> UITextBox:
    """Show in full why a level cannot be opened; it scrolls."""
    box = stage.inflate(-min(80, stage.width // 8), -min(120, stage.height // 6))
    shown = "<br>".join(escape(line) for line in text.splitlines())
    title = "<font color=#ff7043><b>This level cannot be opened</b></font>"
    way_out = "Mend the file and press F5, or choose another level."
    html = f"{title}<br><br>{shown}<br><br><font color=#91a0b5>{way_out}</font>"
    return UITextBox(html, box, manager)
