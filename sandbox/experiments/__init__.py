"""Experiments: many runs of a level over its parameters, measured, stored and plotted.

`plan` defines the runs, `row_runs` executes some of them, `executors` decide where,
`experiment_folder` keeps the results, `result_statistics` and `report` evaluate them.
"""
