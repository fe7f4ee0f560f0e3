"""The page on which levels are built."""

import pygame

from sandbox.app.pages.page import Desk, Page, PageCommand, imported


def _new(desk: Desk) -> None:
    from sandbox.app.building.editor import Editor

    desk.worker(Editor).new(desk.session)


def _save(desk: Desk) -> None:
    from sandbox.app.building.editor import Editor

    desk.worker(Editor).save(desk.session)


PAGE = Page(
    name="build",
    caption="Build",
    key="b",
    text="build a level with the mouse",
    panel=imported("sandbox.app.pages.build.panel", "BuildPage"),
    worker=imported("sandbox.app.building.editor", "Editor"),
    commands=(
        PageCommand("new scene", "B", "build from an empty scene", _new, pygame.K_n),
        PageCommand("save level", "", "save the level as it is built", _save, pygame.K_s),
    ),
    own_keys=imported("sandbox.app.building.editor_keys", "keys_in_help"),
    energy=False,
)
