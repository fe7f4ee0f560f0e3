"""Hostile levels: each must be answered quickly and within bounds."""
