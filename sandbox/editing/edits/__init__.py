"""The edits of a level, a module a family: functions from a text to another.

Each takes the text of a level that loads, and the level; the parameters have their default values.
See `docs/how-to/edit-a-level.md`.
"""
