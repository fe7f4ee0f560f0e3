"""Turns off NumPy's threads, which small matrices do not need."""

import os


def spare() -> None:
    """Let NumPy, once it is imported, work in the thread that asks, unless the user says otherwise.

    A step solves systems of a few equations. Beside other processes the threads of OpenBLAS wait
    for each other: a chain of 40 links then takes seven times as long.
    """
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
