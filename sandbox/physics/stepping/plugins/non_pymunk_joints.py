"""The plugin of joints other than pymunk's; exact joints are solved after its kick."""

from collections.abc import Sequence
from functools import partial

from sandbox.model.events import breaking_loads
from sandbox.physics.joints.joint_changes import stick
from sandbox.physics.joints.scene_joints import Joints
from sandbox.physics.state.kick_context import Kick, Work
from sandbox.physics.stepping.step_plugin import Plugin, Setup


def make(setup: Setup) -> Plugin:
    """Make the plugin; the direct solver of contacts solves the exact joints, too."""
    scene = setup.scene
    joints, touching = scene.joints, setup.level.effects.contact is not None
    before = [string.warm_start for string in joints.strings.values()] if touching else []
    after = _all(_solvers(joints, alone=scene.direct is None))
    if after and scene.direct is None:
        after = bearing(setup, after)
    return Plugin(in_kick=_all(before), after_kick=after, refit=joints.refit)


def _solvers(joints: Joints, *, alone: bool) -> list[Work]:
    """Return the calls after pymunk's solver; exact joints are among them if solved `alone`."""
    work: list[Work] = [string.solve for string in joints.strings.values()]
    if joints.touches:
        work.append(partial(stick, joints))
    if alone and (together := joints.together):
        work.append(lambda kick: together.solve(kick.until))
    return work


def bearing(setup: Setup, solve: Work) -> Work:
    """Return a solver of joints in which blows break joints, if any have a breaking force."""
    limits = breaking_loads(setup.level.joints, setup.values)
    together = setup.scene.joints.together
    if not (limits and together):
        return solve
    from sandbox.physics.events.joints_breaking_at_impact import JointBreaking

    return JointBreaking(setup.scene, together, limits, setup.kicks.clock.dt, solve)


def _all(work: Sequence[Work]) -> Work | None:
    """Return one call of all items; None if there are none."""
    if len(work) < 2:
        return work[0] if work else None
    return partial(_each, work)


def _each(work: Sequence[Work], kick: Kick) -> None:
    for item in work:
        item(kick)
