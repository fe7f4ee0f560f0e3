"""Measurements of runs: recording, grading, comparison, free bodies, CSV files and timing."""
