"""The window. Only here is pygame imported; it is told to start without its greeting."""

import os

os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
