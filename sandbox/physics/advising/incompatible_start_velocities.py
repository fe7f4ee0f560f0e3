"""Velocities at the start that the joints of a level do not allow.

The joints change such velocities in the first kick, by an impact before the books are opened: its
energy appears in no account of the ledger.
"""

from contextlib import suppress

import numpy as np
import pymunk

from sandbox.model.level import HIGHEST_RATE, Level
from sandbox.model.level_parts import Fault
from sandbox.physics.scene.make_scene import Scene, make_scene

FITS = 1e-6
"""The share of the largest velocity across a joint that counts as rounding of what was typed."""


def unfit_start(level: Level) -> Fault | None:
    """Return a remark on the joint that the velocities at the start violate most; None if none is.

    Only exact joints that hold in both directions, and keep constant values, are considered: a
    motor sets bodies in motion by its nature. A level that cannot start has no remark either: its
    run gives the reason.
    """
    stepping = level.stepping
    if stepping.accuracy is not None:
        stepping = stepping.at(HIGHEST_RATE)
    with (
        suppress(Exception),  # whatever it is, the run explains it
        np.errstate(all="ignore"),  # non-finite values are reported by name
    ):
        scene = make_scene(level, level.defaults, stepping)
        return _most_violated(scene, 1 / stepping.rate)
    return None


def _most_violated(scene: Scene, dt: float) -> Fault | None:
    joints = scene.joints.together
    if joints is None:
        return None
    terms = joints.jacobian() * scene.batch.state()[:, 3:]
    rates = terms.sum(axis=(1, 2))  # [m/s, rad/s]
    driven = [b.body_type == pymunk.Body.KINEMATIC for b in scene.bodies.values()]
    constant = joints.lengths(0.0) == joints.lengths(dt)
    held = constant & ~joints.pulls_only & ~terms[:, driven].any(axis=(1, 2))
    excess = np.where(held, np.abs(rates) - FITS * np.abs(terms).sum(axis=(1, 2)), 0.0)
    if not (excess > 0).any():
        return None
    worst = int(np.argmax(excess))
    return Fault(
        ("joints", joints.names[worst]),
        "the velocities at the start violate it by {speed:.3g} m/s or rad/s: an impact at the"
        " start changes them, and its energy is in no account; give velocities that fit",
        speed=abs(float(rates[worst])),
    )
