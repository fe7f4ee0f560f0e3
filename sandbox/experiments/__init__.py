"""Experiments: many runs of a level over its parameters, measured, kept and drawn.

`plan` says what is run, `running` runs some of it, `executors` say where, `storage` keeps what
comes of it, `analysis` and `report` make something of that.
"""
