"""Shapes in pymunk's space, and what they let through."""
