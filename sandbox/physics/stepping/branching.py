"""A run that goes on with other parameters from where it stands; see `taking_over.py` for how."""

from functools import partial

from sandbox.model.branching import obstacle
from sandbox.model.errors import SandboxError
from sandbox.model.expressions import Values
from sandbox.physics.stepping.making import make_world
from sandbox.physics.stepping.taking_over import take_over
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
