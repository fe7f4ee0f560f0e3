"""Editing a level: typed text is kept to the character, and every step can be undone.

The truth of a level under edit is its text. An edit is a function from a text to another text
(`sandbox.editing.edits`), made of patches (`patches`); a `Draft` (`draft`) keeps the text, what it
loads as, its undo and its file. Nothing here knows of a window. `docs/how-to/edit-a-level.md` tells
the rest.
"""
