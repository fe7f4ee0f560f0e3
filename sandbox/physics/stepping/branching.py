"""Branches: a run goes on from where it stands, with other parameters or parts.

`state_transfer.py` says how.
"""

from functools import partial

from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.model.level import Level
from sandbox.model.live_parameters import obstacle
from sandbox.physics.stepping.make_world import make_world
from sandbox.physics.stepping.state_transfer import begin_late, take_over
from sandbox.physics.stepping.world import World


def branch(world: World, values: Values) -> World:
    """Make a world that goes on from the state of another with other parameters, in the same steps.

    The other one stays as it is. Of a parameter that is the same in both, nothing changes but
    rounding, and what a solver remembers of the last step.

    Raises
    ------
    SandboxError
        If a parameter that has changed cannot be while a run goes on; the message says why.
    SimulationError
        If the world cannot go on from there.
    """
    changed = [name for name in values if values[name] != world.values[name]]
    if changed and (why := obstacle(world.level, changed)):
        raise SandboxError(why)
    begin = partial(take_over, now=world.snapshot, steps=world.steps, before=world.scene)
    branched = make_world(world.level, values, world.stepping, begin)
    branched.disturbed = True
    return branched


def alter(world: World, level: Level) -> World:
    """Make a world that goes on, at the time of another and in its steps, from a level's start.

    The level is the state of the other one, in which something was changed. That one stays as it
    is. What is not changed goes on as in a branch.

    Raises
    ------
    SimulationError
        If the world cannot go on from there.
    """
    rows = {name: row for row, name in enumerate(world.level.bodies)}
    begin = partial(begin_late, now=world.snapshot, steps=world.steps, rows=rows)
    altered = make_world(level, level.defaults, world.stepping, begin)
    altered.disturbed = True
    return altered
