"""Editing a level: typed text is preserved exactly, and every step can be undone.

The text of a level under edit is its single source of truth. An edit is a function from a text to
another text (`sandbox.editing.edits`), made of patches (`text_patches`); a `Draft` (`draft`) keeps
the text, the level that it loads as, the undo steps and the file. Nothing here depends on a window.
For more, see `docs/how-to/edit-a-level.md`.
"""
