"""Advice: faults found before a run, and remedies tried after one that had to stop."""
