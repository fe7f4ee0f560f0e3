"""A kick, from the contacts at its beginning to its result."""
