"""Experiments: many runs of a level over its parameters, measured, stored and plotted.

`plan` defines the runs, `running` executes some of them, `executors` decide where, `storage` keeps
the results, `analysis` and `report` evaluate them.
"""
