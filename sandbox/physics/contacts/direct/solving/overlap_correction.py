"""Overlap correction: bodies are moved apart, and their velocities stay.

A body that is moved out of one body may be lifted off another: a car that is lifted out of a hill
at its front wheel turns, and its rear wheel leaves the ground by a nanometre. The wheel would then
bear no force for a whole step, and a spring would push it into the ground. So bodies that press on
each other stay in contact, where that is possible.
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.complementarity.complementarity_problem import Active
from sandbox.physics.contacts.direct.rows.kick_system import PROUD, Kick
from sandbox.physics.contacts.direct.rows.row_layout import Layout, Surfaces
from sandbox.physics.contacts.direct.solving.newton_method import newton
from sandbox.physics.contacts.direct.solving.warm_start import WarmStart
from sandbox.physics.state.simulation_errors import JointFailure, NoForces

NOTHING = 1e-12
"""m, the rounding of an overlap from step to step; smaller corrections are not made."""

FURTHEST = 100.0
"""Bodies are moved by at most this multiple of the overlap that is to be removed [m, rad]: jammed
ones could only be freed by turning them far, through others."""


class OverlapCorrection:
    """Corrects overlaps, step by step.

    `surfaces` tells how bodies touch; `warm_start` has the forces and active rows of the last
    kick.
    """

    def __init__(self, surfaces: Surfaces, warm_start: WarmStart) -> None:
        self._surfaces, self._warm_start = surfaces, warm_start
        self._held: tuple[Layout, Active] | None = None  # the active rows of the last correction
        self._lost: Array = np.zeros(0)  # the last places and targets without a solution

    def displacement(self, kick: Kick, leaving: Array) -> Array | None:
        """Return the displacement, (3 N,) [m, rad], that removes a share of each large overlap.

        Bodies that separate by themselves are left alone: lifting a body that bounces would add
        energy. So are bodies that have only just met, and overlaps that joints enforce. None if
        there is nothing to correct, or no such displacement. `leaving`, (3 N,), are the
        displacements of the next step without forces [m, rad].
        """
        back = self._back(kick, leaving)
        if back is None:
            return None
        layout, at_start, wanted = kick.layout, kick.rows_at_start, kick.targets()
        present, slack = at_start.total[layout.joints], wanted[layout.joints]
        slack = np.minimum(present, slack)  # a slack rope may grow as long as it is
        wanted[layout.joints] = np.where(kick.joints.pulls_only, slack, present)
        wanted[layout.gaps] += back
        asked = np.concatenate((kick.pose.values, wanted))
        if np.array_equal(asked, self._lost):  # as in the kick before, while bodies are held
            return None
        try:
            shift, self._held = self._apart(kick, wanted, layout.smooth, self._start(layout))
        except (JointFailure, NoForces):
            self._lost = asked
            return None
        shift = self._together(kick, wanted, shift)
        return shift if np.abs(shift).max() <= FURTHEST * back.max() else None

    def _apart(
        self, kick: Kick, wanted: Array, layout: Layout, start: Active
    ) -> tuple[Array, tuple[Layout, Active]]:
        """Return the smallest displacement that satisfies the rows, and the active rows."""
        none, still = np.zeros_like(wanted), np.zeros_like(kick.pose.values)
        _, shift, active = newton(kick, layout, kick.rows, still, 1.0, wanted, none, start)
        return shift, (kick.layout, active)

    def _together(self, kick: Kick, wanted: Array, shift: Array) -> Array:
        """Return a displacement that keeps bodies that press on each other in contact.

        `wanted`, (r,), are the least values of the rows afterwards. `shift`, (3 N,), is the
        smallest displacement [m, rad]; it is returned if none keeps them in contact.
        """
        layout, depths = kick.layout, kick.contacts.depths.take(kick.layout.touching.number)
        lifts = (kick.rows(shift).total - wanted)[layout.gaps]
        holds = np.zeros(len(wanted), dtype=bool)
        holds[layout.gaps] = self._warm_start.was_loaded(kick) & (
            lifts > np.maximum(depths - PROUD, 0.0)
        )
        if not np.count_nonzero(holds):
            return shift
        problem = layout.smooth.problem
        free, pushes = problem.free | holds, problem.pushes & ~holds
        holding = layout.smooth.asking(problem._replace(free=free, pushes=pushes))
        slip = np.zeros(len(layout.touching.friction_points), dtype=np.intp)
        try:
            return self._apart(kick, wanted, holding, Active(free, slip))[0]
        except (JointFailure, NoForces):
            return shift

    def _back(self, kick: Kick, leaving: Array) -> Array | None:
        """Return by how much the gaps are to grow, (k,) [m]; None if none is to."""
        layout, correction = kick.layout, self._surfaces.correction
        deep = kick.contacts.depths.take(layout.touching.number) - self._surfaces.slop
        if not correction or not np.count_nonzero(deep > 0):
            return None
        parts = kick.rows_at_start.jacobian[layout.gaps] @ leaving
        parts[self._warm_start.was_loaded(kick)] = (
            0.0  # rolling bodies separate a little: their paths bend
        )
        back = correction * deep - np.maximum(parts, 0.0)
        back = np.where(self._warm_start.existed(kick) & (back > NOTHING), back, 0.0)
        return back if back.any() else None

    def _start(self, layout: Layout) -> Active:
        """Return the active rows of the last correction, if the contacts are the same."""
        if self._held and self._held[0] is layout:
            return self._held[1]
        return Active(
            layout.problem.free, np.zeros(len(layout.touching.friction_points), dtype=np.intp)
        )
