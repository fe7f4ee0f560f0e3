"""Contacts that break loose: static friction no longer holds them, and kinetic friction acts.

A contact breaks loose between two steps, at a time that is interpolated linearly from its loads at
the last two. Kinetic friction acts from there on. But the kick that finds it slipping reaches back
half a step, and so would be off by up to half a step of the difference: an error of first order. So
its friction is chosen such that the momentum is that of static friction up to that time.
"""

from dataclasses import replace

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.contacts.direct.rows.kick_system import Kick
from sandbox.physics.contacts.direct.solving.warm_start import LastKick
from sandbox.physics.engine.space_arrays import Integers


def with_breakaway(
    kick: Kick, slip: Integers, last_two: tuple[LastKick, Array] | None
) -> Kick | None:
    """Return a kick with other bounds of the friction that breaks loose in it; None if none does.

    `slip`, (f,), are the signs of slips in the kick. `last_two` are the kick before, and the forces
    in the one before that, (r,) [N]; None if they are not known. If the load did not grow before,
    it was applied suddenly: the contact breaks loose at the step.
    """
    layout, friction = kick.layout, kick.layout.problem.friction
    if last_two is None or last_two[0].layout is not layout or not np.count_nonzero(slip):
        return None
    last, before = last_two
    load, older = np.abs(last.forces[layout.slips]), np.abs(before[layout.slips])
    breaks = (slip != 0) & (last.active.slip == 0) & (friction.static > friction.kinetic)
    breaks &= load > older
    if not np.count_nonzero(breaks):
        return None
    holds = (friction.coefficients[0] * last.forces[friction.contact]).sum(axis=0)
    waits = (holds - load) / np.where(breaks, load - older, 1.0)
    since = 1.5 - np.clip(waits, 0.0, 1.0)  # steps, at the end of the kick
    lowered = friction.static - (friction.static - friction.kinetic) * since
    slips = np.where(breaks, np.maximum(lowered, 0.0), friction.kinetic)
    return replace(kick, layout=layout.rubbing(slips))
