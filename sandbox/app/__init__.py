"""The window. Only this package imports pygame, which starts without its greeting."""

import os

os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
