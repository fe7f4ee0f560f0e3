"""What a run's numerical error is, and which setting reaches a given accuracy.

Nothing here knows a closed form: a run is held against itself with smaller steps.
"""
