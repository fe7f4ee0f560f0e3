"""A 2D sandbox for classical mechanics, on pymunk, held against its closed forms."""

__version__ = "0.1.0"
