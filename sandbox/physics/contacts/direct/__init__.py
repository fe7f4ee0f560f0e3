"""Contacts solved directly, together with the exact joints of what touches."""
