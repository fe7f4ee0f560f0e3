"""The content of a level: its format, its expressions, reading it, and its possible mistakes."""
