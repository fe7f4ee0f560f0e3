"""The level's own page."""
