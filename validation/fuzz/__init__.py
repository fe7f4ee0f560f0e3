"""Levels that nobody would write: whatever they hold, each is answered, soon and within bounds."""
