"""The page on which levels are built."""

import pygame

from sandbox.app.building import editor_keys
from sandbox.app.building.editor import Editor
from sandbox.app.pages.build.panel import BuildPage
from sandbox.app.pages.page import Desk, Page, PageCommand


def _new(desk: Desk) -> None:
    desk.worker(Editor).new(desk.session)


def _save(desk: Desk) -> None:
    desk.worker(Editor).save(desk.session)


PAGE = Page(
    name="build",
    caption="Build",
    key="b",
    text="build a level with the mouse",
    panel=BuildPage,
    worker=Editor,
    commands=(
        PageCommand("new scene", "B", "build from an empty scene", _new, pygame.K_n),
        PageCommand("save level", "", "save the level as it is built", _save, pygame.K_s),
    ),
    keys=editor_keys.HELP,
    energy=False,
)
