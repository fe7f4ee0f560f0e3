"""Overlaps are taken back: bodies are moved, velocities stay."""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.kick import Kick
from sandbox.physics.contacts.direct.layout import Surfaces
from sandbox.physics.contacts.direct.newton import newton
from sandbox.physics.contacts.direct.problem import Active
from sandbox.physics.contacts.direct.warm_start import WarmStart
from sandbox.physics.state.errors import JointFailure, NoForces

NOTHING = 1e-12
"""m: what a kick leaves of an overlap that is left alone comes as near to it as this, each step."""


def part(kick: Kick, surfaces: Surfaces, known: WarmStart, leaving: Array) -> Array | None:
    """Return the way, (3 N,) [m, rad], that takes back a share of what overlaps too much.

    As far as they part by themselves they are left to, for what bounces would have more energy
    further up; so is what has only met. What joints hold in each other stays as it is. None if
    there is nothing to take back, or no way.

    Parameters
    ----------
    kick
        What touches.
    surfaces
        How.
    known
        Of the last kick.
    leaving
        (3 N,), how far they go in a step by themselves [m, rad].
    """
    layout, here = kick.layout, kick.here
    depths = kick.contacts.depths
    deep = depths[layout.touching.pair, layout.touching.point] - surfaces.slop
    if not surfaces.correction or not (deep > 0).any():
        return None
    parts = here.jacobian[layout.gaps] @ leaving
    parts[known.pressed(kick)] = 0.0  # what rolls on parts a little, by the bend of its way
    back = surfaces.correction * deep - np.maximum(parts, 0.0)
    back = np.where(known.met(kick) & (back > NOTHING), back, 0.0)
    if not back.any():
        return None
    wanted = kick.targets()
    held, slack = here.total[layout.joints], wanted[layout.joints]
    slack = np.minimum(held, slack)  # a slack rope may grow as long as it is
    wanted[layout.joints] = np.where(kick.joints.pulls_only, slack, held)
    wanted[layout.gaps] += back
    smooth = layout.smooth()
    start = Active(smooth.problem.free, np.zeros(len(layout.touching.rubs), dtype=np.intp))
    none = np.zeros_like(wanted)
    still = np.zeros_like(kick.place.values)
    try:
        return newton(kick, smooth, kick.rows, still, 1.0, wanted, none, start)[1]
    except (JointFailure, NoForces):
        return None
