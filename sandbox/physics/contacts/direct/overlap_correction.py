"""Overlap correction: bodies are moved apart, and their velocities stay.

What is moved out of one body may be moved off another: a car that is lifted out of a hill by its
front wheel turns, and its rear wheel leaves the ground by a nanometre. That would be without a
force for a whole step, and a spring would shoot it into the ground. So whoever presses on another
stays with it, if there is a way.
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.constraint_rows import Active
from sandbox.physics.contacts.direct.kick_system import PROUD, Kick
from sandbox.physics.contacts.direct.newton import newton
from sandbox.physics.contacts.direct.row_layout import Layout, Surfaces
from sandbox.physics.contacts.direct.warm_start import WarmStart
from sandbox.physics.state.errors import JointFailure, NoForces

NOTHING = 1e-12
"""m: what a kick leaves of an overlap that is left alone comes as near to it as this, each step."""


class OverlapCorrection:
    """Corrects overlaps, step by step.

    Parameters
    ----------
    surfaces
        How bodies touch.
    known
        The warm start: forces and active rows of the last kick.
    """

    def __init__(self, surfaces: Surfaces, known: WarmStart) -> None:
        self._surfaces, self._known = surfaces, known
        self._held: tuple[Layout, Active] | None = None  # what held in the last
        self._lost: Array = np.zeros(0)  # where there was no way, and what was asked for

    def way(self, kick: Kick, leaving: Array) -> Array | None:
        """Return the displacement, (3 N,) [m, rad], that removes a share of each large overlap.

        Bodies that part by themselves are left alone: a bouncing body would have more energy if it
        were moved up. So are bodies that have only just met, and overlaps that joints enforce. None
        if there is nothing to correct, or if it cannot be done.

        Parameters
        ----------
        kick
            What touches.
        leaving
            (3 N,), how far they go in a step by themselves [m, rad].
        """
        back = self._back(kick, leaving)
        if back is None:
            return None
        layout, here, wanted = kick.layout, kick.here, kick.targets()
        held, slack = here.total[layout.joints], wanted[layout.joints]
        slack = np.minimum(held, slack)  # a slack rope may grow as long as it is
        wanted[layout.joints] = np.where(kick.joints.pulls_only, slack, held)
        wanted[layout.gaps] += back
        asked = np.concatenate((kick.place.values, wanted))
        if np.array_equal(asked, self._lost):  # as in the kick before, if bodies are held
            return None
        try:
            way, self._held = self._apart(kick, wanted, layout.smooth, self._start(layout))
        except (JointFailure, NoForces):
            self._lost = asked
            return None
        return self._together(kick, wanted, way)

    def _apart(
        self, kick: Kick, wanted: Array, layout: Layout, start: Active
    ) -> tuple[Array, tuple[Layout, Active]]:
        """Return the least displacement with which rows are as wanted, and what holds then."""
        none, still = np.zeros_like(wanted), np.zeros_like(kick.place.values)
        _, way, held = newton(kick, layout, kick.rows, still, 1.0, wanted, none, start)
        return way, (kick.layout, held)

    def _together(self, kick: Kick, wanted: Array, way: Array) -> Array:
        """Return a displacement by which nothing leaves what it presses on, if there is one.

        Parameters
        ----------
        kick, wanted
            What touches, and what its rows shall be at least, (r,).
        way
            The least displacement, (3 N,) [m, rad]; returned if there is no other.
        """
        layout, depths = kick.layout, kick.contacts.depths.take(kick.layout.touching.number)
        lifts = (kick.rows(way).total - wanted)[layout.gaps]
        holds = np.zeros(len(wanted), dtype=bool)
        holds[layout.gaps] = self._known.pressed(kick) & (lifts > np.maximum(depths - PROUD, 0.0))
        if not np.count_nonzero(holds):
            return way
        problem = layout.smooth.problem
        free, pushes = problem.free | holds, problem.pushes & ~holds
        holding = layout.smooth.asking(problem._replace(free=free, pushes=pushes))
        slip = np.zeros(len(layout.touching.rubs), dtype=np.intp)
        try:
            return self._apart(kick, wanted, holding, Active(free, slip))[0]
        except (JointFailure, NoForces):
            return way

    def _back(self, kick: Kick, leaving: Array) -> Array | None:
        """Return by how much gaps are to grow, (k,) [m]; None if none is."""
        layout, correction = kick.layout, self._surfaces.correction
        touching, depths = layout.touching, kick.contacts.depths
        deep = depths[touching.pair, touching.point] - self._surfaces.slop
        if not correction or not (deep > 0).any():
            return None
        parts = kick.here.jacobian[layout.gaps] @ leaving
        parts[self._known.pressed(kick)] = 0.0  # what rolls on parts a little: its way bends
        back = correction * deep - np.maximum(parts, 0.0)
        back = np.where(self._known.met(kick) & (back > NOTHING), back, 0.0)
        return back if back.any() else None

    def _start(self, layout: Layout) -> Active:
        """Return what held in the last step, if the same touched then."""
        if self._held and self._held[0] is layout:
            return self._held[1]
        return Active(layout.problem.free, np.zeros(len(layout.touching.rubs), dtype=np.intp))
