"""Data that the window keeps in the user's files."""
