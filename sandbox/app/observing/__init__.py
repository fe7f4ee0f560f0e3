"""Observations of a run, for pages, cards and the stage."""
