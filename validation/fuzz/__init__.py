"""Hostile levels: each must be answered, soon and within bounds."""
