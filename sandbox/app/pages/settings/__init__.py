"""The page of the window's settings."""

from sandbox.app.pages.page import Page
from sandbox.app.pages.settings.panel import SettingsPage

PAGE = Page(
    name="settings",
    caption="Settings",
    key="0",
    text="theme, size of text, language, motion and sound",
    panel=SettingsPage,
    energy=False,
)
