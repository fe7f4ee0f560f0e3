"""Branches: a run continues from its present state, with other parameters or parts.

See `state_transfer.py`.
"""

from functools import partial

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.parameters_changeable_in_run import obstacle
from sandbox.physics.stepping.make_world import make_world
from sandbox.physics.stepping.state_transfer import begin_late, take_over
from sandbox.physics.stepping.world import World


def branch(world: World, values: Values) -> World:
    """Make a world that continues from the state of another, with other parameters.

    The time step stays the same, and the other world is not changed. With equal parameters the two
    runs differ only by rounding, by the warm start of solvers and, where forces depend on
    velocities, to second order. Raises `SandboxError` if a changed parameter cannot change during a
    run, and `SimulationError` if the world cannot continue from there.
    """
    changed = [name for name in values if values[name] != world.values[name]]
    if changed and (why := obstacle(world.level, changed)):
        raise SandboxError(why)
    begin = partial(take_over, now=world.snapshot, steps=world.steps, old=world.scene)
    branched = make_world(world.level, values, world.stepping, begin)
    branched.disturbed = True
    return branched


def alter(world: World, level: Level) -> World:
    """Make a world that begins at the start of a level, at the time of another and in its steps.

    The level describes the state of the other world, with changes. The other world is not changed.
    Parts without changes continue as in a branch. Raises `SimulationError` if the world cannot
    continue from there.
    """
    rows = {name: row for row, name in enumerate(world.level.bodies)}
    begin = partial(begin_late, now=world.snapshot, steps=world.steps, rows=rows)
    altered = make_world(level, level.defaults, world.stepping, begin)
    altered.disturbed = True
    return altered
