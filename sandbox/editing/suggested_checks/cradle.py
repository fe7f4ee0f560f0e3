"""Equal balls in a row, touching: as many leave at one end as arrive at the other, as fast."""

from cmath import phase
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from math import pi, sqrt
from typing import NamedTuple

from sandbox.editing.suggested_checks.collision import restitution
from sandbox.editing.suggested_checks.pendulum import SMALLEST, bob_of, swings_free
from sandbox.editing.suggested_checks.recogniser_input import (
    SAFE,
    TOUCHING,
    Scene,
    Suggestion,
    as_factor,
    check,
    opposite,
    rate_of,
)
from sandbox.model.expressions import Expression
from sandbox.model.joint_ends_at_start import end_position
from sandbox.model.joints import body_of, points
from sandbox.model.shapes import Disc

EXACT = 1e-9
"""The tolerance for free balls, whose impacts are exact to rounding."""

NEAR = 1e-4
"""The tolerance for swinging balls at the rate below: leapfrog is of second order."""

STEPS = 500
"""The number of steps of a period."""

STEEPEST = pi / 2
"""rad, the largest angle to which balls are lifted."""


class Row(NamedTuple):
    """Balls in a row, from the end at which some arrive, and the number of these."""

    balls: tuple[str, ...]
    coming: int

    @property
    def meet(self) -> list[str]:
        """The last arriving ball, and the first one at rest."""
        return list(self.balls[self.coming - 1 : self.coming + 1])


def suggestions(scene: Scene) -> Iterator[Suggestion]:
    """Yield the closed forms for cradles: balls that hang, or are on a line without gravity."""
    effects = scene.level.effects
    if effects.contact is None or effects.restitution is None or len(scene.dynamic) < 3:
        return
    if not scene.only("gravity", "contact", "restitution", "rotation"):
        return
    find = _on_a_line if effects.gravity is None else _hanging
    row = find(scene)
    if row and all(find(each) == row for each in scene.everywhere):
        yield _of_a_line(scene, row) if effects.gravity is None else _of_hanging(scene, row)


def _of_hanging(scene: Scene, row: Row) -> Suggestion:
    assert scene.gravity_y is not None
    first, last = row.balls[0], row.balls[-1]
    heights = [as_factor(scene.level.bodies[name].position[1]) for name in row.balls]
    g, mass = opposite(scene.gravity_y), scene.mass(first)
    at = {"event": "contact", "bodies": row.meet}
    speed = f"sqrt(2*{g}*({heights[0]} - {heights[-1]}))"
    energy = f"{mass}*{g}*({' + '.join(heights)})"
    checks = (
        check(f"{last}, after", f"{last}.speed", speed, NEAR, at=at),
        check(f"{first}, after", f"{first}.speed", "0", NEAR, at=at, scale=speed),
        check("energy", "system.energy", energy, NEAR, scale=f"{mass}*{speed}**2/2"),
    )
    beat = max(
        sqrt(-each.gravity_y(each.values) / abs(_hung(each)[first])) / (2 * pi)
        for each in scene.everywhere
        if each.gravity_y
    )
    return Suggestion("Newton's cradle", row.balls, checks, rate_of(STEPS * beat), row.balls)


def _of_a_line(scene: Scene, row: Row) -> Suggestion:
    first, last = row.balls[0], row.balls[-1]
    speed = as_factor(scene.level.bodies[first].velocity[0])
    at = {"event": "contact", "bodies": row.meet}
    more = {"at": at, "scale": f"abs({speed})"}
    checks = (
        check(f"{last}, after", f"{last}.velocity.x", speed, EXACT, **more),
        check(f"{first}, after", f"{first}.velocity.x", "0", EXACT, **more),
    )
    return Suggestion("Newton's cradle", row.balls, checks, located=row.balls)


def _hung(scene: Scene) -> dict[str, complex]:
    """Return the vectors from the pegs to the centres of balls that hang at rest, by ball [m]."""
    found = dict[str, complex]()
    for joint in scene.level.joints.values():
        if bob := bob_of(scene, joint):
            pegs = (end for end in points(joint) if body_of(end) is None)
            found[bob] = scene.where[bob].center - end_position(next(pegs), {}, scene.values)
    return found


def _hanging(scene: Scene) -> Row | None:
    """Return a row of hanging balls, of which those at one end are drawn aside; None if none."""
    vectors = _hung(scene)
    pegs = {name: scene.where[name].center - vector for name, vector in vectors.items()}
    sides = _both_ways(pegs)
    if (
        set(vectors) != set(scene.dynamic)
        or not _equal(scene, sides[0])
        or not _touch(scene, sides[0], pegs)
    ):
        return None
    for row in sides:
        drawn = vectors[row[0]]
        coming = sum(abs(vectors[name] - drawn) < TOUCHING for name in row)
        still = [vectors[name] for name in row[coming:]]
        down = still and all(abs(vector + 1j * abs(drawn)) < TOUCHING for vector in still)
        outwards = drawn.real * (pegs[row[0]] - pegs[row[1]]).real > 0
        aside = SMALLEST < abs(phase(drawn * 1j)) < STEEPEST
        if down and outwards and aside and _clear(scene, row, pegs, drawn):
            return Row(row, coming)
    return None


def _on_a_line(scene: Scene) -> Row | None:
    """Return a row of balls along x, of which some move towards the others at rest, or None."""
    positions = {name: scene.where[name].center for name in scene.dynamic}
    if (
        any(scene.joints[name] for name in positions)
        or len({p.imag for p in positions.values()}) > 1
    ):
        return None
    for row in _both_ways(positions):
        comes = scene.velocity(row[0])
        coming = sum(scene.velocity(name) == comes for name in row)
        a, b = row[coming - 1 : coming + 1] if 0 < coming < len(row) else (row[0], row[0])
        gap, towards = scene.distance(a, 0j, b), comes.real * (positions[b] - positions[a]).real > 0
        if comes.imag or not towards or gap < TOUCHING or not scene.is_at_rest(*row[coming:]):
            continue
        groups = row[:coming], row[coming:]
        free = [scene.free_until(name, lambda t: comes * t, row) for name in groups[0]]  # noqa: B023
        meets = gap / abs(comes)
        touch = all(
            abs(scene.distance(x, 0j, y)) < TOUCHING for g in groups for x, y in pairwise(g)
        )
        if touch and _equal(scene, row) and meets < SAFE * min(free):
            return Row(row, coming)
    return None


def _both_ways(positions: Mapping[str, complex]) -> list[tuple[str, ...]]:
    """Return the names from left to right, and from right to left."""
    row = tuple(sorted(positions, key=lambda name: positions[name].real))
    return [row, row[::-1]]


def _equal(scene: Scene, row: Sequence[str]) -> bool:
    """Return whether bodies are discs of equal size and mass, with elastic impacts."""
    bodies = [scene.level.bodies[name] for name in row]
    masses = {body.mass(scene.values) for body in bodies if body.mass}
    sizes = {scene.where[name].radius for name in row}
    round_ones = all(isinstance(body.shape, Disc) for body in bodies)
    bounce = {Expression(restitution(scene, *two))(scene.known_values) for two in pairwise(row)}
    return round_ones and len(masses) == len(sizes) == 1 and bounce == {1.0}


def _clear(scene: Scene, row: Sequence[str], pegs: Mapping[str, complex], drawn: complex) -> bool:
    """Return whether balls can swing equally far to both sides without obstacles."""
    others = [name for name in scene.where if name not in row]
    return all(swings_free(scene, name, pegs[name], drawn, others) for name in row)


def _touch(scene: Scene, row: Sequence[str], pegs: Mapping[str, complex]) -> bool:
    """Return whether neighbouring balls touch when they hang straight down."""
    wide = 2 * scene.where[row[0]].radius
    return all(abs(pegs[b] - pegs[a] - wide) < TOUCHING for a, b in pairwise(row))
