"""The present speed of the machine: the time of a fixed piece of work.

A core is half as fast while its twin is busy, and machines differ by more. What a level needs is
therefore told in the time of one machine as well: the measured time, by what the yardstick took
beside it, times what the yardstick takes there.
"""

from time import process_time

import numpy as np

REFERENCE = 3.05e-3
"""s, the time of the yardstick on an idle core of the reference machine: a slow one, two cores of a
server shared by many."""

ROUNDS = 60
"""The rounds of the yardstick."""

SIZE = 12
"""The rows of its matrices: about as many as a linkage has."""

_MATRIX = np.eye(SIZE) * SIZE + np.cos(np.arange(SIZE**2)).reshape(SIZE, SIZE)
_VECTOR = np.sin(np.arange(SIZE))


def yardstick() -> float:
    """Return what the work takes of the processor now [s].

    It is what steps are made of: arithmetic in Python, numpy on small arrays, small systems.
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
