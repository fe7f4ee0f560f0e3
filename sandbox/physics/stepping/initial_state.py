"""The start of a run: the state there, and the first half kick.

pymunk's step drifts the positions with the velocities of the step before, then kicks the
velocities. Started naively it is first order: free fall is late by half a step. Given half a kick
before the first step, the same loop is leapfrog (Störmer-Verlet): second order, symplectic, and
exact where accelerations are constant. Positions then live on the steps and pymunk's velocities
half-way between; the velocity *at* a step is the mean of the two around it.
"""

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.engine.batch import NO_CONTACTS
from sandbox.physics.stepping.observer import Observation, Observer
from sandbox.physics.stepping.stage import Setup, Stages


def start(setup: Setup, stages: Stages, observer: Observer) -> Observation:
    """Observe the state from which a run goes on; for leapfrog, also give the first half kick."""
    scene, kicks = setup.scene, setup.kicks
    velocity = scene.batch.velocity()
    if setup.leapfrog:
        observed = _half_kick(setup, stages, observer, velocity)
    else:
        nowhere = np.full_like(velocity, np.nan)
        scene.joints.time(kicks.clock.dt, kicks.clock.dt)
        state = scene.batch.state()
        snapshot = observer.snapshot(state, velocity, nowhere, NO_CONTACTS, np.nan)
        observed = Observation(kicks.clock.steps, snapshot, NO_CONTACTS, velocity, None)
    return observed


def _half_kick(setup: Setup, stages: Stages, observer: Observer, velocity: Array) -> Observation:
    scene, kicks, forces = setup.scene, setup.kicks, setup.forces
    lasts = kicks.parts[-1].kick / 2
    with kicks.held():
        after = kicks.begin(lasts, velocity)
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
            # what pymunk remembers for the next step are impulses: leave it a whole step's
            kicks.settle(0, velocity, kicks.clock.dt, kicks.clock.dt)
            scene.batch.set_velocity(after)
    scene.joints.time(kicks.clock.dt, kicks.clock.dt)
    forces.start(begun, after)
    return Observation(kicks.clock.steps, snapshot, contacts, velocity, None)
