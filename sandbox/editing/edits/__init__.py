"""The edits of a level, one module for each family: functions from a text to another.

Each takes the text of a level that loads, and the level; parameters have their default values.
See `docs/how-to/edit-a-level.md`.
"""
