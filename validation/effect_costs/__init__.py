"""The cost of effects."""
