"""The numerical error of a run, and the setting that reaches a given accuracy.

No closed form is used: a run is compared with itself at smaller steps.
"""
