"""The present speed of the machine: the time of a fixed piece of work.

A core is half as fast while its twin is busy, and machines differ by more. Loads are therefore also
given for a reference machine: the measured time, divided by the time of the yardstick beside it,
times the yardstick's time on that machine.
"""

from time import process_time

import numpy as np

REFERENCE = 3.05e-3
"""The time of the yardstick on an idle core of the reference machine [s]: a slow one, two cores of
a shared server."""

ROUNDS = 60
"""The repetitions of the yardstick's work."""

SIZE = 12
"""The rows of its matrices: about as many as a linkage has."""

_MATRIX = np.eye(SIZE) * SIZE + np.cos(np.arange(SIZE**2)).reshape(SIZE, SIZE)
_VECTOR = np.sin(np.arange(SIZE))


def yardstick() -> float:
    """Return the present processor time of the yardstick [s].

    Its work resembles that of steps: arithmetic in Python, numpy on small arrays, small systems.
    """
    begun = process_time()
    found, place = _VECTOR, 1.0
    for _ in range(ROUNDS):
        found = np.linalg.solve(_MATRIX, _VECTOR + found)
        found = np.where(found > 0, np.abs(found), found * 0.5)
        found = np.concatenate((found[1:], found[:1])) + _MATRIX.dot(_VECTOR).take(0)
        for turn in range(100):
            place = 0.5 * place + abs(place - turn) / (1.0 + place * place)
        found = np.clip(found, -1.0, place)
    return process_time() - begun
