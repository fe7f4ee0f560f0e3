"""Transfers a state to a new world, which continues with other parameters or parts.

The state is that *at* the step: positions, angles, and the velocities there, the mean of those half
a kick before and after. From it the new world is started like any other, with half a kick of its
own forces (see `initial_state.py`). Leapfrog's velocities are half a step ahead: those of the old
world contain half a kick of the old forces, and would be wrong by Δa h/2. The warm start of
solvers, and whether a contact sticks, are computed again.
"""

from collections.abc import Mapping

import numpy as np

from sandbox.model.expressions import Array
from sandbox.physics.joints.joint_changes import catch, let_go
from sandbox.physics.scene.make_scene import Scene
from sandbox.physics.state.snapshot import Snapshot
from sandbox.physics.stepping.step_plugin import Setup


def take_over(setup: Setup, now: Snapshot, steps: int, old: Scene) -> None:
    """Put a scene into the state of an old world, before the plugins of the new one are made.

    Time continues from the number of steps that the old world has taken. Bodies and joints that its
    scene has welded, tied, cut or switched stay so.
    """
    setup.scene.batch.set_state(_states(now))
    _repeat_welds(setup, old)
    _repeat_events(setup, old, steps)
    _begin_at(setup, steps)


def begin_late(setup: Setup, now: Snapshot, steps: int, rows: Mapping[str, int]) -> None:
    """Let a scene begin at its level's start, but at a later step, before its plugins are made.

    Time continues from the number of steps that the old world has taken. `rows` are those of its
    bodies; those that follow formulas of time keep its state, `now`.
    """
    batch, states = setup.scene.batch, _states(now)
    state = np.column_stack((batch.state()[:, :3], batch.velocity()))
    for row, (name, body) in enumerate(setup.level.bodies.items()):
        if body.motion is not None and name in rows:
            state[row] = states[rows[name]]
    batch.set_state(state)
    _begin_at(setup, steps)


def _states(now: Snapshot) -> Array:
    return np.column_stack((now.position, now.angle, now.velocity, now.angular_velocity))


def _begin_at(setup: Setup, steps: int) -> None:
    """Let time continue from a step, with the bodies at their present positions."""
    scene, clock = setup.scene, setup.kicks.clock
    clock.steps = steps
    for body in scene.bodies.values():
        scene.space.reindex_shapes_for_body(body)
    if together := scene.joints.together:
        together.go_on(clock.after(0))
    if scene.direct:
        scene.direct.go_on(clock.after(0))


def _repeat_events(setup: Setup, old: Scene, steps: int) -> None:
    """Tie, cut and switch what events had tied, cut and switched in the old world."""
    scene = setup.scene
    scene.event_times.update(old.event_times)
    _repeat_catches(scene, old, steps * setup.kicks.clock.dt)
    for name, t in old.joints.cut.items():
        let_go(scene.joints, name, t)
    if scene.gates and old.gates:
        scene.gates.reverse(old.gates.reversed)
    for name, switch in old.switches.items():
        scene.switches[name].thrown[:] = switch.thrown


def _repeat_catches(scene: Scene, old_scene: Scene, now: float) -> None:
    """Tie what events had tied, at the present positions and without an impact."""
    latches, old = scene.joints.latches, old_scene.joints.latches
    if latches is None or old is None:
        return
    if catch(scene.joints, old.tied, now) and scene.joints.together:
        scene.joints.together.end_added_impact()
    latches.tied.update(old.tied)


def _repeat_welds(setup: Setup, old: Scene) -> None:
    """Weld the bodies that had stuck to each other, at their present positions."""
    joints, names = setup.scene.joints, list(setup.scene.bodies)
    for a, b in old.joints.joined[len(joints.joined) :].tolist():
        if joints.solids and joints.weld and joints.solids.join(names[a], names[b]):
            joints.weld(names[a], names[b])
