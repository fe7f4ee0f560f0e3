"""What a level says: its format, its expressions, how it is read, and what can be wrong with it."""
