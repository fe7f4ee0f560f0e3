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
from sandbox.physics.stepping.step_observer import Observation, Observer
from sandbox.physics.stepping.step_plugin import Plugins, Setup


def start(setup: Setup, plugins: Plugins, observer: Observer) -> Observation:
    """Return the observed initial state of a run; for leapfrog, also take the first half kick."""
    scene, kicks = setup.scene, setup.kicks
    velocity = scene.batch.velocity()
    if setup.leapfrog:
        observed = _half_kick(setup, plugins, observer, velocity)
    else:
        unknown = np.full_like(velocity, np.nan)
        scene.joints.time(kicks.clock.dt, kicks.clock.dt)
        snapshot = observer.snapshot(scene.batch.state(), velocity, unknown, NO_CONTACTS, np.nan)
        observed = Observation(kicks.clock.steps, snapshot, NO_CONTACTS, velocity, None)
    return observed


def _half_kick(setup: Setup, plugins: Plugins, observer: Observer, velocity: Array) -> Observation:
    scene, kicks, forces = setup.scene, setup.kicks, setup.forces
    duration = kicks.parts[-1].kick / 2
    with kicks.hold(first=True):
        post_kick_velocity, direct = kicks.begin(duration, velocity), scene.direct
        if direct and direct.drifts.post_kick_velocity is not None:
            post_kick_velocity = direct.drifts.post_kick_velocity
        pre_kick_velocity = velocity + scene.sequence.last.jump if scene.sequence else velocity
        acceleration = (post_kick_velocity - pre_kick_velocity) / duration
        for started in plugins.started:
            if (refined := started(pre_kick_velocity, acceleration)) is not None:
                acceleration, post_kick_velocity = refined, pre_kick_velocity + refined * duration
        contacts, state = observer.contacts(), scene.batch.state()
        if len(kicks.parts) > 1 and (joints := scene.joints.together):
            _, acceleration = joints.motion(velocity, forces.law_acceleration)
        snapshot = observer.snapshot(state, velocity, acceleration, contacts, duration)
        if setup.level.effects.contact and not scene.direct:
            # pymunk's warm start consists of impulses: leave it a whole step's
            kicks.settle(0, velocity, kicks.clock.dt, kicks.clock.dt)
            scene.batch.set_velocity(post_kick_velocity)
    scene.joints.time(kicks.clock.dt, kicks.clock.dt)
    if direct:
        pre_kick_velocity = pre_kick_velocity + direct.last.jump
    forces.start(pre_kick_velocity, post_kick_velocity)
    return Observation(kicks.clock.steps, snapshot, contacts, velocity, None)
