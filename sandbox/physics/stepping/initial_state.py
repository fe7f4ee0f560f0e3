"""The start of a run: the initial state, and the first half kick.

pymunk's step drifts the positions with the velocities of the previous step, then kicks the
velocities. Started naively it is of first order: free fall is late by half a step. With half a kick
before the first step, the same loop is leapfrog (Störmer-Verlet): of second order, symplectic, and
exact for constant accelerations. Positions are then known at the steps and pymunk's velocities
half-way between; the velocity *at* a step is the mean of the two around it.
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.space_arrays import NO_CONTACTS
from sandbox.physics.stepping.stage import Setup, Stages
from sandbox.physics.stepping.state_at_step import Observation, Observer


def start(setup: Setup, stages: Stages, observer: Observer) -> Observation:
    """Return the observed initial state of a run; for leapfrog, also take the first half kick."""
    scene, kicks = setup.scene, setup.kicks
    velocity = scene.batch.velocity()
    if setup.leapfrog:
        observed = _half_kick(setup, stages, observer, velocity)
    else:
        nowhere = np.full_like(velocity, np.nan)
        scene.joints.time(kicks.clock.dt, kicks.clock.dt)
        snapshot = observer.snapshot(scene.batch.state(), velocity, nowhere, NO_CONTACTS, np.nan)
        observed = Observation(kicks.clock.steps, snapshot, NO_CONTACTS, velocity, None)
    return observed


def _half_kick(setup: Setup, stages: Stages, observer: Observer, velocity: Array) -> Observation:
    scene, kicks, forces = setup.scene, setup.kicks, setup.forces
    lasts = kicks.parts[-1].kick / 2
    with kicks.held(first=True):
        after, direct = kicks.begin(lasts, velocity), scene.direct
        if direct and direct.drifts.kicked is not None:
            after = direct.drifts.kicked
        begun = velocity + scene.sequence.last.jump if scene.sequence else velocity
        acceleration = (after - begun) / lasts
        for started in stages.started:
            if (known := started(begun, acceleration)) is not None:
                acceleration, after = known, begun + known * lasts
        contacts, state = observer.contacts(), scene.batch.state()
        if len(kicks.parts) > 1 and (joints := scene.joints.together):
            _, acceleration = joints.motion(velocity, forces.smooth)
        snapshot = observer.snapshot(state, velocity, acceleration, contacts, lasts)
        if setup.level.effects.contact and not scene.direct:
            # pymunk's warm start consists of impulses: leave it a whole step's
            kicks.settle(0, velocity, kicks.clock.dt, kicks.clock.dt)
            scene.batch.set_velocity(after)
    scene.joints.time(kicks.clock.dt, kicks.clock.dt)
    forces.start(begun, after)
    return Observation(kicks.clock.steps, snapshot, contacts, velocity, None)
