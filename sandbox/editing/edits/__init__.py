"""The edits of a level, a module a family: functions from a text to another.

Each takes the text of a level that loads, and the level; whatever it needs of the parameters'
values it takes as `values`, their defaults if left out. See `docs/how-to/edit-a-level.md`.
"""
