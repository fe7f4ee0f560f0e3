"""The page of the window's settings."""

from sandbox.app.pages.page import Page, imported

PAGE = Page(
    name="settings",
    caption="Settings",
    key="0",
    text="theme, size of text, language, motion and sound",
    panel=imported("sandbox.app.pages.settings.panel", "SettingsPage"),
    energy=False,
)
