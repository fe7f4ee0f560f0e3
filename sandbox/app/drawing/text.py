"""Renders text in pygame_gui's Noto Sans, and caches it."""

import re
from bisect import bisect_right
from functools import cache, lru_cache
from importlib.resources import files
from itertools import groupby
from unicodedata import category, normalize

import pygame

from sandbox.app.drawing import theme
from sandbox.app.drawing.theme import Color

SIGNS = "/\\._-"
"""The characters after which a word that does not fit on a line is broken, such as a path."""

SYLLABLE = re.compile(
    r"(?:sch[lmnrw]?|(?<!s)ch|ck|ph|th|(?<![cpt])h|(?<!c)k|(?<!sch)[lmnrw]|[bcdfgjpqstvxzß])"
    r"(?=[aeiouyäöü])",
    re.IGNORECASE,
)
"""The consonants with which a syllable begins: the last ones before a vowel."""
SHORT = 3  # letters, the least before and after a hyphen
PUNCTUATION = ".,;:!?()"

NO_LETTER = "\U0010ffff"

FITTED = (
    (re.compile("−"), "–"),
    (re.compile(r" (?=J\b)"), " \u200a"),
    (re.compile(r"r\.(?=\w)"), "r\u200a."),
)
"""Characters that are replaced, since Noto Sans draws them badly in small sizes.

Its minus is as short as a hyphen, a J reaches into the space before it, and an r hides the point
after it.
"""


def legible(text: str) -> str:
    """Return a text on one line, without characters of zero width, which SDL refuses to draw.

    Examples are marks for the direction of writing, surrogates, and the null character.
    """
    if text.isascii() and text.isprintable():
        return text
    shown = (" " if letter.isspace() else letter for letter in normalize("NFC", text))
    return "".join(letter for letter in shown if letter.isprintable())


def typed(text: str) -> str:
    """Return the part of a text that a field accepts, in which each character has a width."""
    return "".join(letter for letter in legible(text) if category(letter) not in ("Mn", "Me"))


class Pen:
    """Renders text. A window has one pen, made after `pygame.font.init()`.

    Attributes
    ----------
    scale
        The factor by which text, and everything around it, is larger than the standard size.
    """

    def __init__(self, scale: float = 1.0) -> None:
        self.renew(scale)

    def renew(self, scale: float) -> None:
        """Set the scale, and use the colours of the current theme."""
        self.scale = scale
        self._fonts = lru_cache(maxsize=32)(_font)
        self._spare_fonts = lru_cache(maxsize=8)(_spare)
        self.write = lru_cache(maxsize=300)(self._write)
        self.outlined = lru_cache(maxsize=100)(self._outlined)

    def px(self, length: float) -> int:
        """Return a length, given at the standard scale, at the current one [px]."""
        return round(length * self.scale)

    def font(self, size: int, bold: bool) -> pygame.font.Font:
        """Return the font of a size, given at the standard scale."""
        return self._fonts(self.px(size), bold)

    def spare(self, size: int) -> pygame.font.Font:
        """Return the font for characters that the main font lacks."""
        return self._spare_fonts(self.px(size))

    def _write(
        self, text: str, size: int = 14, color: Color | None = None, bold: bool = False
    ) -> pygame.Surface:
        """Return a line of text on a transparent surface."""
        font, text, color = self.font(size, bold), _fitted(text), color or theme.TEXT
        if text.isascii():
            return font.render(text, True, color)
        runs = groupby(text, key=_lacks)
        parts = [
            _drawn(self.spare(size) if lacking else font, "".join(letters), color)
            for lacking, letters in runs
        ]
        width = sum(part.width for part in parts)
        line = pygame.Surface((width, font.get_height()), pygame.SRCALPHA)
        x = 0
        for part in parts:
            line.blit(part, (x, (line.height - part.height) // 2))
            x += part.width
        return line

    def _outlined(self, text: str, size: int = 12, color: Color | None = None) -> pygame.Surface:
        """Return a line of text with an outline, legible on any background."""
        inner, rim = self.write(text, size, color), self.write(text, size, theme.STAGE)
        line = pygame.Surface((inner.width + 2, inner.height + 2), pygame.SRCALPHA)
        for place in ((0, 0), (2, 0), (0, 2), (2, 2), (1, 0), (0, 1), (2, 1), (1, 2)):
            line.blit(rim, place)
        line.blit(inner, (1, 1))
        return line

    def height(self, size: int = 14, bold: bool = False) -> int:
        """Return the height of a line [px]."""
        return self.font(size, bold).get_linesize()

    def wrap(self, text: str, width: int, size: int = 14, bold: bool = False) -> list[str]:
        """Break text into lines of at most a width [px]."""
        font = self.font(size, bold)
        lines: list[str] = []
        for paragraph in text.splitlines():
            line = ""
            for word in legible(paragraph).split(" "):
                longer = f"{line} {word}" if line else word
                if font.size(_fitted(longer))[0] <= width:
                    line = longer
                    continue
                lines += [line] if line else []
                *whole, line = self._pieces(word, width, font)
                lines += whole
            lines.append(line)
        return lines

    def paragraph(
        self,
        text: str,
        width: int,
        size: int = 14,
        color: Color | None = None,
        bold: bool = False,
    ) -> list[pygame.Surface]:
        """Return the lines of a wrapped text."""
        return [self.write(line, size, color, bold) for line in self.wrap(text, width, size, bold)]

    def shorten(self, text: str, width: int, size: int = 14) -> str:
        """Return a text, cut with … at the end if it is wider than a width [px]."""
        font, text = self.font(size, False), legible(text)
        if font.size(_fitted(text))[0] <= width:
            return text
        fitting = bisect_right(
            range(len(text)), width, key=lambda n: font.size(_fitted(f"{text[:n]}…"))[0]
        )
        return f"{text[: max(fitting - 1, 0)].rstrip()}…"

    @staticmethod
    def _pieces(word: str, width: int, font: pygame.font.Font) -> list[str]:
        """Break a word that is wider than a line: after one of `SIGNS`, or between syllables."""
        pieces = []
        while len(word) > 1 and font.size(word)[0] > width:
            end, hyphen = _broken(word, width, font)
            pieces.append(word[:end] + hyphen)
            word = word[end:]
        return [*pieces, word]


def _broken(word: str, width: int, font: pygame.font.Font) -> tuple[int, str]:
    """Return the number of letters of a word on the first line, and the hyphen after them."""
    ends = range(1, len(word))
    most = max(bisect_right(ends, width, key=lambda end: font.size(word[:end])[0]), 1)
    sign = max(word.rfind(sign, 0, most) for sign in SIGNS) + 1
    if sign >= most / 2:
        return sign, ""
    if word.strip(PUNCTUATION).isalpha():
        syllables = (found.start() for found in SYLLABLE.finditer(word))
        for end in reversed([end for end in syllables if SHORT <= end <= len(word) - SHORT]):
            if font.size(f"{word[:end]}-")[0] <= width:
                return end, "-"
    return most, ""


def _fitted(text: str) -> str:
    """Return a legible text with the characters that are drawn best."""
    text = legible(text)
    for badly, better in FITTED:
        text = badly.sub(better, text)
    return text


def _drawn(font: pygame.font.Font, text: str, color: Color) -> pygame.Surface:
    """Return a text as drawn by a font; empty for a text without width, such as lone accents."""
    if font.size(text)[0] > 0:
        return font.render(text, True, color)
    return pygame.Surface((0, font.get_height()), pygame.SRCALPHA)


@lru_cache(maxsize=500)
def _lacks(letter: str) -> bool:
    """Whether Noto Sans lacks a character, and draws its box for missing ones."""
    return _shape(letter) == _box()


@cache
def _box() -> tuple[tuple[int, int], bytes]:
    return _shape(NO_LETTER)


def _shape(letter: str) -> tuple[tuple[int, int], bytes]:
    """Return the size and the pixels of a character in Noto Sans, in black whatever the theme."""
    shown = _drawn(_font(16, False), letter, (0, 0, 0))
    return shown.size, shown.get_buffer().raw


def _font(size: int, bold: bool) -> pygame.font.Font:
    name = "NotoSans-Bold.ttf" if bold else "NotoSans-Regular.ttf"
    return pygame.font.Font(str(files("pygame_gui") / "data" / name), size)


def _spare(size: int) -> pygame.font.Font:
    """Return the font for characters that Noto Sans lacks: roots, arrows and other symbols."""
    return pygame.font.Font(str(files("pygame_gui") / "data" / "FiraCode-Regular.ttf"), size)
