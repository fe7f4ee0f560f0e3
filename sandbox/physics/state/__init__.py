"""The state at a step as immutable data, and access to it."""
