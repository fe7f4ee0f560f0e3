"""Strings that share a body, solved together.

One after the other they would undo each other's work. So all their impulses p are unknown at once,
and Newton's method finds those that keep every length through the next drift:

    excess_s(p) = Σ over the ends of s of |arm + h v − h/m Σ p n| − L_s = 0    where p_s pulls

Which strings are taut follows from the guess before: those that pull, and those that are too long
(a primal-dual active set; Hintermüller, Ito and Kunisch 2002).
"""

from collections.abc import Callable, Iterable, Sequence

import numpy as np
import pymunk

from sandbox.model.expressions import Array
from sandbox.physics.pulley import TOLERANCE, PulleyString

MAX_ITERATIONS = 50


def solvers(strings: Iterable[PulleyString]) -> list[Callable[[], None]]:
    """Return what solves the strings: alone, or together where they share bodies that move."""
    groups: list[list[PulleyString]] = []
    for string in strings:
        moving = _moving(string)
        joined = [g for g in groups if any(moving & _moving(other) for other in g)]
        groups = [g for g in groups if g not in joined]
        groups.append([*(other for g in joined for other in g), string])
    return [Coupled(group).solve if len(group) > 1 else group[0].solve for group in groups]


def _moving(string: PulleyString) -> set[pymunk.Body]:
    return {b for b, inverse in zip(string.ends, string.inverse_masses, strict=True) if inverse}


class Coupled:
    """Strings that share bodies, directly or through each other: s of them with e = 2 s ends."""

    def __init__(self, strings: Sequence[PulleyString]) -> None:
        self._strings = strings
        ends = [body for string in strings for body in string.ends]
        self._bodies = list(dict.fromkeys(ends))
        self._at = np.array([self._bodies.index(body) for body in ends])
        self._pegs = np.array([peg for string in strings for peg in string.pegs])
        self._inverse = np.array([i for string in strings for i in string.inverse_masses])
        same = self._at[:, None] == self._at
        self._moves = np.where(same, self._inverse, 0.0)  # (e, e), one end by a pull at another
        self._moves.setflags(write=False)

    def solve(self) -> None:
        """Find the impulses that keep all lengths through the next drift, and apply the rest."""
        drift = self._strings[0].drift
        position = np.array([body.position for body in self._bodies])
        velocity = np.array([body.velocity for body in self._bodies])
        arm = position[self._at] - self._pegs
        unit = self._units(arm)
        impulse = self._newton(arm + drift * velocity[self._at], unit, drift)
        pull = (np.repeat(impulse, 2) * self._inverse)[:, None] * unit
        np.subtract.at(velocity, self._at, pull)
        for index in set(self._at[self._inverse > 0].tolist()):
            self._bodies[index].velocity = tuple(velocity[index].tolist())
        for string, value in zip(self._strings, impulse.tolist(), strict=True):
            string.pulled(value)

    def _units(self, arm: Array) -> Array:
        """Return the directions of the ends from their pegs: (e, 2)."""
        size = np.hypot(arm[:, 0], arm[:, 1])
        if (bad := (size == 0) & (self._inverse > 0)).any():
            raise self._strings[int(np.argmax(bad)) // 2].at_a_peg()
        return arm / np.where(size > 0, size, 1.0)[:, None]

    def _newton(self, goes: Array, unit: Array, drift: float) -> Array:
        """Return the impulses beyond the warm start's (s,), if the ends go there without [N s]."""
        length = np.array([string.free_length for string in self._strings])
        least = np.array([-string.warm * string.kick for string in self._strings])
        impulse = np.zeros(len(length))
        for _ in range(MAX_ITERATIONS):
            arm = goes - drift * self._moves @ (np.repeat(impulse, 2)[:, None] * unit)
            reach = np.hypot(arm[:, 0], arm[:, 1])
            excess = reach.reshape(-1, 2).sum(axis=1) - length
            taut = (impulse > least) | (excess > TOLERANCE * length)
            if (np.abs(excess[taut]) <= TOLERANCE * length[taut]).all():
                return impulse
            towards = arm / np.where(reach > 0, reach, 1.0)[:, None]
            slope = drift * self._moves * (towards @ unit.T)
            slope = slope.reshape(len(length), 2, len(length), 2).sum(axis=(1, 3))
            if (bad := taut & (slope.diagonal() <= 0)).any():
                raise self._strings[int(np.argmax(bad))].at_a_peg()
            before = impulse
            step = np.linalg.lstsq(slope[np.ix_(taut, taut)], excess[taut])[0]
            impulse = before.copy()
            impulse[taut] += step
            impulse = np.maximum(impulse, least)
            if np.abs(impulse - before).max() <= 1e-15 * np.abs(impulse).max():
                return impulse
        raise self._strings[int(np.argmax(excess))].too_short()
