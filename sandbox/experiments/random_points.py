"""Random points of the unit cube: a row always gets the same ones, wherever it runs.

Points are made in blocks, each with a seed of its own, so that no row depends on earlier ones. Only
the points of a Latin hypercube depend on each other: there are at most a million of them.
"""

import warnings
from collections.abc import Callable
from functools import lru_cache
from typing import Literal

import numpy as np

from sandbox.model.expressions import Array

Method = Literal["random", "latin-hypercube", "sobol", "sobol-indices"]

BLOCK = 1024
"""The number of points in a block."""

MOST_IN_A_HYPERCUBE = 1_000_000


def points(method: Method, seed: int, dimensions: int, count: int, start: int, stop: int) -> Array:
    """Return some of the points: (stop − start, dimensions), with coordinates in (0, 1).

    The seed determines all `count` points. Methods: `random` takes independent points.
    `latin-hypercube` takes, in each dimension, one point in each of as many equal intervals as
    there are points. `sobol` is Sobol's sequence, scrambled (A. B. Owen, 1998); `sobol-indices`
    takes from it the rows of Saltelli's scheme for sensitivities.
    """
    if method == "sobol-indices":
        return _saltelli(seed, dimensions, start, stop)
    if method == "latin-hypercube":
        return _hypercube(seed, dimensions, count)[start:stop]
    make = _random if method == "random" else _sobol
    return _from_blocks(make, seed, dimensions, start, stop)


def _from_blocks(
    make: Callable[[int, int, int], Array], seed: int, dimensions: int, start: int, stop: int
) -> Array:
    first, last = start // BLOCK, -(-stop // BLOCK)
    blocks = [make(seed, dimensions, block) for block in range(first, last)]
    if not blocks:
        return np.empty((0, dimensions))
    return np.concatenate(blocks)[start - first * BLOCK : stop - first * BLOCK]


@lru_cache(maxsize=4)
def _random(seed: int, dimensions: int, block: int) -> Array:
    generator = np.random.Generator(np.random.PCG64(np.random.SeedSequence((seed, block))))
    return _inside(generator.random((BLOCK, dimensions)))


@lru_cache(maxsize=4)
def _sobol(seed: int, dimensions: int, block: int) -> Array:
    from scipy.stats import qmc

    sequence = qmc.Sobol(dimensions, scramble=True, rng=np.random.default_rng(seed))
    if block:
        sequence.fast_forward(block * BLOCK)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # each block is a power of two anyway
        return _inside(sequence.random(BLOCK))


@lru_cache(maxsize=1)
def _hypercube(seed: int, dimensions: int, count: int) -> Array:
    from scipy.stats import qmc

    return _inside(qmc.LatinHypercube(dimensions, rng=np.random.default_rng(seed)).random(count))


def _saltelli(seed: int, dimensions: int, start: int, stop: int) -> Array:
    """Return rows of Saltelli's scheme: for each point (A, B), A, B, and A with one column of B.

    A. Saltelli et al., Comput. Phys. Commun. 181 (2010) 259.
    """
    width = dimensions + 2
    first, last = start // width, -(-stop // width)
    both = _from_blocks(_sobol, seed, 2 * dimensions, first, last)
    a, b = both[:, :dimensions], both[:, dimensions:]
    rows = np.repeat(a[:, None], width, axis=1)
    rows[:, 1] = b
    for i in range(dimensions):
        rows[:, 2 + i, i] = b[:, i]
    return rows.reshape(-1, dimensions)[start - first * width : stop - first * width]


def _inside(probabilities: Array) -> Array:
    """Keep probabilities away from 0 and 1, where a normal distribution has no quantile."""
    return np.clip(probabilities, 2.0**-53, 1 - 2.0**-53)
