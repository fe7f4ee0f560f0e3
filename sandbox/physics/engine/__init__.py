"""Access to pymunk's objects: bodies and contacts as arrays, and callbacks in a step."""
